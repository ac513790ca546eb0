#pragma once

#include <cstdint>

#include "analyzer/translation/source_control.h"

namespace isocnc::translation {

/// What a G of another control means to the translation.
enum class ForeignRole : std::uint8_t {
  Motion,  ///< G00 to G03.
  Cycle,
  CycleUnknown,  ///< A cycle that no motions can say.
  CycleEnd,
  RetractInitial,
  RetractR,
  Dwell,
  ExactStopHere,
  ExactStop,
  Continuous,
  Plane,
  Inches,
  Millimeters,
  Absolute,
  Incremental,
  CentersAbsolute,
  CentersRelative,
  InverseTime,
  PerMinute,
  PerTurn,
  SurfaceSpeed,
  TurnsPerMinute,
  CompensationOff,
  Compensation,
  CompensationGiven,  ///< With a radius of its own.
  Length,
  LengthOff,
  LengthGiven,
  ZeroPoint,
  FurtherZero,  ///< A zero point beyond G59, which no map can give.
  LocalShift,
  SetPosition,
  ClearShift,
  PresetShift,  ///< Of Fanuc: ends shifts axis by axis.
  SuspendShift,
  RestoreShift,
  Data,
  Reference,
  MachineCoordinates,
  Rotation,
  RotationOff,
  Polar,
  PolarOff,
  Scale,
  ScaleOff,
  Mirror,
  MirrorOff,
  Tilt,
  CurvedPlane,  ///< X and Y on a face or a cylinder that turns.
  CurvedPlaneOff,
  Diameter,
  Radius,
  Ignored,  ///< Says nothing that this dialect does not do anyway.
  Unknown,
};

/// The role of a G, given in tenths.
ForeignRole foreign_role(int tenths, SourceControl control);

}  // namespace isocnc::translation
