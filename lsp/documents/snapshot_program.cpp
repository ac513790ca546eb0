#include "lsp/documents/snapshot_program.h"

#include <algorithm>

#include "interpreter/syntax/formatter.h"

namespace isocnc::lsp::documents {

static constexpr std::uint32_t kLinesWithoutPause = 1024;

syntax::LineTree SnapshotProgram::line(std::uint64_t line) {
  if (++lines_seen_ % kLinesWithoutPause == 0) snapshot_.give_way();
  return *line_.emplace(snapshot_.document().line(line));
}

bool SnapshotProgram::is_jumped_to(std::uint64_t label) {
  return !snapshot_.index().landmarks(kinds(LandmarkKind::Jump), label).empty();
}

std::optional<std::uint64_t> SnapshotProgram::free_line_number() {
  const std::uint64_t highest = std::max(last_line_number_, snapshot_.index().highest_label());
  if (highest > syntax::kMostLineNumber - 10) return std::nullopt;
  last_line_number_ = highest / 10 * 10 + 10;
  return last_line_number_;
}

analyzer::EachLine each_line_of(const Snapshot& snapshot) {
  return [&snapshot](const std::function<void(const syntax::LineTree&)>& look) {
    const syntax::Document& document = snapshot.document();
    syntax::ChunkTrees trees;
    for (std::size_t chunk = 0; chunk < document.chunk_count(); ++chunk) {
      snapshot.give_way();
      trees.read(document, chunk);
      for (std::size_t i = 0; i < trees.size(); ++i) look(trees[i]);
    }
  };
}

}  // namespace isocnc::lsp::documents
