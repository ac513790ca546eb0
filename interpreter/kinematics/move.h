#pragma once

#include <cstdint>

#include "interpreter/geometry/vectors.h"

namespace isocnc::kinematics {

enum class FeedKind : std::uint8_t {
  Rapid,     ///< Speed limited by the axes alone (I.3.4.1).
  Speed,     ///< Speed of the tip, mm/s; of B and C together, degrees/s, where they alone move (G94, I.3.7).
  Duration,  ///< Duration of the move at constant speed, s (G93). Accelerating makes the move take longer.
};

struct Feed {
  FeedKind kind = FeedKind::Rapid;
  double value = 0;  ///< Speed or duration, positive; unused for rapids.
};

/// A line or an arc of the tip in the machine frame, in mm and degrees, as the planner takes it. B and C change in
/// proportion to the length traveled. The fields correspond to those of execution::MachineMove.
struct Move {
  std::uint64_t tag = 0;  ///< Identifier chosen by the caller; every Stretch of the move carries it.
  geometry::Pose from;    ///< Start; the machine stops before the move if this is not the previous end.
  geometry::Pose to;      ///< End.
  bool is_arc = false;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Center of an arc, mm.
  geometry::Vec3 normal = geometry::Vec3::Zero();  ///< Unit normal of the plane of an arc.
  double sweep_deg = 0;  ///< Angle of an arc, not 0; positive counterclockwise about `normal`.
  Feed feed;
  bool exact_stop = false;  ///< Whether the machine stops at the move's end (G09).
  /// Whether an arc is split into lines within the chord tolerance (G49, I.3.4.3.a). Arcs that turn B or C always are
  /// (I.3.4.3.c).
  bool splits_arcs = false;
  /// Whether the tip stays on the line while B or C turn: the linear joints compensate. Otherwise every joint moves
  /// linearly from start to end, and the tip's path follows from that. Without effect where B and C rest.
  bool controls_tool_point = true;
  double tool_length = 0;  ///< Distance from the spindle nose to the tip, mm.
};

}  // namespace isocnc::kinematics
