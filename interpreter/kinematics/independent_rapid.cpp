#include "interpreter/kinematics/independent_rapid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/kinematics/element.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

/// Maximum difference of two times that is a rounding error, s.
static constexpr double kSameTime = 1e-12;
/// Maximum way of a joint that is a rounding error of the inverse kinematics, mm or degrees.
static constexpr double kNoWay = 1e-9;

namespace {

/// The shortest motion of one joint over a distance, from rest to rest, under its own limits.
class JointMotion {
 public:
  JointMotion(double distance, const AxisLimits& limits) : distance_(distance) {
    const double way = std::abs(distance);
    if (!(way > kNoWay)) return;
    const double speed = peak_speed(way, limits);
    // Durations of growing and of constant acceleration.
    double grows = 0;
    double holds = speed / limits.acceleration;
    double acceleration = limits.acceleration;
    if (limits.jerk) {
      const bool reaches = speed * *limits.jerk >= square(acceleration);
      grows = reaches ? acceleration / *limits.jerk : std::sqrt(speed / *limits.jerk);
      holds = reaches ? holds - grows : 0;
      acceleration = grows * *limits.jerk;
    }
    const double jerk = limits.jerk.value_or(0);
    const double cruise = std::max(0.0, way / speed - 2 * grows - holds);
    add(grows, 0, jerk);
    add(holds, acceleration, 0);
    add(grows, acceleration, -jerk);
    add(cruise, 0, 0);
    add(grows, 0, -jerk);
    add(holds, -acceleration, 0);
    add(grows, -acceleration, jerk);
  }

  /// Appends the times at which the jerk or the acceleration changes.
  void append_changes(std::vector<double>& times) const {
    for (std::size_t i = 0; i < count_; ++i) times.push_back(phases_[i].start + phases_[i].duration);
  }

  /// Returns the coefficients of the powers of t of the way at `from` + t, by the phase in progress at `middle`.
  std::array<double, 4> way(double from, double middle) const {
    for (std::size_t i = 0; i < count_; ++i) {
      const JointPhase& phase = phases_[i];
      if (middle > phase.start + phase.duration) continue;
      const double t = from - phase.start;
      const auto [p, v, a, j] = std::array{phase.way, phase.speed, phase.acceleration, phase.jerk};
      const double sign = std::copysign(1.0, distance_);
      return {sign * (p + t * (v + t * (a / 2 + t * j / 6))), sign * (v + t * (a + t * j / 2)), sign * (a + t * j) / 2,
              sign * j / 6};
    }
    return {distance_, 0, 0, 0};
  }

 private:
  struct JointPhase {
    double start = 0;  ///< Time from the start of the motion, s.
    double duration = 0;
    double way = 0;  ///< At the start of the phase, as the speed and the acceleration.
    double speed = 0;
    double acceleration = 0;
    double jerk = 0;
  };

  /// Returns the maximum speed on a way, by the joint's speed and by the way itself.
  static double peak_speed(double way, const AxisLimits& limits) {
    if (!limits.jerk) return std::min(limits.speed, std::sqrt(way * limits.acceleration));
    // The speed from which on the acceleration is reached.
    const double reached = square(limits.acceleration) / *limits.jerk;
    double speed = std::cbrt(square(way) * *limits.jerk / 4);
    if (speed > reached) speed = (std::sqrt(square(reached) + 4 * limits.acceleration * way) - reached) / 2;
    return std::min(limits.speed, speed);
  }

  void add(double duration, double acceleration, double jerk) {
    if (!(duration > kSameTime)) return;
    JointPhase phase{.duration = duration, .acceleration = acceleration, .jerk = jerk};
    if (count_ > 0) {
      const JointPhase& last = phases_[count_ - 1];
      const double t = last.duration;
      phase.start = last.start + t;
      phase.way = last.way + t * (last.speed + t * (last.acceleration / 2 + t * last.jerk / 6));
      phase.speed = last.speed + t * (last.acceleration + t * last.jerk / 2);
    }
    phases_[count_++] = phase;
  }

  double distance_;
  std::array<JointPhase, 7> phases_;
  std::size_t count_ = 0;
};

}  // namespace

bool moves_independently(const Machine& machine, const Move& move) {
  return machine.rapid_motion == RapidMotion::Independent && move.feed.kind == FeedKind::Rapid &&
         !move.controls_tool_point && !move.is_arc;
}

/// Coordinates as a polynomial of the time.
using TimePolynomial = std::array<Coordinates, 4>;

/// Returns the part in which the coordinates have these values. `rate`: range of s divided by the duration.
static RapidPart rapid_part(const TimePolynomial& c, double duration, double rate) {
  RapidPart part;
  part.duration = duration;
  part.length = rate * duration;
  const Coordinates way = duration * (c[1] + duration * (c[2] + duration * c[3]));
  // Shares of the way, by the powers of the time, if the coordinates go straight.
  std::array<double, 4> shares = {};
  bool is_straight = true;
  double power = duration;
  for (std::size_t k = 1; k < c.size(); ++k, power *= duration) {
    shares[k] = c[k].dot(way) / way.squaredNorm();
    is_straight = is_straight && (power * (c[k] - shares[k] * way)).cwiseAbs().maxCoeff() <= kNoLength;
  }
  if (is_straight) {
    part.path = Path::line(c[0], way / part.length);
    part.speed = part.length * shares[1];
    part.acceleration = 2 * part.length * shares[2];
    part.jerk = 6 * part.length * shares[3];
    return part;
  }
  part.path.c = {c[0], c[1] / rate, c[2] / square(rate), c[3] / (square(rate) * rate)};
  part.speed = rate;
  return part;
}

/// Returns how far each joint goes in a move.
static Coordinates ways(const Machine& machine, const Move& move) {
  return inverse(machine.kinematics, coordinates(move.to), move.tool_length) -
         inverse(machine.kinematics, coordinates(move.from), move.tool_length);
}

bool leaves_line(const Machine& machine, const Move& move) {
  return moves_independently(machine, move) && (ways(machine, move).cwiseAbs().array() > kNoWay).count() > 1;
}

std::vector<RapidPart> independent_rapid(const Machine& machine, const Move& move) {
  const double whole = programmed_line(machine, move, move.from, move.to).length;
  if (!(whole > 0)) return {};
  const Coordinates ways = kinematics::ways(machine, move);
  // While no axis turns it, the tip of a spindle moves as the joints do. That is its path in closed form.
  const bool is_of_joints = machine.kinematics.kind == MachineKind::Table || swings(machine, move);
  const Coordinates tip = coordinates(move.from);
  const Coordinates start = is_of_joints ? inverse(machine.kinematics, tip, move.tool_length) : tip;

  std::vector<JointMotion> joints;
  std::vector<double> times;
  for (std::size_t i = 0; i < machine.axes.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    joints.emplace_back(ways[axis], machine.axes[i]);
    joints.back().append_changes(times);
  }
  std::sort(times.begin(), times.end());
  if (times.empty()) return {};
  const double rate = whole / times.back();  // ds/dt.

  std::vector<RapidPart> parts;
  double begin = 0;
  for (const double end : times) {
    if (end - begin <= kSameTime) continue;
    TimePolynomial in_time;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const std::array<double, 4> way = joints[i].way(begin, (begin + end) / 2);
      for (std::size_t k = 0; k < way.size(); ++k) in_time[k][static_cast<Eigen::Index>(i)] = way[k];
    }
    in_time[0] += start;
    RapidPart& part = parts.emplace_back(rapid_part(in_time, end - begin, rate));
    part.path.is_of_joints = is_of_joints;
    part.path.tool_length = move.tool_length;
    begin = end;
  }
  return parts;
}

}  // namespace isocnc::kinematics
