#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::syntax {

/// Follows every path through a program with jumps, from its first line to its last, and carries a value along: the
/// facts at a line on all paths to it. Jumps go forward only (I.5), to the first line below that has their label (D50),
/// so one pass over the lines covers every path. Conditions are not evaluated: pass() assumes that an IF may or may not
/// jump.
///
/// A Value has
///
///     bool empty() const;      whether it is the value of no path, like Value{}
///     void join(Value&&);      merges the values of two paths; not called where either is empty
///
/// and the argument of pass() changes the value at a line:
///
///     paths.arrive(line);                         // Jumps to the line's label join here.
///     if (!paths.live.empty()) ...                // The value before the line.
///     paths.pass(line, [](Value& value) {...});   // The value after it; an IF stores a copy, M02 ends.
template <class Value>
class ForwardPaths {
 public:
  /// No path.
  ForwardPaths() = default;
  /// One path, before the first line.
  explicit ForwardPaths(Value start) : live(std::move(start)) {}

  Value live = {};  ///< The value on the paths through the next line; empty without such a path.

  /// The values that have jumped ahead, by label; none of them is empty.
  const std::map<std::uint64_t, Value>& waiting() const { return waiting_; }
  /// Whether no path continues from here.
  bool finished() const { return live.empty() && waiting_.empty(); }

  /// Arrives at a line: the paths that have jumped to its label continue there. Returns whether there are any.
  bool arrive(const LineTree& line) {
    if (!line.has_label() || waiting_.empty()) return false;
    const auto waiting = waiting_.find(line.label);
    if (waiting == waiting_.end()) return false;
    join(live, std::move(waiting->second));
    waiting_.erase(waiting);
    return true;
  }
  /// The value that would be live after arrive(). Changes nothing.
  Value live_at(const LineTree& line) const {
    Value value = live;
    const auto waiting = line.has_label() ? waiting_.find(line.label) : waiting_.end();
    if (waiting != waiting_.end()) join(value, Value(waiting->second));
    return value;
  }

  /// Passes a line: `change(live)` turns the value before the line into the value after it. At an IF, a copy waits for
  /// the label; after an M02 no path is live. A line on no path changes nothing.
  template <class Change>
  void pass(const LineTree& line, Change change) {
    if (live.empty()) return;
    change(live);
    if (line.jump && line.jump->has_target) jump(line.jump->target, live);
    const auto is_end = [&](const Instruction& instruction) { return line.ends_program(instruction); };
    if (std::any_of(line.instructions.begin(), line.instructions.end(), is_end)) end();
  }

  /// Adds paths with this value, which is not empty, that jump to a label. Returns the joined value waiting there.
  Value& jump(std::uint64_t label, Value value) {
    Value& waiting = waiting_[label];
    join(waiting, std::move(value));
    return waiting;
  }
  /// Ends the live paths.
  void end() { live = Value{}; }
  /// Drops the paths that wait for the highest label. At least one path must be waiting.
  void drop_highest_label() { waiting_.erase(std::prev(waiting_.end())); }

  /// Calls `change` with the value of each path.
  template <class Change>
  void change_each(Change change) {
    change(live);
    for (auto& [label, value] : waiting_) change(value);
  }

  friend bool operator==(const ForwardPaths&, const ForwardPaths&) = default;

 private:
  static void join(Value& into, Value&& value) {
    if (into.empty()) {
      into = std::move(value);
    } else if (!value.empty()) {
      into.join(std::move(value));
    }
  }

  std::map<std::uint64_t, Value> waiting_;
};

}  // namespace isocnc::syntax
