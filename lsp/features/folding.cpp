#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/jump_paths.h"
#include "lsp/queries/outline.h"

/// Folding ranges: sections, the lines that an IF can skip, comments, and the lines after the program end.
namespace isocnc::features {
namespace {

struct Fold {
  std::size_t first_line = 0;
  std::size_t last_line = 0;  ///< Inclusive.
  const char* kind = nullptr;

  friend bool operator<(const Fold& a, const Fold& b) {
    return std::pair(a.first_line, a.last_line) < std::pair(b.first_line, b.last_line);
  }
};

void to_json(Json& json, const Fold& fold) {
  json = {{"startLine", fold.first_line}, {"endLine", fold.last_line}};
  if (fold.kind) json["kind"] = fold.kind;
}

constexpr const char* kLimit = "/textDocument/foldingRange/rangeLimit";

/// The maximum number of folds that the client accepts.
std::size_t limit_of(const Client& client) {
  if (!client.can(kLimit)) return std::numeric_limits<std::size_t>::max();
  const Json& limit = client.capabilities.at(Json::json_pointer(kLimit));
  return limit.is_number_unsigned() ? limit.get<std::size_t>() : std::numeric_limits<std::size_t>::max();
}

/// The last line that is not empty.
std::size_t last_text_line(const Snapshot& snapshot) {
  std::size_t line = snapshot.document().line_count() - 1;
  while (line > 0 && snapshot.document().text_of_line(line).empty()) --line;
  return line;
}

/// Finds the folds, the most important first.
class FoldFinder {
 public:
  explicit FoldFinder(const Snapshot& snapshot) : snapshot_(snapshot) {}

  std::vector<Fold> find() {
    for (const queries::Section& section : queries::outline(snapshot_)) {
      const bool is_long = section.kind == queries::SectionKind::Tool || section.kind == queries::SectionKind::Face;
      if (is_long) add(section.first_line, section.last_line, "region");
    }
    find_tail();
    const queries::JumpPaths paths(snapshot_);
    for (const queries::JumpPaths::ResolvedJump& jump : paths.jumps())
      if (jump.target) add(jump.landmark.line, *jump.target - 1);
    for (const queries::CommentBlock& block : queries::comment_blocks(snapshot_))
      add(block.first_line, block.last_line, "comment");
    return std::move(folds_);
  }

 private:
  /// Finds the fold from the M02 after which no line runs.
  void find_tail() {
    for (const documents::Landmark& end : snapshot_.index().landmarks(documents::LandmarkKind::ProgramEnd)) {
      snapshot_.throw_if_unwanted();
      if (!snapshot_.frontier_before(end.line + 1).finished()) continue;
      return add(end.line, last_text_line(snapshot_), "region");
    }
  }

  void add(std::size_t first, std::size_t last, const char* kind = nullptr) {
    if (last > first) folds_.push_back({first, last, kind});
  }

  const Snapshot& snapshot_;
  std::vector<Fold> folds_;
};

std::vector<Fold> answer_folding(const Snapshot& snapshot, const protocol::DocumentParams&) {
  std::vector<Fold> folds = FoldFinder(snapshot).find();
  folds.resize(std::min(folds.size(), limit_of(snapshot.client())));
  std::sort(folds.begin(), folds.end());
  return folds;
}

Json folding_capabilities(const Client&) { return {{"foldingRangeProvider", true}}; }

}  // namespace

extern const Feature folding = {.capabilities = folding_capabilities,
                                .methods = {on<&answer_folding>("textDocument/foldingRange")}};

}  // namespace isocnc::features
