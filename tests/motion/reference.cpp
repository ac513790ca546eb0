#include "tests/motion/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isocnc::motion {
namespace {

/// What bounds x = (ds/dt)^2 and a at a point of the path.
struct Point {
  kinematics::Coordinates first;
  kinematics::Coordinates second;
  double cap = 0;
};

struct Interval {
  double length = 0;
  bool is_level = false;  ///< Within a corner.
  bool stops = false;     ///< At its end.
  Point begin;
  Point end;
};

double feed_speed(const kinematics::Move& move, double length) {
  if (move.feed.kind == kinematics::FeedKind::Rapid) return std::numeric_limits<double>::infinity();
  return move.feed.kind == kinematics::FeedKind::Speed ? move.feed.value : length / move.feed.value;
}

double programmed_length(const kinematics::Move& move) {
  constexpr int kSteps = 20000;
  double length = 0;
  const kinematics::Machine machine;
  for (int i = 0; move.is_arc && i < kSteps; ++i)
    length +=
        (programmed(machine, move, double(i + 1) / kSteps).tip - programmed(machine, move, double(i) / kSteps).tip)
            .norm();
  if (!move.is_arc) length = (move.to.tip - move.from.tip).norm();
  return length > 0 ? length : std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
}

class Optimization {
 public:
  Optimization(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves) : machine_(machine) {
    for (const kinematics::Move& move : moves) feeds_.push_back(feed_speed(move, programmed_length(move)));
  }

  void add(const Stretch& stretch, bool is_corner, double feed, int steps) {
    for (int i = 0; i < stretch.phase_count; ++i) {
      const Phase& phase = stretch.phases[static_cast<std::size_t>(i)];
      add(stretch.path, phase.from, phase.after(phase.duration).from, is_corner, feed, steps);
    }
  }
  void stop() {
    if (!intervals_.empty()) intervals_.back().stops = true;
  }
  double feed(std::size_t tag) const { return feeds_[tag]; }

  double shortest_time() {
    const std::size_t count = intervals_.size();
    std::vector<double> maximum(count + 1, 0);
    for (std::size_t i = count; i-- > 0;) {
      const Interval& interval = intervals_[i];
      const double exit = std::min(interval.stops ? 0 : maximum[i + 1], interval.end.cap);
      maximum[i] = farthest(interval, interval.end, interval.begin, exit, -1);
    }
    double time = 0;
    double entry = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Interval& interval = intervals_[i];
      const double limit = interval.stops || i + 1 == count ? 0 : maximum[i + 1];
      const double exit = std::min(limit, farthest(interval, interval.begin, interval.end, entry, 1));
      time += 2 * interval.length / (std::sqrt(entry) + std::sqrt(exit));
      entry = exit;
    }
    return time;
  }

 private:
  void add(const kinematics::Path& path, double begin, double end, bool is_corner, double feed, int steps) {
    const double step = (end - begin) / steps;
    for (int i = 0; i < steps; ++i)
      intervals_.push_back(
          {step, is_corner, false, point(path, begin + i * step, feed), point(path, begin + (i + 1) * step, feed)});
  }

  Point point(const kinematics::Path& path, double s, double feed) const {
    const kinematics::Jet joints = path.joints_at(machine_.kinematics, s);
    const kinematics::Jet tip = path.tip_at(machine_.kinematics, s);
    const double tip_slope = tip.first.head<3>().norm();
    const double slope = tip_slope > 0 ? tip_slope : tip.first.tail<2>().norm();
    Point result{joints.first, joints.second, std::pow(feed / slope, 2)};
    for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
      const kinematics::AxisLimits& limits = machine_.axes[static_cast<std::size_t>(axis)];
      result.cap = std::min(result.cap, std::pow(limits.speed / joints.first[axis], 2));
      result.cap = std::min(result.cap, limits.acceleration / std::abs(joints.second[axis]));
    }
    return result;
  }

  bool is_possible(const Point& point, double x, double a) const {
    for (int axis = 0; axis < kinematics::kAxisCount; ++axis)
      if (std::abs(point.second[axis] * x + point.first[axis] * a) >
          machine_.axes[static_cast<std::size_t>(axis)].acceleration * (1 + 1e-12))
        return false;
    return true;
  }

  /// Most x at the other end of the interval, by bisection.
  double farthest(const Interval& interval, const Point& here, const Point& there, double x, int sense) const {
    if (interval.is_level) return std::min(x, there.cap);
    double minimum = std::min(x, there.cap);
    double maximum = std::min(there.cap, 1e12);
    const auto fits = [&](double other) {
      const double a = sense * (other - x) / (2 * interval.length);
      return is_possible(here, x, a) && is_possible(there, other, a);
    };
    if (fits(maximum)) return maximum;
    for (int i = 0; i < 60; ++i) {
      const double middle = (minimum + maximum) / 2;
      (fits(middle) ? minimum : maximum) = middle;
    }
    return minimum;
  }

  const kinematics::Machine& machine_;
  std::vector<double> feeds_;
  std::vector<Interval> intervals_;
};

bool is_corner(const Stretch& stretch) {
  return stretch.path.kind == kinematics::PathKind::Polynomial && !stretch.path.c[2].isZero(0);
}

}  // namespace

double reference_time(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves,
                      const std::vector<Stretch>& stretches, int steps) {
  Optimization optimization(machine, moves);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    double feed = optimization.feed(stretch.tag);
    const bool rounds = is_corner(stretch);
    if (rounds) {
      if (i > 0) feed = std::min(feed, optimization.feed(stretches[i - 1].tag));
      if (i + 1 < stretches.size()) feed = std::min(feed, optimization.feed(stretches[i + 1].tag));
    }
    optimization.add(stretch, rounds, feed, steps);
    const Sample end = stretch.at(machine.kinematics, stretch.start + stretch.duration);
    if (end.joint_speeds.norm() < 1e-6) optimization.stop();
  }
  return optimization.shortest_time();
}

}  // namespace isocnc::motion
