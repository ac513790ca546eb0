#pragma once

#include <array>

#include "interpreter/execution/sink.h"
#include "interpreter/geometry/range.h"

namespace isocnc::execution {

/// What G38 to G42 want of a motion.
struct CutterCompensation {
  int side = 0;                 ///< 1: left of the contour (G41); -1: right of it (G42); 0: on it (G40).
  bool reduces = false;         ///< G39: what the cutter cannot reach is left out.
  bool plane_is_sound = false;  ///< The axes in force are at right angles; else there is no side to go to.
};

/// A motion of the tool tip in the machine frame; mm and degrees.
struct MachineMove {
  MoveKind kind = MoveKind::Rapid;
  geometry::Pose from;
  geometry::Pose to;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Arcs.
  /// Arcs, and all under G41 or G42: of the arc plane; unit, i x j, k x i or j x k.
  geometry::Vec3 normal = geometry::Vec3::Zero();
  double radius = 0;
  double sweep_deg = 0;
  double length = 0;          ///< Of the tip's path, mm.
  double feed = 0;            ///< As in Move.
  bool inverse_time = false;  ///< G93.
  bool five_axis = false;     ///< G49.
  AxisSet placed = 0;         ///< As in Move: axes of the frame in force.
  CutterCompensation compensation;
};

/// From the frame in force in `state`, the one in which the motion runs, to the machine frame.
MachineMove in_machine(const Move& move, const State& state);

/// From where to where each axis goes on the way, the bulges of arcs included.
std::array<geometry::Range, kAxisCount> extents(const MachineMove& move);

}  // namespace isocnc::execution
