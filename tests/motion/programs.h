#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "interpreter/motion/machine.h"
#include "interpreter/motion/move.h"
#include "interpreter/motion/planner.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// All that a planner makes of the moves, which end at rest.
std::vector<Stretch> plan(const Machine& machine, const std::vector<Move>& moves);

/// When the last stretch ends.
double cycle_time(const std::vector<Stretch>& stretches);

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

}  // namespace isocnc::motion
