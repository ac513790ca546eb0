#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "lsp/documents/snapshot.h"

namespace isocnc::lsp::documents {

/// The paths that a program's jumps leave it, whatever their conditions say. They are followed upward, from one line,
/// over the jumps and ends of the index alone: syntax::ForwardPaths would have to read every line from the top.
class JumpPaths {
 public:
  struct Jump {
    Landmark landmark;                  ///< The label after the GOTO.
    std::optional<std::size_t> target;  ///< The line it leads to: the first with its label below it (D50).
  };

  explicit JumpPaths(const Snapshot& snapshot);

  /// In the order of the program.
  const std::vector<Jump>& jumps() const { return jumps_; }
  /// Whether a jump leads to this line.
  bool is_jump_target(std::size_t line) const { return jump_targets_.contains(line); }

  /// Goes up from a line on every path that leads there, until it finds something: `find(first, end)` gives the last of
  /// what it looks for in the lines [first, end), if there is any. Returns each of them once, in their order.
  template <class Find>
  auto nearest_above(std::size_t line, Find find) const {
    using Found = typename decltype(find(line, line))::value_type;
    std::set<Found> found;
    std::set<std::size_t> seen;
    std::vector<std::size_t> open{line};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      if (!seen.insert(at).second) continue;
      const auto [first_landing, last_landing] = jump_targets_.equal_range(at);
      for (auto jump_target = first_landing; jump_target != last_landing; ++jump_target)
        open.push_back(jump_target->second);
      if (at == 0 || ends_before(at)) continue;
      const std::size_t first = run_start(at);
      if (const auto nearest = find(first, at)) {
        found.insert(*nearest);
      } else {
        open.push_back(first);
      }
    }
    return std::vector<Found>(found.begin(), found.end());
  }

 private:
  bool ends_before(std::size_t line) const { return after_ends_.contains(line); }
  std::size_t run_start(std::size_t line) const;

  std::vector<Jump> jumps_;
  std::multimap<std::size_t, std::size_t>
      jump_targets_;                  // The line of a label that a jump leads to; the line of the jump.
  std::set<std::size_t> after_ends_;  // Lines below an M02: no path comes from above.
};

}  // namespace isocnc::lsp::documents
