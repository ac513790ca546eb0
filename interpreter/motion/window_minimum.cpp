#include "interpreter/motion/window_minimum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpreter/kinematics/numbers.h"

namespace isocnc::motion {

/// Minimum number of sources that triggers widening. Each widening passes over all sources, so it is done for many at
/// once.
static constexpr std::size_t kWidenBatch = 256;
/// Maximum number of sources that the limits of one piece reach back over, and so of sources held. A piece that would
/// reach over more is slowed down, so that these sources take at least half a window.
static constexpr std::size_t kMaxSources = 16384;
/// Maximum number of intervals merged into one cell, so that every cell is finished at some time.
static constexpr int kMaxParts = 64;

void WindowMinimum::RunningMinimum::insert(double value, double until) {
  const auto is_more = [](const Entry& entry, double than) { return entry.value > than; };
  const auto at = std::lower_bound(entries_.begin(), entries_.end(), value, is_more);
  if (at != entries_.end() && at->until >= until) return;
  const auto last = at != entries_.end() && at->value == value ? at + 1 : at;
  auto first = at;
  while (first != entries_.begin() && (first - 1)->until <= until) --first;
  if (first == last) {
    entries_.insert(first, {value, until});
  } else {
    *first = {value, until};
    entries_.erase(first + 1, last);
  }
}

void WindowMinimum::RunningMinimum::pass(double place) {
  while (!entries_.empty() && entries_.back().until <= place) entries_.pop_back();
}

void WindowMinimum::RunningLimits::insert(const kinematics::LineLimits& limits, double until) {
  cap_.insert(limits.cap, until);
  acceleration_.insert(limits.acceleration, until);
  if (limits.fall > 0) fall_.insert(-limits.fall, until);
}

void WindowMinimum::RunningLimits::pass(double place) {
  cap_.pass(place);
  acceleration_.pass(place);
  fall_.pass(place);
}

kinematics::LineLimits WindowMinimum::RunningLimits::limits() const {
  return {cap_.minimum(kinematics::kInfinity), acceleration_.minimum(kinematics::kInfinity), -fall_.minimum(0)};
}

double WindowMinimum::RunningLimits::until() const {
  return std::min({cap_.until(kinematics::kInfinity), acceleration_.until(kinematics::kInfinity),
                   fall_.until(kinematics::kInfinity)});
}

/// Returns the stricter of both limits.
static kinematics::LineLimits both(const kinematics::LineLimits& a, const kinematics::LineLimits& b) {
  return {std::min(a.cap, b.cap), std::min(a.acceleration, b.acceleration), std::max(a.fall, b.fall)};
}

static bool are_equal(const kinematics::LineLimits& a, const kinematics::LineLimits& b) {
  return a.cap == b.cap && a.acceleration == b.acceleration && a.fall == b.fall;
}

WindowMinimum::WindowMinimum(double window, double max_speed)
    : window_(window), max_speed_(max_speed), batch_(kWidenBatch) {}

void WindowMinimum::append(double length, kinematics::LineLimits limits) {
  const double begin = std::exchange(end_, end_ + length);
  double speed = std::min(std::sqrt(limits.cap), max_speed_);
  if (sources_.size() >= kMaxSources)
    speed = std::min(speed, 2 * (begin - sources_[sources_.size() - kMaxSources].begin) / window_);
  limits.cap = std::min(limits.cap, speed * speed);
  sources_.push_back({begin, end_, speed * window_ / 2, limits});
  if (sources_.size() < batch_) return;
  widen(settled());
  batch_ = std::max(kWidenBatch, 2 * sources_.size());
}

void WindowMinimum::come_to_rest() {
  widen(sources_.size());
  if (open_.length > 0) cells_.push_back(open_);
  open_ = {};
  from_earlier_ = {};
  end_ = 0;
}

const Cell* WindowMinimum::next() {
  if (handed_out_ < cells_.size()) return &cells_[handed_out_++];
  cells_.clear();
  handed_out_ = 0;
  return nullptr;
}

/// Returns the number of sources that the limits of no later piece can reach.
std::size_t WindowMinimum::settled() const {
  const double reached = sources_.back().end - max_speed_ * window_ / 2;
  const auto first = std::partition_point(sources_.begin(), sources_.end(),
                                          [&](const Source& source) { return source.end <= reached; });
  const std::size_t beyond = sources_.size() > kMaxSources ? sources_.size() - kMaxSources : 0;
  return std::max(static_cast<std::size_t>(first - sources_.begin()), beyond);
}

void WindowMinimum::widen(std::size_t count) {
  if (count == 0) return;
  widen_backward(count);
  widen_forward(count);
  sources_.erase(sources_.begin(), sources_.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Computes the limits that reach each place from its own and later sources. Places are negated here, since the pass
/// runs backward and RunningMinimum requires increasing places.
void WindowMinimum::widen_backward(std::size_t count) {
  RunningLimits from_later;
  intervals_.clear();
  for (std::size_t i = sources_.size(); i-- > 0;) {
    const Source& source = sources_[i];
    from_later.insert(source.limits, source.radius - source.begin);
    from_later.pass(-source.end);
    for (double place = -source.end; place < -source.begin; from_later.pass(place)) {
      const double next = std::min(from_later.until(), -source.begin);
      if (i < count) intervals_.push_back({-next, -place, from_later.limits()});
      place = next;
    }
  }
}

/// Adds the limits from earlier sources, and emits the intervals in order.
void WindowMinimum::widen_forward(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Source& source = sources_[i];
    from_earlier_.insert(source.limits, source.end + source.radius);
    from_earlier_.pass(source.begin);
    for (double place = source.begin; place < source.end; from_earlier_.pass(place)) {
      while (intervals_.size() > 1 && intervals_.back().end <= place) intervals_.pop_back();
      const double later_changes = intervals_.back().end > place ? intervals_.back().end : kinematics::kInfinity;
      const double next = std::min({from_earlier_.until(), later_changes, source.end});
      emit(place, next, both(from_earlier_.limits(), intervals_.back().limits));
      place = next;
    }
  }
}

/// Adds an interval to the open cell if its limits are equal or it has no length; otherwise starts a new cell.
void WindowMinimum::emit(double begin, double end, const kinematics::LineLimits& limits) {
  const bool is_first = open_.length == 0;
  const bool continues = are_equal(limits, open_.limits) && open_parts_ < kMaxParts;
  if (!is_first && (end - begin <= kinematics::kNoLength || continues)) {
    open_.length = end - open_.begin;
    ++open_parts_;
    return;
  }
  if (!is_first) cells_.push_back(open_);
  open_ = {begin, end - begin, limits};
  open_parts_ = 1;
}

}  // namespace isocnc::motion
