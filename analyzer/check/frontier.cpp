#include "analyzer/check/frontier.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "interpreter/text/hash.h"

namespace isocnc::check {

/// The maximum number of valuations kept apart in one group.
static constexpr std::size_t kMaxValuations = 256;
/// The maximum of Frontier::branching_cost. Each line adds the number of live groups beyond the first and takes off
/// kSpreadPerLine: a few groups can be followed forever, many only for a limited stretch.
static constexpr std::uint32_t kSpreadLimit = 20'000'000;
/// The maximum number of groups once some have been dropped: the rest of the program must not take long.
static constexpr std::size_t kMaxStatesReduced = 16;
/// The branching cost that each line takes off.
static constexpr std::uint32_t kSpreadPerLine = 32;

/// The decisions that both paths share; both paths have the latest first.
static Decisions common_decisions(const Decisions& a, const Decisions& b) {
  Decisions common;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) {
      common.push_back(*i++);
      ++j;
    } else if (i->jump > j->jump) {
      ++i;
    } else if (i->jump < j->jump) {
      ++j;
    } else {
      ++i;
      ++j;
    }
  }
  return common;
}

static void merge(Group& into, Group&& other) {
  into.registers.unite(std::move(other.registers));
  execution::join(into.state, other.state);
  into.memory.join(other.memory);
  into.house.join(other.house);
  into.path = common_decisions(into.path, other.path);
}

/// Whether all later lines are judged alike on the paths of both.
static bool judged_alike(const Group& a, const Group& b) {
  return a.house == b.house && execution::judged_alike(a.state, b.state);
}

void Groups::add(Group group) {
  for (Group& present : all_)
    if (judged_alike(present, group)) return merge(present, std::move(group));
  all_.push_back(std::move(group));
}

void Groups::join(Groups&& groups) {
  all_.insert(all_.end(), std::make_move_iterator(groups.begin()), std::make_move_iterator(groups.end()));
  if (all_.size() > groups.size()) converge();
  groups.clear();
}

/// A hash that is equal for equal states and differs for most others.
static std::uint64_t hash_of(const execution::State& state) {
  std::uint64_t hash = text::kHashStart;
  const auto mix = [&](std::uint64_t bits) { hash = std::rotl((hash ^ bits) * 0x9E3779B97F4A7C15ULL, 29); };
  const auto mix_number = [&](double number) { mix(std::bit_cast<std::uint64_t>(number + 0.0)); };  // -0 equals 0.
  for (int i = 0; i < 3; ++i) mix_number(state.position.tip[i]);
  mix_number(state.position.b);
  mix_number(state.position.c);
  for (int i = 0; i < 3; ++i) mix_number(state.workpiece_origin[i]);
  for (const std::uint8_t mode : state.in_force) mix(mode);
  mix(std::uint64_t{state.unknown} << 16 | state.written);
  return hash;
}

/// The maximum number of groups that are compared pairwise.
static constexpr std::size_t kFew = 8;

/// Compares the groups pairwise.
static void converge_few(std::vector<Group>& groups) {
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = i + 1; j < groups.size();) {
      if (judged_alike(groups[i], groups[j])) {
        merge(groups[i], std::move(groups[j]));
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(j));
      } else {
        ++j;
      }
    }
}

void Groups::converge() {
  if (all_.size() <= kFew) return converge_few(all_);
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  order.reserve(all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) order.emplace_back(hash_of(all_[i].state), i);
  std::sort(order.begin(), order.end());
  std::vector<bool> is_merged;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first == order[i].first; ++j) {
      const std::size_t into = order[i].second;
      const std::size_t other = order[j].second;
      if (!is_merged.empty() && (is_merged[into] || is_merged[other])) continue;
      if (!judged_alike(all_[into], all_[other])) continue;
      merge(all_[into], std::move(all_[other]));
      is_merged.resize(all_.size());
      is_merged[other] = true;
    }
  if (is_merged.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (!is_merged[i]) {
      if (kept != i) all_[kept] = std::move(all_[i]);
      ++kept;
    }
  all_.resize(kept);
}

/// Lets `a` stand for both states if they differ in position alone; the differing positions become unknown.
static bool blur_positions(execution::State& a, const execution::State& b) {
  execution::State other = b;
  other.position = a.position;
  other.unknown = a.unknown;
  if (!execution::judged_alike(a, other)) return false;
  const auto compare = [&](execution::Axis axis, double& mine, double theirs) {
    const execution::AxisSet bit = execution::axis_bit(axis);
    if (mine == theirs && ((a.unknown | b.unknown) & bit) == 0) return;
    a.unknown |= bit;
    mine = 0;
  };
  for (int i = 0; i < 3; ++i) compare(static_cast<execution::Axis>(i), a.position.tip[i], b.position.tip[i]);
  compare(execution::Axis::B, a.position.b, b.position.b);
  compare(execution::Axis::C, a.position.c, b.position.c);
  return true;
}

void Groups::reduce_to(std::size_t limit) {
  for (std::size_t i = 0; i < all_.size(); ++i)
    for (std::size_t j = all_.size() - 1; j > i && all_.size() > limit; --j) {
      if (!blur_positions(all_[i].state, all_[j].state)) continue;
      merge(all_[i], std::move(all_[j]));
      all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(j));
    }
  if (all_.size() > limit) all_.resize(limit);
}

std::optional<execution::State> Frontier::state_at(const syntax::LineTree& next) const {
  const Groups groups = live_at(next);
  if (groups.empty() || reduced) return std::nullopt;
  execution::State state = groups[0].state;
  for (std::size_t i = 1; i < groups.size(); ++i) {  // Those that differ only in what house rules remember.
    if (!execution::judged_alike(state, groups[i].state)) return std::nullopt;
    execution::join(state, groups[i].state);
  }
  return state;
}

bool Frontier::reduce(Groups& groups) const {
  const std::size_t max = reduced ? kMaxStatesReduced : kMaxStates;
  if (groups.size() <= max) return false;
  groups.reduce_to(max / 2);
  return true;
}

bool Frontier::bound_live() {
  bool is_reduced = false;
  branching_cost += static_cast<std::uint32_t>(live.size()) - 1;
  branching_cost -= std::min(branching_cost, kSpreadPerLine);
  is_reduced |= reduce(live);
  if (branching_cost > kSpreadLimit) {
    live.reduce_to(1);
    branching_cost = 0;
    is_reduced = true;
  }
  for (Group& group : live) {
    if (group.registers.size() <= kMaxValuations) continue;
    group.registers.reduce_to(kMaxValuations / 2);
    is_reduced = true;
  }
  return is_reduced;
}

void Frontier::reduce_spread(std::size_t lines) {
  branching_cost -= static_cast<std::uint32_t>(std::min<std::size_t>(branching_cost, kSpreadPerLine * lines));
}

}  // namespace isocnc::check
