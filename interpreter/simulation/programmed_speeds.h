#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "interpreter/geometry/arc.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/kinematics/numbers.h"
#include "interpreter/timing/timing.h"

namespace isocnc::simulation {

/// Limits of the machine that a program may exceed.
enum class Limit : std::uint8_t {
  Feed,          ///< mm/min. The machine moves at its maximum instead.
  RotarySpeed,   ///< Speed of B or C in feed moves, degrees/min. The machine moves at its maximum instead.
  SpindleSpeed,  ///< rev/min.
};
inline constexpr std::size_t kLimitCount = 3;

inline double limit_of(Limit limit, const timing::TimedMachine& machine) {
  switch (limit) {
    case Limit::Feed:
      return kinematics::kSecondsPerMinute * machine.motion.feed_speed;
    case Limit::RotarySpeed:
      return kinematics::kSecondsPerMinute * machine.motion.feed_turn;
    case Limit::SpindleSpeed:
      break;
  }
  return machine.spindle_speed;
}

/// Whether a value is above the limit by more than rounding.
inline bool exceeds(Limit limit, double value, const timing::TimedMachine& machine) {
  constexpr double kRounding = 1 + 1e-9;
  return value > limit_of(limit, machine) * kRounding;
}

/// The speeds that a program asks of a motion, even those that the machine does not reach.
struct ProgrammedSpeeds {
  double feed = 0;    ///< mm/min; 0 for rapids, and where only B and C turn.
  double rotary = 0;  ///< Of the faster of B and C, degrees/min; 0 for rapids.
};

/// `length` is that of the tip's path, mm.
inline ProgrammedSpeeds programmed_speeds(const kinematics::Move& move, double length) {
  if (move.feed.kind == kinematics::FeedKind::Rapid) return {};
  const double b = std::abs(move.to.b - move.from.b);
  const double c = std::abs(move.to.c - move.from.c);
  const bool only_turns = length <= geometry::kEqualCoordinate;
  const double way = only_turns ? std::hypot(b, c) : length;
  if (way == 0) return {};
  const double seconds = move.feed.kind == kinematics::FeedKind::Duration ? move.feed.value : way / move.feed.value;
  return {.feed = only_turns ? 0 : kinematics::kSecondsPerMinute * way / seconds,
          .rotary = kinematics::kSecondsPerMinute * std::max(b, c) / seconds};
}

}  // namespace isocnc::simulation
