#include "analyzer/frontier.h"

#include <algorithm>

namespace isocnc::analyzer {

/// The decisions that both paths share; both have the latest first.
static Path common_decisions(const Path& a, const Path& b) {
  Path common;
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

static void join(Group& into, const Group& other) {
  into.registers.unite(other.registers);
  into.state.knowledge &= other.state.knowledge;
  if (into.state.tool != other.state.tool) into.state.forget(execution::State::kToolKnown);
  into.path = common_decisions(into.path, other.path);
}

void Groups::add(Group group) {
  for (Group& present : all_)
    if (execution::judged_alike(present.state, group.state)) return join(present, group);
  all_.push_back(std::move(group));
}

void Groups::add_all(Groups&& groups) {
  for (Group& group : groups.all_) add(std::move(group));
  groups.clear();
}

void Groups::converge() {
  for (std::size_t i = 0; i + 1 < all_.size(); ++i)
    for (std::size_t j = all_.size() - 1; j > i; --j) {
      if (!execution::judged_alike(all_[i].state, all_[j].state)) continue;
      join(all_[i], all_[j]);
      all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(j));
    }
}

/// Makes `a` stand for both states if they differ in position alone.
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
      join(all_[i], all_[j]);
      all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(j));
    }
  if (all_.size() > limit) all_.resize(limit);
}

}  // namespace isocnc::analyzer
