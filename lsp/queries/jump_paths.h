#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

/// The paths through a program, with each jump both taken and not taken. Follows them upward from one line, using only
/// the jumps and program ends of the index: syntax::ForwardPaths would have to read every line from the top.
class JumpPaths {
 public:
  struct ResolvedJump {
    documents::Landmark landmark;  ///< The label after the GOTO.
    std::optional<std::size_t>
        target;  ///< The line that the jump leads to: the first below it that has its label (D50).
  };

  explicit JumpPaths(const documents::Snapshot& snapshot);

  /// All jumps in the order of the program.
  const std::vector<ResolvedJump>& jumps() const { return jumps_; }
  /// Whether a jump leads to this line.
  bool is_jump_target(std::size_t line) const { return jump_targets_.contains(line); }

  /// Goes up from a line on every path that leads there, until it finds something: `find(first, end)` returns the last
  /// match in the lines [first, end), if there is one. Returns each match once, in ascending order.
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

  std::vector<ResolvedJump> jumps_;
  std::multimap<std::size_t, std::size_t> jump_targets_;  // Lines of jumps by the line that they lead to.
  std::set<std::size_t> after_ends_;  // Lines directly below an M02, which no path reaches from above.
};

}  // namespace isocnc::queries
