#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "analyzer/check/registers.h"
#include "analyzer/check/report.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/forward_paths.h"

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
  /// Adds all of another, which is empty then.
  void join(Groups&& groups);
  /// Joins groups whose states have met.
  void converge();
  /// Joins groups until `limit` or fewer are left: first those that differ in position alone, whose position then
  /// counts as unknown; then it drops the last. Gives up completeness, never correctness.
  void reduce_to(std::size_t limit);

  friend bool operator==(const Groups&, const Groups&) = default;

 private:
  std::vector<Group> all_;
};

/// Where a check stands between two lines: all that the rest of the program's findings depend on. Knows jumps by their
/// number and labels by their name, never a line, so that text inserted elsewhere leaves it as it is.
struct Frontier : syntax::ForwardPaths<Groups> {
  std::uint32_t next_jump = 0;       ///< IFs with a label that have been passed.
  std::uint32_t branching_cost = 0;  ///< Recent cost of more than one live group, in lines executed.
  bool dead_reported = false;        ///< W116 has been reported for the lines from here on, where no path leads.
  bool reduced = false;              ///< Some states are not followed, as there were too many (W191).

  /// The one state on all paths through the next line, where that is this one. Nothing where there are several, or not
  /// all are known.
  std::optional<execution::State> state_at(const syntax::LineTree& next) const;

  friend bool operator==(const Frontier&, const Frontier&) = default;
};

}  // namespace isocnc::check
