#include "interpreter/removal/raised_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpreter/removal/tip_paths.h"

namespace isocnc::removal {

using geometry::Vec3;
using stock::SweepPath;

/// Heights that differ by less are the same, mm.
static constexpr double kSameHeight = 1e-6;

RaisedMotion::RaisedMotion(const ProgrammedMotion& motion, const Vec3& up, const Kind& kind)
    : motion_(motion), up_(up) {
  const double rise = height(motion.to) - height(motion.from);
  if (rise > kSameHeight) return;
  if (kind.starts_inside || rise > -kSameHeight) {
    way_ = Way::Level;
  } else if (motion.is_line && !kind.axes_alone) {
    way_ = Way::Line;
  } else if (motion.is_line && up.z() > 1 - kSameHeight) {
    way_ = Way::AxesAlone;  // Along another direction than Z, an axis that arrives first leads lower than the end.
  }
}

double RaisedMotion::most_rise() const {
  if (way_ == Way::Level) return std::numeric_limits<double>::infinity();
  return height(motion_.from) - height(motion_.to);
}

Vec3 RaisedMotion::raised(const Vec3& tip, double rise) const {
  if (way_ == Way::Level) return tip + rise * up_;
  if (way_ == Way::AxesAlone) return tip + std::max(0.0, height(motion_.to) + rise - height(tip)) * up_;
  const Vec3 way = motion_.to - motion_.from;
  return tip + rise * std::clamp((tip - motion_.from).dot(way) / way.squaredNorm(), 0.0, 1.0) * up_;
}

void RaisedMotion::append(const SweepPath& tip, double rise, std::vector<SweepPath>& paths) const {
  if (way_ == Way::Level) return paths.push_back(moved(tip, rise * up_));
  if (const auto* const turning = std::get_if<stock::TurningPath>(&tip)) {
    stock::TurningPath path = *turning;
    path.from.origin = raised(turning->from.origin, rise);
    path.to.origin = raised(turning->to.origin, rise);
    if (way_ == Way::AxesAlone) {  // Between them it may be as little higher as at the lower one.
      const double least =
          std::min(height(path.from.origin - turning->from.origin), height(path.to.origin - turning->to.origin));
      path.from.origin = turning->from.origin + least * up_;
      path.to.origin = turning->to.origin + least * up_;
    }
    return paths.push_back(path);
  }
  const Vec3 from = start_of(tip).origin;
  const Vec3 to = end_of(tip);
  const auto append = [&](const Vec3& begin, const Vec3& end) {
    paths.push_back(stock::StraightPath{{raised(begin, rise), axis_of(tip)}, raised(end, rise)});
  };
  // An axis that goes down by itself stops at its end, while the others go on.
  const double level = height(motion_.to) + rise;
  const double share = (level - height(from)) / (height(to) - height(from));
  if (way_ != Way::AxesAlone || !(share > 0 && share < 1)) return append(from, to);
  const Vec3 stop = from + share * (to - from);
  append(from, stop);
  append(stop, to);
}

}  // namespace isocnc::removal
