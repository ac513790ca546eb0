#include "interpreter/motion/erosion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpreter/motion/numbers.h"

namespace isocnc::motion {

/// Spreading looks at all that is not spread yet: it pays to let some gather.
static constexpr std::size_t kSpreadBatch = 256;
/// No piece reaches over more: so many are held at most, and the machine takes half a window for them at least.
static constexpr std::size_t kMostSources = 16384;
/// A cell goes on for no longer, lest it never be known.
static constexpr int kMostParts = 64;

void Erosion::Frontier::insert(double value, double until) {
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

void Erosion::Frontier::pass(double place) {
  while (!entries_.empty() && entries_.back().until <= place) entries_.pop_back();
}

void Erosion::Shade::insert(const LineLimits& limits, double until) {
  cap_.insert(limits.cap, until);
  acceleration_.insert(limits.acceleration, until);
  if (limits.fall > 0) fall_.insert(-limits.fall, until);
}

void Erosion::Shade::pass(double place) {
  cap_.pass(place);
  acceleration_.pass(place);
  fall_.pass(place);
}

LineLimits Erosion::Shade::limits() const {
  return {cap_.least(kInfinity), acceleration_.least(kInfinity), -fall_.least(0)};
}

double Erosion::Shade::until() const {
  return std::min({cap_.until(kInfinity), acceleration_.until(kInfinity), fall_.until(kInfinity)});
}

static LineLimits both(const LineLimits& a, const LineLimits& b) {
  return {std::min(a.cap, b.cap), std::min(a.acceleration, b.acceleration), std::max(a.fall, b.fall)};
}

static bool are_equal(const LineLimits& a, const LineLimits& b) {
  return a.cap == b.cap && a.acceleration == b.acceleration && a.fall == b.fall;
}

Erosion::Erosion(double window, double most_speed) : window_(window), most_speed_(most_speed), batch_(kSpreadBatch) {}

void Erosion::append(double length, LineLimits limits) {
  const double begin = std::exchange(end_, end_ + length);
  double speed = std::min(std::sqrt(limits.cap), most_speed_);
  if (sources_.size() >= kMostSources)
    speed = std::min(speed, 2 * (begin - sources_[sources_.size() - kMostSources].begin) / window_);
  limits.cap = std::min(limits.cap, speed * speed);
  sources_.push_back({begin, end_, speed * window_ / 2, limits});
  if (sources_.size() < batch_) return;
  spread(settled());
  batch_ = std::max(kSpreadBatch, 2 * sources_.size());
}

void Erosion::come_to_rest() {
  spread(sources_.size());
  if (open_.length > 0) cells_.push_back(open_);
  open_ = {};
  behind_ = {};
  end_ = 0;
}

const Cell* Erosion::next() {
  if (handed_out_ < cells_.size()) return &cells_[handed_out_++];
  cells_.clear();
  handed_out_ = 0;
  return nullptr;
}

/// How many sources nothing that follows reaches back to.
std::size_t Erosion::settled() const {
  const double reached = sources_.back().end - most_speed_ * window_ / 2;
  const auto first = std::partition_point(sources_.begin(), sources_.end(),
                                          [&](const Source& source) { return source.end <= reached; });
  const std::size_t beyond = sources_.size() > kMostSources ? sources_.size() - kMostSources : 0;
  return std::max(static_cast<std::size_t>(first - sources_.begin()), beyond);
}

void Erosion::spread(std::size_t count) {
  if (count == 0) return;
  spread_backward(count);
  spread_forward(count);
  sources_.erase(sources_.begin(), sources_.begin() + static_cast<std::ptrdiff_t>(count));
}

/// Places count against the way here.
void Erosion::spread_backward(std::size_t count) {
  Shade ahead;
  strips_.clear();
  for (std::size_t i = sources_.size(); i-- > 0;) {
    const Source& source = sources_[i];
    ahead.insert(source.limits, source.radius - source.begin);
    ahead.pass(-source.end);
    for (double place = -source.end; place < -source.begin; ahead.pass(place)) {
      const double next = std::min(ahead.until(), -source.begin);
      if (i < count) strips_.push_back({-next, -place, ahead.limits()});
      place = next;
    }
  }
}

void Erosion::spread_forward(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const Source& source = sources_[i];
    behind_.insert(source.limits, source.end + source.radius);
    behind_.pass(source.begin);
    for (double place = source.begin; place < source.end; behind_.pass(place)) {
      while (strips_.size() > 1 && strips_.back().end <= place) strips_.pop_back();
      const double ahead_changes = strips_.back().end > place ? strips_.back().end : kInfinity;
      const double next = std::min({behind_.until(), ahead_changes, source.end});
      emit(place, next, both(behind_.limits(), strips_.back().limits));
      place = next;
    }
  }
}

void Erosion::emit(double begin, double end, const LineLimits& limits) {
  const bool is_first = open_.length == 0;
  const bool goes_on = are_equal(limits, open_.limits) && open_parts_ < kMostParts;
  if (!is_first && (end - begin <= kNoLength || goes_on)) {
    open_.length = end - open_.begin;
    ++open_parts_;
    return;
  }
  if (!is_first) cells_.push_back(open_);
  open_ = {begin, end - begin, limits};
  open_parts_ = 1;
}

}  // namespace isocnc::motion
