#include "debugger/debuggee/surroundings_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpreter/verification/motion_bounds.h"

namespace isocnc::debuggee {

using verification::Neighbor;

/// mm, or mm^3.
static constexpr double kSurely = 1e-6;

double SurroundingsLimit::margin(const std::vector<Neighbor>& neighbors) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool is_of_depth = of == LimitedQuantity::Depth;
  double nearest = kFar;
  for (const Neighbor& each : neighbors) nearest = std::min(nearest, is_of_depth ? each.distance : each.clearance);
  if (!is_of_depth) return is_from_below ? value - nearest : nearest - value;
  if (value < 0) return is_from_below ? -kFar : kFar;  // A depth is never negative.
  return is_from_below ? nearest + value : -value - nearest;
}

bool SurroundingsLimit::is_beyond(const std::vector<Neighbor>& neighbors) const { return margin(neighbors) < -kSurely; }

bool SurroundingsLimit::is_beyond(double number) const {
  return is_either_way || (is_from_below ? number > value + kSurely : number < value - kSurely);
}

std::vector<double> crossings_of(const SurroundingsLimit& limit, const motion::Stretch& stretch,
                                 const verification::BodyPairs& bodies, const kinematics::Kinematics& kinematics) {
  constexpr double kResolution = 0.1;  // mm
  constexpr double kLongestStep = 2;   // Within an obstacle, where a depth may jump; mm.
  constexpr int kMaxSteps = 10'000;
  constexpr int kHalvings = 48;
  const double begin = stretch.phases[0].from;
  const double end = stretch.parameter_at(stretch.start + stretch.duration);
  const verification::MotionBounds bounds = verification::motion_bounds(kinematics, stretch.path, begin, end);
  double rate = 0;  // mm per unit of the parameter.
  for (const verification::BodyPair& pair : bodies.pairs) rate = std::max(rate, pair.speed(bounds));
  const auto neighbors_at = [&](double s) {
    return verification::neighbors_at(bodies, kinematics, stretch.path.joints_at(kinematics, s).value);
  };
  std::vector<double> times;
  std::vector<Neighbor> neighbors = neighbors_at(begin);
  bool was_beyond = limit.is_beyond(neighbors);
  for (double s = begin; s < end;) {
    const bool is_within = !neighbors.empty() && neighbors.front().distance < 0;
    const double free = std::abs(limit.margin(neighbors));
    const double travel = std::max(is_within ? std::min(free, kLongestStep) : free, kResolution);
    const double step = std::max(travel / rate, (end - begin) / kMaxSteps);
    const double next = s + step < end ? s + step : end;
    neighbors = neighbors_at(next);
    const bool is_beyond = limit.is_beyond(neighbors);
    if (is_beyond && !was_beyond) {
      double before = s;
      double after = next;
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = before + (after - before) / 2;
        (limit.is_beyond(neighbors_at(middle)) ? after : before) = middle;
      }
      times.push_back(after < end ? stretch.time_at(after) : stretch.start + stretch.duration);
    }
    was_beyond = is_beyond;
    s = next;
  }
  return times;
}

}  // namespace isocnc::debuggee
