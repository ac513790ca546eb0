#pragma once

#include <cstdint>

#include "interpreter/geometry/vectors.h"

namespace isocnc::motion {

enum class FeedKind : std::uint8_t {
  Rapid,     ///< As fast as the axes allow (I.3.4.1).
  Speed,     ///< mm/s of the tip along its path; deg/s of B and C together where they alone move (G94, I.3.7).
  Duration,  ///< Seconds that the move should take (G93). It takes longer where it has to gather speed.
};

struct Feed {
  FeedKind kind = FeedKind::Rapid;
  double value = 0;  ///< Positive but for rapids.
};

/// What the machine is asked to do next: a line or an arc of the tip in the machine frame, mm and degrees. B and C
/// change in proportion to the way gone. Fields as in execution::MachineMove.
struct Move {
  std::uint64_t tag = 0;  ///< The caller's; comes back with every Stretch.
  geometry::Pose from;    ///< Where the move before ended, else the planner stops between them.
  geometry::Pose to;
  bool is_arc = false;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Arcs.
  geometry::Vec3 normal = geometry::Vec3::Zero();  ///< Arcs: unit.
  double sweep_deg = 0;                            ///< Arcs: positive counterclockwise about `normal`, not 0.
  Feed feed;
  bool exact_stop = false;  ///< At the move's end (G09).
  /// Arcs become lines within the chord tolerance (G49, I.3.4.3.a). Those that turn B or C always do (I.3.4.3.c).
  bool splits_arcs = false;
  /// Where B or C turn, the tip stays on the line, and the linear joints make up for them. Else every joint goes
  /// straight from end to end, and the tip where that takes it. Without effect where B and C rest.
  bool controls_tool_point = true;
  double tool_length = 0;
};

}  // namespace isocnc::motion
