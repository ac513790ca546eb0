#include "tests/motion/jerk_limited_reference.h"

#include <algorithm>
#include <cmath>

namespace isocnc::motion {
namespace {

/// What the axes feel at a place, for each power of the speed.
struct Place {
  double s = 0;
  double tip = 0;  ///< Of the tip's way for each unit of s.
  kinematics::Coordinates first;
  kinematics::Coordinates second;
  kinematics::Coordinates third;
  double x = 0;
};

class Ascent {
 public:
  Ascent(const kinematics::Machine& machine, double feed) : machine_(machine), feed_(feed) {}

  void add(const kinematics::Path& path, double local, double s, double x) {
    constexpr double kStep = 1e-4;
    const kinematics::Jet jet = path.joints_at(machine_.kinematics, local);
    const kinematics::Coordinates before = path.joints_at(machine_.kinematics, local - kStep).second;
    const kinematics::Coordinates after = path.joints_at(machine_.kinematics, local + kStep).second;
    places_.push_back({s, path.tip_at(machine_.kinematics, local).first.head<3>().norm(), jet.first, jet.second,
                       (after - before) / (2 * kStep), x});
  }

  double shortest_time() {
    const int count = static_cast<int>(places_.size());
    for (double part = 0.3; part > 1e-3; part /= 2)
      for (bool gains = true; gains;) {
        gains = false;
        for (int width = count / 2; width >= 3; width /= 2)
          for (int center = 0; center < count; center += std::max(1, width / 3))
            if (raise(center, width, part)) gains = true;
      }
    double time = 0;
    for (std::size_t i = 0; i + 1 < places_.size(); ++i)
      time += 2 * (places_[i + 1].s - places_[i].s) / (std::sqrt(places_[i].x) + std::sqrt(places_[i + 1].x));
    return time;
  }

 private:
  bool raise(int center, int width, double part) {
    const int begin = std::max(1, center - width);
    const int end = std::min(static_cast<int>(places_.size()) - 1, center + width + 1);
    std::vector<double> saved;
    for (int i = begin; i < end; ++i) {
      Place& place = places_[static_cast<std::size_t>(i)];
      saved.push_back(place.x);
      const double off = static_cast<double>(i - center) / width;
      place.x *= 1 + part * std::pow(std::max(1 - off * off, 0.0), 3);
    }
    bool fits = true;
    for (int i = std::max(1, begin - 1); fits && i < std::min(static_cast<int>(places_.size()) - 1, end + 1); ++i)
      fits = is_possible(static_cast<std::size_t>(i));
    if (!fits)
      for (int i = begin; i < end; ++i)
        places_[static_cast<std::size_t>(i)].x = saved[static_cast<std::size_t>(i - begin)];
    return fits;
  }

  bool is_possible(std::size_t i) const {
    const Place& place = places_[i];
    const double back = place.s - places_[i - 1].s;
    const double ahead = places_[i + 1].s - place.s;
    const double arriving = (place.x - places_[i - 1].x) / (2 * back);
    const double leaving = (places_[i + 1].x - place.x) / (2 * ahead);
    const double speed = std::sqrt(place.x);
    const double jerk = speed * (leaving - arriving) / ((back + ahead) / 2);
    const double acceleration = (arriving * ahead + leaving * back) / (back + ahead);
    if (speed * place.tip > feed_) return false;
    for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
      const kinematics::AxisLimits& limits = machine_.axes[static_cast<std::size_t>(axis)];
      const double first = place.first[axis];
      const double second = place.second[axis];
      if (std::abs(first * speed) > limits.speed) return false;
      if (std::abs(second * place.x + first * acceleration) > limits.acceleration) return false;
      const double joint_jerk = place.third[axis] * place.x * speed + 3 * second * speed * acceleration + first * jerk;
      if (limits.jerk && std::abs(joint_jerk) > *limits.jerk) return false;
    }
    return true;
  }

  const kinematics::Machine& machine_;
  double feed_;
  std::vector<Place> places_;
};

}  // namespace

double jerk_limited_reference_time(const kinematics::Machine& machine, double feed,
                                   const std::vector<Stretch>& stretches, int nodes) {
  constexpr double kSlower = 0.1;  // Than the planner, squared: a motion in slow motion is within all limits.
  Ascent ascent(machine, feed);
  const double step = (stretches.back().start + stretches.back().duration) / nodes;
  double begin = 0;  // s where the stretch begins.
  int node = 0;
  for (const Stretch& stretch : stretches) {
    double start = stretch.start;
    const double from = stretch.phases[0].from;
    Phase end;
    for (int i = 0; i < stretch.phase_count; ++i) {
      const Phase& phase = stretch.phases[static_cast<std::size_t>(i)];
      for (; node <= nodes && node * step <= start + phase.duration; ++node) {
        const Phase now = phase.after(std::max(node * step - start, 0.0));
        ascent.add(stretch.path, now.from, begin + now.from - from, kSlower * now.speed * now.speed);
      }
      start += phase.duration;
      end = phase.after(phase.duration);
    }
    begin += end.from - from;
  }
  return ascent.shortest_time();
}

}  // namespace isocnc::motion
