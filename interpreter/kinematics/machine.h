#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "interpreter/geometry/vectors.h"

namespace isocnc::kinematics {

enum MachineAxis : std::uint8_t { kX, kY, kZ, kB, kC };
inline constexpr int kAxisCount = 5;

/// The limits of one axis: in mm, mm/s, mm/s^2 and mm/s^3 for X, Y, Z; in degrees instead of mm for B and C.
struct AxisLimits {
  double minimum = -std::numeric_limits<double>::infinity();  ///< Lower end of the range.
  double maximum = std::numeric_limits<double>::infinity();   ///< Upper end of the range.
  double speed = 0;            ///< Speed of rapids, and maximum for feed moves; positive.
  double acceleration = 0;     ///< Maximum acceleration; positive.
  std::optional<double> jerk;  ///< Maximum jerk; positive. Absent: the jerk is not limited.
};

enum class MachineKind : std::uint8_t {
  ThreeAxis,  ///< X, Y and Z move the spindle; B and C have positions but turn nothing.
  Head,       ///< C turns the head about Z and carries B, which tilts the head about Y.
  Table,      ///< B tilts the table about Y and carries C, which turns the workpiece about Z. The tool stays upright.
};

/// The geometry that maps positions of the joints to the pose of the tip. On every kind of machine X, Y and Z are the
/// position of the spindle nose at B = C = 0: t + l ez for an upright tool of length l with its tip at t. Relative to
/// the workpiece the tool axis, from tip to spindle, is Rz(C) Ry(B) ez on heads and tables alike, as in G29 (D28), so
/// one program suits both.
///
/// An offset `b_from_c` is a vector in the machine's X, Y, Z that starts at c and ends at b: a B axis 20 mm further in
/// +X than the C axis has `b_from_c` = (20, 0, 0). docs/machine.md shows how to measure the offsets.
struct Kinematics {
  MachineKind kind = MachineKind::ThreeAxis;
  double pivot = 0;                                  ///< Head: distance from the B axis down to the spindle nose, mm.
  geometry::Vec3 b_from_c = geometry::Vec3::Zero();  ///< Head: from the C axis to the B axis, at B = C = 0, mm.
  geometry::Vec3 spindle_from_b = geometry::Vec3::Zero();  ///< Head: from the B to the spindle axis, B = C = 0, mm.
  geometry::Vec3 b_point = geometry::Vec3::Zero();         ///< Table: a point of the B axis, machine frame, mm.
  geometry::Vec3 c_point = geometry::Vec3::Zero();  ///< Table: a point of the C axis at B = 0, machine frame, mm.
};

/// How the joints go together in rapids (I.3.4.1 leaves it to the machine).
enum class RapidMotion : std::uint8_t {
  Interpolated,  ///< All joints start and arrive together: a straight line of the joints.
  Independent,   ///< Each joint moves as fast as it can and arrives when it can, from rest to rest.
};

struct Machine {
  std::array<AxisLimits, kAxisCount> axes;
  RapidMotion rapid_motion = RapidMotion::Interpolated;
  Kinematics kinematics;
  double feed_speed = std::numeric_limits<double>::infinity();  ///< Maximum speed of the tip on feed moves, mm/s.
  double feed_turn = std::numeric_limits<double>::infinity();   ///< Maximum speed of B and C on feed moves, degrees/s.
  double chord_tolerance = 0.01;       ///< Maximum deviation of arcs split into lines (I.3.4.3.a), mm.
  double corner_tolerance = 0.02;      ///< Maximum deviation of a rounded corner from the programmed path, mm.
  double corner_tolerance_deg = 0.05;  ///< Maximum deviation of B and C in a rounded corner, degrees.
};

/// Whether the jerk of any axis is limited.
bool limits_jerk(const Machine& machine);

/// Returns a router of 3200 x 1600 x 500 mm, 60 m/min and 3 to 5 m/s^2. X and Y are 0 at a corner of the table, Z is 0
/// on the table.
Machine three_axis_router();
/// Returns the same router with a head: C +-360 degrees, B +-120 degrees, pivot 180 mm.
Machine head_router();
/// Returns a smaller machine with a tilting table.
Machine table_router();
/// Returns the machine that is used if the user describes none: head_router().
Machine default_machine();

}  // namespace isocnc::kinematics
