#include "interpreter/motion/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isocnc::motion {

/// Minimum number of unplanned spans that triggers planning. Each planning passes over all unplanned spans, so it is
/// done for many at once.
static constexpr std::size_t kPlanningBatch = 256;
/// Maximum number of unplanned spans. Look-ahead is limited to half of it, even if the machine cannot stop within that.
static constexpr std::size_t kMaxSpans = 16384;
/// Maximum length of a phase that is a rounding error, as a part of its span.
static constexpr double kNoPart = 1e-14;
/// Maximum ratio of lengths that counts as 1.
static constexpr double kRounding = 1 + 1e-9;
/// Search for the peak of the speed on a span of a curve by false position: maximum number of steps, and the relative
/// precision, of the peak or of the length that it leaves, that ends them.
static constexpr int kPeakSteps = 16;
static constexpr double kPeakPrecision = 1e-4;

Profile::Profile() : batch_(kPlanningBatch) {}

Profile::SpeedSpan& Profile::add(SpanKind kind, double begin, double length, double cap) {
  SpeedSpan& span = spans_.emplace_back();
  span.kind = kind;
  span.begin = begin;
  span.length = length;
  span.cap = cap;
  span.entry_cap = std::min(last_cap_, cap);
  last_cap_ = cap;
  return span;
}

void Profile::append_line(double begin, double length, const kinematics::LineLimits& limits) {
  SpeedSpan& span = add(SpanKind::Line, begin, length, limits.cap);
  span.acceleration = limits.acceleration;
  span.fall = limits.fall;
}

void Profile::append_curve(double begin, double length, double cap, std::span<const kinematics::CurveBound> forward,
                           std::span<const kinematics::CurveBound> backward) {
  SpeedSpan& span = add(SpanKind::Curve, begin, length, cap);
  span.bounds = first_bound_ + bounds_.size();
  const auto keep = [&](std::span<const kinematics::CurveBound> bounds) {
    bounds_.insert(bounds_.end(), bounds.begin(), bounds.end());
    return static_cast<std::uint8_t>(bounds.size());
  };
  span.forward_count = keep(forward);
  span.backward_count = keep(backward);
}

void Profile::append_level(double length, double cap) { add(SpanKind::Level, 0, length, cap); }

void Profile::append_phase(double length, const Phase& phase) {
  SpeedSpan& span = add(SpanKind::Phase, phase.from, length, 0);
  span.phases[span.phase_count++] = phase;
}

void Profile::come_to_rest() {
  look_back_from_rest();
  plan_until(spans_.size(), 0);
  last_cap_ = 0;
  batch_ = kPlanningBatch;  // What follows does not depend on what was before.
}

/// Returns the maximum of x at one end of a line with x at the other. The acceleration is constant on the line, and the
/// limits permit it at the larger x, hence everywhere.
static double reach_on_line(const Profile::SpeedSpan& span, double x) {
  if (span.fall == 0) return x + 2 * span.acceleration * span.length;
  const double gain = 2 * span.acceleration * span.length;
  return x + gain * std::max(1 - x * span.fall, 0.0) / (1 + gain * span.fall);
}

std::span<const kinematics::CurveBound> Profile::bounds(const SpeedSpan& span, kinematics::Direction direction) const {
  const kinematics::CurveBound* const first = bounds_.data() + (span.bounds - first_bound_);
  if (direction == kinematics::Direction::Forward) return {first, span.forward_count};
  return {first + span.forward_count, span.backward_count};
}

/// Returns the maximum of x at one end of a span with x at the other: at the end for Direction::Forward, at the start
/// for Direction::Backward.
double Profile::reach(const SpeedSpan& span, double x, kinematics::Direction direction) const {
  switch (span.kind) {
    case SpanKind::Line:
      return reach_on_line(span, x);
    case SpanKind::Curve:
      return kinematics::reach(bounds(span, direction), span.length, x);
    case SpanKind::Level:
    case SpanKind::Phase:
      break;
  }
  return x;
}

void Profile::look_back_from_rest() {
  double exit = 0;
  for (std::size_t i = spans_.size(); i-- > planned_;) {
    SpeedSpan& span = spans_[i];
    exit = span.entry = std::min(span.entry_cap, reach(span, exit, kinematics::Direction::Backward));
  }
}

/// Passes backward twice: from a stop at the end of the known path, and from the maximum speed there. Where both passes
/// give the same x, and before, no later span can change x. Returns the last span whose `entry` is final in this sense.
std::size_t Profile::look_back() {
  look_back_from_rest();
  double exit = last_cap_;
  std::size_t i = spans_.size();
  while (i-- > planned_) {
    const SpeedSpan& span = spans_[i];
    exit = std::min(span.entry_cap, reach(span, exit, kinematics::Direction::Backward));
    if (exit == span.entry) return i;
  }
  return planned_;
}

void Profile::plan_ahead() {
  std::size_t end = look_back();
  if (spans_.size() - end > kMaxSpans / 2) end = spans_.size() - kMaxSpans / 2;
  if (end > planned_) plan_until(end, spans_[end].entry);
  batch_ = std::max(kPlanningBatch, 2 * (spans_.size() - planned_));
}

void Profile::plan_until(std::size_t end, double exit) {
  for (; planned_ < end; ++planned_) {
    SpeedSpan& span = spans_[planned_];
    const double max_exit = planned_ + 1 < end ? spans_[planned_ + 1].entry : exit;
    const double entry = speed_square_;
    const double reached = reach(span, entry, kinematics::Direction::Forward);
    speed_square_ = std::min(max_exit, reached);
    const bool is_reach = reached <= max_exit || (entry == span.entry && entry < span.entry_cap);
    assign_times(span, entry, speed_square_, is_reach);
  }
}

/// The course of x on a span: acceleration, constant speed, deceleration.
struct Course {
  double up = 0;                 ///< Length of the acceleration, mm.
  double up_acceleration = 0;    ///< Acceleration, mm/s^2.
  double peak = 0;               ///< x at constant speed, mm^2/s^2.
  double down = 0;               ///< Length of the deceleration, mm.
  double down_acceleration = 0;  ///< Acceleration while slowing down, mm/s^2; not positive.
};

static double ramp_length(double from, double to, double acceleration) {
  return to > from ? (to - from) / (2 * acceleration) : 0;
}

static Course over_peak(double peak, double entry, double exit, double up, double down) {
  return {ramp_length(entry, peak, up), up, peak, ramp_length(exit, peak, down), -down};
}

/// Returns the course with one acceleration on the whole span, which reach() has found possible.
static Course straight(double length, double entry, double exit) {
  const double acceleration = (exit - entry) / (2 * length);
  return exit > entry ? Course{length, acceleration, exit, 0, 0} : Course{0, 0, entry, length, acceleration};
}

static Course on_line(const Profile::SpeedSpan& span, double entry, double exit) {
  double peak = (entry + exit) / 2 + span.acceleration * span.length;
  if (span.fall > 0) peak /= 1 + span.acceleration * span.length * span.fall;
  peak = std::max({std::min(span.cap, peak), entry, exit});
  const double acceleration = span.acceleration * (1 - span.fall * peak);
  const Course course = over_peak(peak, entry, exit, acceleration, acceleration);
  // Near the x where the permitted acceleration becomes 0, rounding can make the course longer than the span.
  const bool fits = span.fall == 0 || course.up + course.down <= span.length * kRounding;
  return fits ? course : straight(span.length, entry, exit);
}

static Course on_curve(std::span<const kinematics::CurveBound> forward,
                       std::span<const kinematics::CurveBound> backward, double cap, double length, double entry,
                       double exit) {
  const auto over = [&](double peak) {
    return over_peak(peak, entry, exit, kinematics::acceleration(forward, entry, peak),
                     kinematics::acceleration(backward, exit, peak));
  };
  const auto excess = [&](const Course& course) { return course.up + course.down - length; };
  const Course at_cap = over(cap);
  double high = cap;
  double high_excess = excess(at_cap);
  if (high_excess <= 0) return at_cap;
  double low = std::max(entry, exit);
  const double up = kinematics::acceleration(forward, entry, low);
  const double down = kinematics::acceleration(backward, exit, low);
  double low_excess = excess(over_peak(low, entry, exit, up, down));
  // The higher the peak, the less the accelerations, so that no peak is above that of these two.
  const double highest = (2 * length + entry / up + exit / down) / (1 / up + 1 / down);
  if (highest < high) {
    high = std::max(highest, low);
    const Course course = over(high);
    high_excess = excess(course);
    if (high_excess <= 0 && high > low) return course;
  }
  Course best = straight(length, entry, exit);
  for (int i = 0; i < kPeakSteps && low_excess < -kPeakPrecision * length && high - low > kPeakPrecision * high; ++i) {
    // A little below the length of the span, so that rounding makes no course too long. Near the cap a course can
    // become as long as one likes: no steps that are small only because of that.
    high_excess = std::min(high_excess, length);
    const double aim = -kPeakPrecision / 2 * length;
    const double peak = low + (aim - low_excess) / (high_excess - low_excess) * (high - low);
    const Course course = over(peak);
    const double found = excess(course);
    if (found <= 0) {
      best = course;
      low = peak;
      low_excess = found;
      high_excess /= 2;  // Otherwise the upper end would stay where it is: a course grows ever faster with its peak.
    } else {
      high = peak;
      high_excess = found;
    }
  }
  return best;
}

/// Computes the phases of a span. `is_reach`: the span changes the speed by its maximum, so its course is determined.
void Profile::assign_times(SpeedSpan& span, double entry, double exit, bool is_reach) {
  if (span.kind == SpanKind::Phase) {
    span.duration = span.phases[0].duration;
    span.start = std::exchange(time_, time_ + span.duration);
    return;
  }
  Course course{.peak = entry};
  if (span.kind == SpanKind::Line) course = on_line(span, entry, exit);
  if (span.kind == SpanKind::Curve)
    course = is_reach ? straight(span.length, entry, exit)
                      : on_curve(bounds(span, kinematics::Direction::Forward),
                                 bounds(span, kinematics::Direction::Backward), span.cap, span.length, entry, exit);
  double s = span.begin;
  const auto go = [&](double length, double from, double to, double acceleration) {
    if (length <= kNoPart * span.length) return;
    const double time = 2 * length / (from + to);
    span.phases[span.phase_count++] = {time, s, from, acceleration};
    span.duration += time;
    s += length;
  };
  const double top = std::sqrt(course.peak);
  go(course.up, std::sqrt(entry), top, course.up_acceleration);
  go(span.length - course.up - course.down, top, top, 0);
  go(course.down, top, std::sqrt(exit), course.down_acceleration);
  span.start = time_;
  time_ += span.duration;
}

bool Profile::holds_much_past() const { return handed_out_ >= kPlanningBatch || handed_out_ == spans_.size(); }

void Profile::forget_handed_out() {
  if (handed_out_ == 0) return;
  const std::size_t count = std::exchange(handed_out_, 0);
  spans_.erase(spans_.begin(), spans_.begin() + static_cast<std::ptrdiff_t>(count));
  planned_ -= count;
  const auto first =
      std::find_if(spans_.begin(), spans_.end(), [](const SpeedSpan& span) { return span.kind == SpanKind::Curve; });
  const std::size_t kept = first == spans_.end() ? first_bound_ + bounds_.size() : first->bounds;
  bounds_.erase(bounds_.begin(), bounds_.begin() + static_cast<std::ptrdiff_t>(kept - first_bound_));
  first_bound_ = kept;
}

}  // namespace isocnc::motion
