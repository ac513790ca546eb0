#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/motion/planner.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// All that a planner makes of the moves, which end at rest.
std::vector<Stretch> plan(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves);

/// When the last stretch ends.
double cycle_time(const std::vector<Stretch>& stretches);

/// All axes alike, without ends; tight enough to matter.
kinematics::Machine uniform_machine(double speed, double acceleration);

/// With a jerk for every axis: `jerk` for X, Y and Z, a third of it for B and C.
kinematics::Machine with_jerk(kinematics::Machine machine, double jerk);

kinematics::Move line(const geometry::Vec3& from, const geometry::Vec3& to, kinematics::Feed feed);
kinematics::Move arc_xy(const geometry::Vec3& from, const geometry::Vec3& center, double sweep_deg, double rise,
                        kinematics::Feed feed);

inline constexpr kinematics::Feed kRapid{};
inline kinematics::Feed speed(double value) { return {kinematics::FeedKind::Speed, value}; }
inline kinematics::Feed duration(double value) { return {kinematics::FeedKind::Duration, value}; }

/// The programmed path, from 0 to 1.
geometry::Pose programmed(const kinematics::Machine& machine, const kinematics::Move& move, double part);

/// How far a point is from the programmed path.
double distance(const kinematics::Machine& machine, const kinematics::Move& move, const geometry::Vec3& point);

/// Moves of every kind that a program makes, joined end to end.
std::vector<kinematics::Move> random_moves(std::uint64_t seed, int count);

}  // namespace isocnc::motion
