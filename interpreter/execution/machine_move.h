#pragma once

#include <array>

#include "interpreter/execution/sink.h"
#include "interpreter/geometry/range.h"

namespace isocnc::execution {

/// The modes G38 to G42 of a motion.
struct CutterCompensation {
  int side = 0;                 ///< 1: left of the contour (G41); -1: right of it (G42); 0: on it (G40).
  bool reduces = false;         ///< G39: parts that the cutter cannot reach are omitted.
  bool plane_is_sound = false;  ///< Whether the axes in force are at right angles, as an offset to a side requires.
};

/// A motion of the tool tip in the machine frame; mm and degrees.
struct MachineMove {
  MoveKind kind = MoveKind::Rapid;
  geometry::Pose from;
  geometry::Pose to;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Arcs.
  /// Unit normal of the arc plane (i x j, k x i or j x k), for arcs and for all motions under G41 or G42.
  geometry::Vec3 normal = geometry::Vec3::Zero();
  double radius = 0;
  double sweep_deg = 0;
  double length = 0;          ///< Length of the tip's path, mm.
  double feed = 0;            ///< Feed in the units of ProgrammedMove::feed.
  bool inverse_time = false;  ///< G93.
  bool five_axis = false;     ///< G49.
  AxisSet placed = 0;         ///< Axes of the frame in force whose end is given (ProgrammedMove::placed).
  CutterCompensation compensation;
};

/// Transforms a motion to the machine frame from the frame in force in `state`, the state in which the motion runs.
MachineMove in_machine(const ProgrammedMove& move, const State& state);

/// The range that each axis covers during the motion, the bulges of arcs included.
std::array<geometry::Range, kAxisCount> extents(const MachineMove& move);

}  // namespace isocnc::execution
