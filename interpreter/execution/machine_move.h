#pragma once

#include <array>

#include "interpreter/execution/sink.h"
#include "interpreter/geometry/range.h"

namespace isocnc::execution {

/// A motion of the tool tip in the machine frame; mm and degrees.
struct MachineMove {
  MoveKind kind = MoveKind::Rapid;
  geometry::Pose from;
  geometry::Pose to;
  geometry::Vec3 center = geometry::Vec3::Zero();  ///< Arcs.
  geometry::Vec3 normal = geometry::Vec3::Zero();  ///< Arcs: unit, i x j, k x i or j x k.
  double radius = 0;
  double sweep_deg = 0;
  double length = 0;          ///< Of the tip's path, mm.
  double feed = 0;            ///< As in Move.
  bool inverse_time = false;  ///< G93.
  bool five_axis = false;     ///< G49.
};

/// From the frame in force in `state`, the one in which the motion runs, to the machine frame.
MachineMove in_machine(const Move& move, const State& state);

/// From where to where each axis goes on the way, the bulges of arcs included.
std::array<geometry::Range, kAxisCount> extents(const MachineMove& move);

}  // namespace isocnc::execution
