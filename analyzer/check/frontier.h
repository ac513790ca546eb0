#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "analyzer/check/registers.h"
#include "analyzer/check/report.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::check {

/// Paths through the program that have led to the same machine state: what follows is judged alike for all of them.
struct Group {
  execution::State state;
  Valuations registers;
  Path path;  ///< The decisions that all of its paths share.

  friend bool operator==(const Group&, const Group&) = default;
};

/// Groups whose states differ. Adding a group joins it to the one whose state it meets.
class Groups {
 public:
  bool empty() const { return all_.empty(); }
  std::size_t size() const { return all_.size(); }
  Group& operator[](std::size_t index) { return all_[index]; }
  const Group& operator[](std::size_t index) const { return all_[index]; }
  auto begin() { return all_.begin(); }
  auto end() { return all_.end(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  void clear() { all_.clear(); }
  void keep_first(std::size_t count) { all_.erase(all_.begin() + static_cast<std::ptrdiff_t>(count), all_.end()); }

  void add(Group group);
  /// Adds one whose state is none of the others'.
  void append(Group group) { all_.push_back(std::move(group)); }
  void add_all(Groups&& groups);
  /// Joins groups whose states have met.
  void converge();
  /// Joins groups until at most `limit` are left: first those that differ in position alone, whose position then counts
  /// as unknown; then it drops the last. Gives up completeness, never correctness.
  void reduce_to(std::size_t limit);

  friend bool operator==(const Groups&, const Groups&) = default;

 private:
  std::vector<Group> all_;
};

/// Where a check stands between two lines: all that the rest of the program's findings depend on. Knows jumps by their
/// number and labels by their name, never a line, so that text inserted elsewhere leaves it as it is.
struct Frontier {
  Groups live;                              ///< Running through the next line.
  std::map<std::uint64_t, Groups> waiting;  ///< Jumped ahead, by label.
  std::uint32_t next_jump = 0;              ///< How many IFs with a label have been passed.
  std::uint32_t spread = 0;                 ///< How much work more than one live group has cost lately.
  bool dead_told = false;                   ///< No path leads here, which has been said (W116).
  bool reduced = false;                     ///< Too many states once: some are not followed (W191).

  /// The whole program has been checked: no path goes on.
  bool finished() const { return live.empty() && waiting.empty(); }
  /// What runs through the next line, where that is this one: besides what comes from above, all that has jumped to it.
  Groups running_through(const syntax::LineTree& next) const;
  /// The one state of all that does. Nothing where there are several, or not all are known.
  std::optional<execution::State> state_at(const syntax::LineTree& next) const;

  friend bool operator==(const Frontier&, const Frontier&) = default;
};

}  // namespace isocnc::check
