#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"

namespace isocnc::kinematics {

/// All axes alike, without ends; tight enough to matter.
Machine uniform_machine(double speed, double acceleration);

/// With a jerk for every axis: `jerk` for X, Y and Z, a third of it for B and C.
Machine with_jerk(Machine machine, double jerk);

Move line(const geometry::Vec3& from, const geometry::Vec3& to, Feed feed);
Move arc_xy(const geometry::Vec3& from, const geometry::Vec3& center, double sweep_deg, double rise, Feed feed);

inline constexpr Feed kRapid{};
inline Feed speed(double value) { return {FeedKind::Speed, value}; }
inline Feed duration(double value) { return {FeedKind::Duration, value}; }

/// The programmed path, from 0 to 1.
geometry::Pose programmed(const Machine& machine, const Move& move, double part);

/// How far a point is from the programmed path.
double distance(const Machine& machine, const Move& move, const geometry::Vec3& point);

/// Moves of every kind that a program makes, joined end to end.
std::vector<Move> random_moves(std::uint64_t seed, int count);

}  // namespace isocnc::kinematics
