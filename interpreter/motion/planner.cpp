#include "interpreter/motion/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace isocnc::motion {

/// Planning looks back over all that is not planned yet: it pays to let some gather.
static constexpr std::size_t kBatch = 256;
/// Look-ahead ends here, even if the machine cannot stop within so many spans.
static constexpr std::size_t kMostSpans = 16384;
/// A curve's limits are taken over pieces that turn by no more than this, radians: fine where the curve takes more
/// than a part of the acceleration at the programmed feed, else coarse, for then the feed decides nearly everywhere.
static constexpr double kFineTurn = 2.5 * std::numbers::pi / 180;
static constexpr double kCoarseTurn = 10 * std::numbers::pi / 180;
static constexpr double kSmallPart = 0.1;
/// Of one element: more than rotary axes turn in one move.
static constexpr int kMostPieces = 5'000;
/// Shorter pieces are none, mm or degrees.
static constexpr double kNoLength = 1e-12;
/// A move that begins elsewhere than where the machine is does not follow smoothly, mm or degrees.
static constexpr double kSamePlace = 1e-6;

/// Phases over a smaller part of their span are rounding errors.
static constexpr double kNoPart = 1e-14;
/// How the peak of the speed within a piece of a curve is sought: bisections, and the relative precision that ends
/// them.
static constexpr int kPeakSteps = 16;
static constexpr double kPeakPrecision = 1e-4;

static double square(double value) { return value * value; }

Planner::Planner(Machine machine) : machine_(std::move(machine)), batch_(kBatch) {}

static bool differ(const geometry::Pose& a, const geometry::Pose& b) {
  return (coordinates(a) - coordinates(b)).cwiseAbs().maxCoeff() > kSamePlace;
}

void Planner::push(const Move& move) {
  take_elements();
  if (has_end_ && differ(end_, move.from)) come_to_rest();
  end_ = move.to;
  has_end_ = true;
  splitter_.take(machine_, move);
  if (!splitter_.has_more() && move.exact_stop) come_to_rest();
}

void Planner::rest(double seconds) {
  take_elements();
  come_to_rest();
  time_ += seconds;
}

void Planner::take_elements() {
  while (splitter_.has_more()) take(splitter_.next(machine_));
}

/// Elements enter in order; each is appended when the next one, or a stop, tells how it ends.
void Planner::take(Element element) {
  if (handed_out_ >= kBatch || handed_out_ == spans_.size()) forget_handed_out();
  if (has_last_) join(element);
  last_ = element;
  has_last_ = true;
  if (last_.stops) {
    come_to_rest();
  } else if (spans_.size() - planned_ >= batch_) {
    plan_ahead();
  }
}

/// Appends the last element, now that its end is known, and the corner to the next one, whose begin it moves.
void Planner::join(Element& next) {
  const Corner corner = motion::corner(machine_, last_, next);
  if (corner.junction == Junction::Stop) return come_to_rest();
  const double depth = corner.blend.length / 2;
  last_.end -= depth;
  next.begin += depth;
  if (corner.junction == Junction::Smooth) return append(last_);
  const bool ends_move = std::exchange(last_.ends_move, false);
  append(last_);
  last_.ends_move = ends_move;
  append_corner(corner.blend, last_, next);
}

void Planner::come_to_rest() {
  if (has_last_) append(last_);
  has_last_ = false;
  look_back_from_rest();
  plan_until(spans_.size(), 0);
  last_cap_ = 0;
}

void Planner::append(const Element& element) {
  if (element.end - element.begin <= kNoLength) return;
  if (element.joints_are_straight) {
    append_line(element);
  } else {
    append_curve(element);
  }
}

Planner::Span& Planner::add(SpanKind kind, const Element& element, double cap) {
  Span& span = spans_.emplace_back();
  span.kind = kind;
  span.tag = element.tag;
  span.cap = cap;
  span.entry_cap = std::min(last_cap_, cap);
  last_cap_ = cap;
  return span;
}

void Planner::append_line(const Element& element) {
  Coordinates slope = element.path.c[1];
  if (element.space == Space::Either && machine_.kinematics.kind == MachineKind::Table)
    slope.head<3>() =
        turn_to_joints(machine_.kinematics, element.path.c[0][kB], element.path.c[0][kC]) * element.path.c[1].head<3>();
  const LineLimits limits = line_limits(machine_, slope);
  Span& span = add(SpanKind::Line, element, std::min(limits.cap, square(element.feed)));
  span.ends_move = element.ends_move;
  span.begin = element.begin;
  span.length = element.end - element.begin;
  span.acceleration = limits.acceleration;
  span.path = element.path;
}

/// How much a curve turns for each unit of s, radians.
static double turning(const Path& path) {
  if (path.kind == PathKind::Circle) return std::abs(path.omega);
  return (std::abs(path.c[1][kB]) + std::abs(path.c[1][kC])) * std::numbers::pi / 180;
}

/// Into how many pieces an element that turns by `turn` is cut, where the linear joints swing on about `radius`.
static int piece_count(const Machine& machine, double turn, double radius, double length, double square) {
  double weakest = machine.axes[kX].acceleration;
  for (const Axis axis : {kY, kZ}) weakest = std::min(weakest, machine.axes[axis].acceleration);
  const double bend = radius * (turn / length) * (turn / length);
  const double most = bend * square > kSmallPart * weakest ? kFineTurn : kCoarseTurn;
  return part_count(turn / most, kMostPieces);
}

void Planner::append_curve(const Element& element) {
  const double length = element.end - element.begin;
  const double most = square(element.feed / element.steepest);
  const Coordinates middle = element.path.at((element.begin + element.end) / 2).value;
  const double radius = element.path.kind == PathKind::Circle
                            ? element.path.c[1].norm()
                            : lever(machine_.kinematics, middle.head<3>(), element.path.tool_length);
  const int count = piece_count(machine_, length * turning(element.path), radius, length, most);
  for (int i = 0; i < count; ++i) {
    const double begin = element.begin + length * i / count;
    const double end = element.begin + length * (i + 1) / count;
    const CurveLimits& limits = curves_.emplace_back(machine_, element.path, begin, end);
    Span& span = add(SpanKind::Curve, element, std::min(limits.cap(), most));
    span.ends_move = element.ends_move && i + 1 == count;
    span.begin = begin;
    span.length = end - begin;
    span.path = element.path;
    span.curve = first_curve_ + curves_.size() - 1;
  }
}

void Planner::append_corner(const Blend& blend, const Element& before, const Element& after) {
  Span& span = add(SpanKind::Corner, before, blend.cap);
  span.ends_move = before.ends_move;
  span.next_tag = after.tag;
  span.length = blend.length;
  span.path = blend.path;
}

/// Most x at a span's begin, from which x = `exit` at its end can be kept.
double Planner::before(const Span& span, double exit) const {
  switch (span.kind) {
    case SpanKind::Line:
      return exit + 2 * span.acceleration * span.length;
    case SpanKind::Curve:
      return curves_[span.curve - first_curve_].reach(exit, Direction::Backward);
    case SpanKind::Corner:
      break;
  }
  return exit;
}

/// Most x at a span's end with x = `entry` at its begin.
double Planner::after(const Span& span, double entry) const {
  switch (span.kind) {
    case SpanKind::Line:
      return entry + 2 * span.acceleration * span.length;
    case SpanKind::Curve:
      return curves_[span.curve - first_curve_].reach(entry, Direction::Forward);
    case SpanKind::Corner:
      break;
  }
  return entry;
}

void Planner::look_back_from_rest() {
  double exit = 0;
  for (std::size_t i = spans_.size(); i-- > planned_;) {
    Span& span = spans_[i];
    exit = span.entry = std::min(span.entry_cap, before(span, exit));
  }
}

/// Looks back twice, from a stop at the end and from going on there as fast as may be. Where both agree, and before, x
/// is what it will be whatever follows. Returns the last span whose `entry` is such.
std::size_t Planner::look_back() {
  look_back_from_rest();
  double exit = last_cap_;
  std::size_t i = spans_.size();
  while (i-- > planned_) {
    const Span& span = spans_[i];
    exit = std::min(span.entry_cap, before(span, exit));
    if (exit == span.entry) return i;
  }
  return planned_;
}

void Planner::plan_ahead() {
  forget_handed_out();
  std::size_t end = look_back();
  if (spans_.size() - end > kMostSpans / 2) end = spans_.size() - kMostSpans / 2;
  if (end > planned_) plan_until(end, spans_[end].entry);
  batch_ = std::max(kBatch, 2 * (spans_.size() - planned_));
}

void Planner::plan_until(std::size_t end, double exit) {
  for (; planned_ < end; ++planned_) {
    Span& span = spans_[planned_];
    const double most = planned_ + 1 < end ? spans_[planned_ + 1].entry : exit;
    const double entry = speed_square_;
    speed_square_ = std::min(most, after(span, entry));
    give_time(span, entry, speed_square_);
  }
}

/// How x goes through a span: up, level, and down again.
struct Course {
  double up = 0;  ///< Length, and acceleration.
  double up_acceleration = 0;
  double peak = 0;  ///< x between.
  double down = 0;
  double down_acceleration = 0;  ///< Not positive.
};

static double way(double from, double to, double acceleration) {
  return to > from ? (to - from) / (2 * acceleration) : 0;
}

static Course over_peak(double peak, double entry, double exit, double up, double down) {
  return {way(entry, peak, up), up, peak, way(exit, peak, down), -down};
}

static Course on_line(double acceleration, double cap, double length, double entry, double exit) {
  const double peak = std::min(cap, (entry + exit) / 2 + acceleration * length);
  return over_peak(std::max({peak, entry, exit}), entry, exit, acceleration, acceleration);
}

/// At one acceleration all the way: what CurveLimits::reach() found possible.
static Course straight(double length, double entry, double exit) {
  const double acceleration = (exit - entry) / (2 * length);
  return exit > entry ? Course{length, acceleration, exit, 0, 0} : Course{0, 0, entry, length, acceleration};
}

static Course on_curve(const CurveLimits& limits, double cap, double length, double entry, double exit) {
  const auto over = [&](double peak) {
    return over_peak(peak, entry, exit, limits.acceleration(entry, peak, Direction::Forward),
                     limits.acceleration(exit, peak, Direction::Backward));
  };
  const auto fits = [&](const Course& course) { return course.up + course.down <= length; };
  double least = std::max(entry, exit);
  Course best = over(cap);
  if (fits(best)) return best;
  best = straight(length, entry, exit);
  double most = cap;
  for (int i = 0; i < kPeakSteps && most - least > kPeakPrecision * most; ++i) {
    const double middle = (least + most) / 2;
    const Course course = over(middle);
    const bool is_better = fits(course);
    if (is_better) best = course;
    (is_better ? least : most) = middle;
  }
  return best;
}

void Planner::give_time(Span& span, double entry, double exit) {
  Course course{.peak = entry};
  if (span.kind == SpanKind::Line) course = on_line(span.acceleration, span.cap, span.length, entry, exit);
  if (span.kind == SpanKind::Curve)
    course = on_curve(curves_[span.curve - first_curve_], span.cap, span.length, entry, exit);
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

/// Half of a corner belongs to the move before it, half to the next.
static void keep_half(Stretch& stretch, bool second) {
  Phase& phase = stretch.phases[0];
  stretch.duration = phase.duration /= 2;
  if (!second) return;
  stretch.start += phase.duration;
  phase.from += phase.duration * phase.speed;
}

const Stretch* Planner::next() {
  while (handed_out_ == planned_) {
    if (!splitter_.has_more()) return nullptr;
    take(splitter_.next(machine_));
  }
  const Span& span = spans_[handed_out_];
  stretch_ = {.tag = span.tag,
              .ends_move = span.ends_move,
              .start = span.start,
              .duration = span.duration,
              .path = span.path,
              .phases = span.phases,
              .phase_count = span.phase_count};
  if (span.kind == SpanKind::Corner && span.tag != span.next_tag) {
    keep_half(stretch_, half_out_);
    if (half_out_) stretch_.tag = span.next_tag;
    if (half_out_) stretch_.ends_move = false;
    half_out_ = !half_out_;
  }
  if (!half_out_) ++handed_out_;
  return &stretch_;
}

void Planner::forget_handed_out() {
  if (handed_out_ == 0) return;
  spans_.erase(spans_.begin(), spans_.begin() + static_cast<std::ptrdiff_t>(handed_out_));
  planned_ -= handed_out_;
  handed_out_ = 0;
  const auto first =
      std::find_if(spans_.begin(), spans_.end(), [](const Span& span) { return span.kind == SpanKind::Curve; });
  const std::size_t kept = first == spans_.end() ? first_curve_ + curves_.size() : first->curve;
  curves_.erase(curves_.begin(), curves_.begin() + static_cast<std::ptrdiff_t>(kept - first_curve_));
  first_curve_ = kept;
}

}  // namespace isocnc::motion
