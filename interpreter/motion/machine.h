#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "interpreter/geometry/vectors.h"

namespace isocnc::motion {

enum Axis : std::uint8_t { kX, kY, kZ, kB, kC };
inline constexpr int kAxisCount = 5;

/// What a joint can do: mm, mm/s, mm/s^2 and mm/s^3, or the same in degrees.
struct AxisLimits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  double speed = 0;            ///< Of rapids too. Positive.
  double acceleration = 0;     ///< Positive.
  std::optional<double> jerk;  ///< Positive; absent: not limited.
};

enum class MachineKind : std::uint8_t {
  ThreeAxis,  ///< B and C are carried along, and turn nothing.
  Head,       ///< C turns the head about Z, and carries B, which tilts it about Y.
  Table,      ///< B tilts the table about Y, and carries C, which turns the workpiece about Z. The tool keeps upright.
};

/// How the joints carry the tool. X, Y and Z stand where the spindle nose is with B = C = 0, whatever the kind: for a
/// tool of length l upright at the tip t they are t + l ez. In the workpiece's eyes the tool axis, from tip to
/// spindle, is Rz(C) Ry(B) ez for heads and tables alike, as in G29 (D28), so one program suits both.
///
/// Offsets go from the first place named to the second, along the machine's X, Y and Z: a B axis 20 mm further in +X
/// than the C axis has `b_from_c` = (20, 0, 0). docs/machine.md shows how they are measured.
struct Kinematics {
  MachineKind kind = MachineKind::ThreeAxis;
  double pivot = 0;                                        ///< Head: from the B axis down to the spindle nose, mm.
  geometry::Vec3 b_from_c = geometry::Vec3::Zero();        ///< Head: from the C axis to the B axis, at B = C = 0.
  geometry::Vec3 spindle_from_b = geometry::Vec3::Zero();  ///< Head: from the B axis to the spindle axis, at B = C = 0.
  geometry::Vec3 b_point = geometry::Vec3::Zero();         ///< Table: a point of the B axis, machine frame.
  geometry::Vec3 c_point = geometry::Vec3::Zero();         ///< Table: a point of the C axis at B = 0, machine frame.
};

struct Machine {
  std::array<AxisLimits, kAxisCount> axes;
  Kinematics kinematics;
  double feed_speed = std::numeric_limits<double>::infinity();  ///< Most of the tip on feed moves, mm/s.
  double feed_turn = std::numeric_limits<double>::infinity();   ///< Most of B and of C on feed moves, deg/s.
  double chord_tolerance = 0.01;                                ///< Of arcs that are split into lines (I.3.4.3.a), mm.
  double corner_tolerance = 0.02;      ///< How far from the programmed path the tip may round a corner, mm.
  double corner_tolerance_deg = 0.05;  ///< The same for B and C, degrees.
};

/// A router of 3200 x 1600 x 500 mm, 60 m/min and 3 to 5 m/s^2. X and Y grow from the table's corner; Z is 0 at the
/// table.
Machine three_axis_router();
/// The same with a head: C +-360 degrees, B +-120, pivot 180 mm.
Machine head_router();
/// A smaller one with a tilting table.
Machine table_router();
/// What serves where none is described: head_router().
Machine default_machine();

}  // namespace isocnc::motion
