#include "lsp/queries/assignments.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "lsp/queries/jump_paths.h"

namespace isocnc::queries {

std::vector<Occurrence> assignments_reaching(const documents::Snapshot& snapshot, const Occurrence& read) {
  std::vector<Occurrence> all = occurrences(snapshot, read.name);
  std::erase_if(all, [](const Occurrence& each) { return !each.is_definition; });
  const std::vector<std::size_t> lines = JumpPaths(snapshot).nearest_above(
      read.line, [&](std::size_t first, std::size_t end) -> std::optional<std::size_t> {
        const auto below = std::lower_bound(all.begin(), all.end(), end,
                                            [](const Occurrence& each, std::size_t line) { return each.line < line; });
        return below == all.begin() || std::prev(below)->line < first ? std::nullopt
                                                                      : std::optional(std::prev(below)->line);
      });
  // If a line has several assignments, the last one counts.
  std::vector<Occurrence> reaching;
  for (const std::size_t line : lines) {
    const auto last = std::find_if(all.rbegin(), all.rend(), [&](const Occurrence& each) { return each.line == line; });
    reaching.push_back(*last);
  }
  return reaching;
}

}  // namespace isocnc::queries
