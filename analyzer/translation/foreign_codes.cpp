#include "analyzer/translation/foreign_codes.h"

namespace isocnc::translation {

namespace {

constexpr unsigned kF = 1U << static_cast<unsigned>(SourceControl::Fanuc);
constexpr unsigned kL = 1U << static_cast<unsigned>(SourceControl::LinuxCnc);
constexpr unsigned kG = 1U << static_cast<unsigned>(SourceControl::Grbl);
constexpr unsigned kAll = kF | kL | kG;

/// A range of G numbers, in tenths, `step` apart.
struct RoleRow {
  int first, last, step;
  ForeignRole role;
  unsigned controls;
};

using enum ForeignRole;
constexpr RoleRow kRoles[] = {
    {0, 30, 10, Motion, kAll},
    {40, 40, 10, Dwell, kAll},
    {50, 50, 10, Ignored, kF},  // G05 P10000, G05.1 Q1: high-speed machining.
    {51, 51, 10, Ignored, kF},
    {70, 70, 10, Diameter, kL},
    {71, 71, 10, CurvedPlane, kF},
    {80, 80, 10, Radius, kL},
    {80, 80, 10, Ignored, kF},  // G08 P1: look-ahead.
    {90, 90, 10, ExactStopHere, kF},
    {100, 100, 10, Data, kAll},
    {121, 121, 10, CurvedPlane, kF},
    {131, 131, 10, CurvedPlaneOff, kF},
    {150, 150, 10, PolarOff, kF},
    {160, 160, 10, Polar, kF},
    {170, 190, 10, Plane, kAll},
    {200, 200, 10, Inches, kAll},
    {210, 210, 10, Millimeters, kAll},
    {220, 230, 10, Ignored, kF},  // The travel is set at the machine.
    {280, 300, 20, Reference, kAll},
    {400, 400, 10, CompensationOff, kAll},
    {410, 420, 10, Compensation, kF | kL},
    {411, 421, 10, CompensationGiven, kL},
    {430, 430, 10, Length, kF | kL},
    {431, 431, 10, LengthGiven, kAll},
    {432, 432, 10, LengthGiven, kL},
    {440, 440, 10, LengthGiven, kF},
    {490, 490, 10, LengthOff, kAll},
    {500, 500, 10, ScaleOff, kF},
    {501, 501, 10, MirrorOff, kF},
    {510, 510, 10, Scale, kF},
    {511, 511, 10, Mirror, kF},
    {520, 520, 10, LocalShift, kF | kL},
    {530, 530, 10, MachineCoordinates, kAll},
    {540, 590, 10, ZeroPoint, kAll},
    {541, 542, 1, FurtherZero, kF},
    {591, 593, 1, ZeroPoint, kL},
    {610, 610, 10, ExactStop, kAll},
    {611, 611, 10, ExactStop, kL},
    {640, 640, 10, Continuous, kF | kL},
    {680, 680, 10, Rotation, kF},
    {682, 682, 10, Tilt, kF},
    {690, 690, 10, RotationOff, kF},
    {730, 730, 10, Cycle, kF | kL},
    {740, 740, 10, CycleUnknown, kF | kL},
    {760, 760, 10, CycleUnknown, kF | kL},
    {800, 800, 10, CycleEnd, kAll},
    {810, 830, 10, Cycle, kF | kL},
    {840, 840, 10, CycleUnknown, kF | kL},
    {850, 860, 10, Cycle, kF | kL},
    {870, 880, 10, CycleUnknown, kF | kL},
    {890, 890, 10, Cycle, kF | kL},
    {900, 900, 10, Absolute, kAll},
    {901, 901, 10, CentersAbsolute, kL},
    {910, 910, 10, Incremental, kAll},
    {911, 911, 10, CentersRelative, kL | kG},
    {920, 920, 10, SetPosition, kAll},
    {921, 921, 10, ClearShift, kL | kG},
    {921, 921, 10, PresetShift, kF},
    {922, 922, 10, SuspendShift, kL},
    {923, 923, 10, RestoreShift, kL},
    {930, 930, 10, InverseTime, kAll},
    {940, 940, 10, PerMinute, kAll},
    {950, 950, 10, PerTurn, kF | kL},
    {960, 960, 10, SurfaceSpeed, kF | kL},
    {970, 970, 10, TurnsPerMinute, kF | kL},
    {980, 980, 10, RetractInitial, kF | kL},
    {990, 990, 10, RetractR, kF | kL},
    {1070, 1070, 10, CurvedPlane, kF},
    {1100, 1110, 10, FurtherZero, kF},
    {1120, 1120, 10, CurvedPlane, kF},
    {1130, 1130, 10, CurvedPlaneOff, kF},
    {1140, 1290, 10, FurtherZero, kF},
    {1540, 1540, 10, FurtherZero, kF},
};

}  // namespace

ForeignRole foreign_role(int tenths, SourceControl control) {
  const unsigned bit = 1U << static_cast<unsigned>(control);
  for (const RoleRow& row : kRoles) {
    const bool is_in_range = tenths >= row.first && tenths <= row.last && (tenths - row.first) % row.step == 0;
    if (is_in_range && (row.controls & bit) != 0) return row.role;
  }
  return Unknown;
}

}  // namespace isocnc::translation
