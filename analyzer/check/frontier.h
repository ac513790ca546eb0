#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "analyzer/check/registers.h"
#include "analyzer/check/report.h"
#include "analyzer/rules/house_rules.h"
#include "analyzer/rules/memory.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/forward_paths.h"

namespace isocnc::check {

/// The maximum number of machine states followed at once; beyond it some are dropped (W191).
inline constexpr std::size_t kMaxStates = 512;

/// Paths through the program that have led to the same machine state and the same memory of house rules, and so have
/// the same findings from here on.
struct Group {
  execution::State state;
  rules::Memory memory;  ///< What the lint rules remember; paths that differ in it alone are joined.
  rules::HouseMemory house;
  Valuations registers;
  Decisions path;  ///< The decisions that all of its paths share.

  friend bool operator==(const Group&, const Group&) = default;
};

/// Groups with different states. A group that is added is joined to the group with its state, if there is one.
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
  /// Adds a group whose state none of the others has.
  void append(Group group) { all_.push_back(std::move(group)); }
  /// Adds all groups of another object and leaves that empty.
  void join(Groups&& groups);
  /// Joins groups whose states have become equal.
  void converge();
  /// Reduces the groups to at most `limit`: first joins those that differ alone in position, which is then unknown, or
  /// in what house rules remember; then drops the last ones. Findings may be missed after that, but none is wrong.
  void reduce_to(std::size_t limit);

  friend bool operator==(const Groups&, const Groups&) = default;

 private:
  std::vector<Group> all_;
};

/// The complete state of a check between two lines; all later findings depend on it alone. It refers to jumps by number
/// and to labels by name, never to lines, so that text inserted elsewhere does not change it.
struct Frontier : syntax::ForwardPaths<Groups> {
  std::uint32_t next_jump = 0;       ///< The number of IFs with a label so far.
  std::uint32_t branching_cost = 0;  ///< Recent extra executions of lines because of several live groups.
  bool dead_reported = false;        ///< Whether W116 has been reported for the current unreachable lines.
  bool reduced = false;              ///< Whether states have been dropped because there were too many (W191).

  /// The state before line `next`, if it is the same on all paths. Nothing if there are several states or some are
  /// unknown.
  std::optional<execution::State> state_at(const syntax::LineTree& next) const;

  /// Limits the number of groups; returns whether there were too many.
  bool reduce(Groups& groups) const;
  /// Limits what the live groups take; returns whether they took too much.
  bool bound_live();
  /// Lowers `branching_cost` by what `lines` lines with one live state allow.
  void reduce_spread(std::size_t lines);

  friend bool operator==(const Frontier&, const Frontier&) = default;
};

}  // namespace isocnc::check
