#include "analyzer/fixing/trails.h"

#include <algorithm>
#include <utility>

namespace isocnc::fixing {

/// The distance in lines between marks, at the same lines in all trails; and the lines next to the change without
/// marks.
static constexpr std::size_t kBetweenMarks = 8;
static constexpr std::size_t kNear = 16;
/// The minimum of lines that a trail must have followed after the line where another one meets it.
static constexpr std::size_t kMinLines = 5'000;
/// Larger frontiers are not kept, to save memory.
static constexpr std::size_t kMaxGroups = 4;
static constexpr std::size_t kMaxLabels = 8;

static bool is_small(const check::Frontier& frontier) {
  return frontier.live.size() <= kMaxGroups && frontier.waiting().size() <= kMaxLabels &&
         std::all_of(frontier.waiting().begin(), frontier.waiting().end(),
                     [](const auto& waiting) { return waiting.second.size() <= kMaxGroups; });
}

void Trail::pass(std::size_t next_line, const check::Frontier& frontier, const FindingDelta& so_far) {
  if (++passed_ < kNear || next_line % kBetweenMarks != 0 || !is_small(frontier)) return;
  marks_.push_back({next_line, frontier, so_far});
}

void Trail::end(const FindingDelta& so_far, const TrailRest& rest) {
  all_ = rest;
  all_.delta += so_far;
}

std::optional<Trail::TrailRest> Trail::rest_from(std::size_t line, const check::Frontier& frontier) const {
  if (line % kBetweenMarks != 0 || (all_.has_more && all_.next_line < line + kMinLines)) return std::nullopt;
  const auto mark = std::lower_bound(marks_.begin(), marks_.end(), line,
                                     [](const TrailMark& each, std::size_t wanted) { return each.next_line < wanted; });
  if (mark == marks_.end() || mark->next_line != line || mark->frontier != frontier) return std::nullopt;
  TrailRest rest = all_;
  rest.delta -= mark->so_far;
  return rest;
}

void Trails::keep(Trail trail) {
  if (trails_.size() == kMaxTrails) trails_.pop_front();
  trails_.push_back(std::move(trail));
}

std::optional<Trail::TrailRest> Trails::rest_from(std::size_t line, const check::Frontier& frontier) const {
  for (const Trail& trail : trails_)
    if (std::optional<Trail::TrailRest> rest = trail.rest_from(line, frontier)) return rest;
  return std::nullopt;
}

}  // namespace isocnc::fixing
