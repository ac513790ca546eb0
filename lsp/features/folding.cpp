#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/jump_paths.h"
#include "lsp/queries/outline.h"
#include "lsp/queries/section_times.h"

/// Folding ranges: sections, each with its tool and its time where the client shows text in place of what is folded,
/// the lines that an IF can skip, comments, and the lines after the program end.
namespace isocnc::features {
namespace {

struct Fold {
  std::size_t first_line = 0;
  std::size_t last_line = 0;  ///< Inclusive.
  const char* kind = nullptr;
  std::string collapsed_text;       ///< Empty for what the client shows by itself.
  std::size_t tool_line = kNoTool;  ///< Of the M06 of a tool's section.

  static constexpr std::size_t kNoTool = std::numeric_limits<std::size_t>::max();

  friend bool operator<(const Fold& a, const Fold& b) {
    return std::pair(a.first_line, a.last_line) < std::pair(b.first_line, b.last_line);
  }
};

void to_json(Json& json, const Fold& fold) {
  json = {{"startLine", fold.first_line}, {"endLine", fold.last_line}};
  if (fold.kind) json["kind"] = fold.kind;
  if (!fold.collapsed_text.empty()) json["collapsedText"] = fold.collapsed_text;
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
      if (!is_long || !add(section.first_line, section.last_line, "region")) continue;
      folds_.back().collapsed_text = section.title + (section.detail.empty() ? "" : " " + section.detail);
      if (section.kind == queries::SectionKind::Tool) folds_.back().tool_line = section.head_line;
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
      add(end.line, last_text_line(snapshot_), "region");
      return;
    }
  }

  bool add(std::size_t first, std::size_t last, const char* kind = nullptr) {
    if (last > first) folds_.push_back({first, last, kind, {}});
    return last > first;
  }

  const Snapshot& snapshot_;
  std::vector<Fold> folds_;
};

/// The text of the folds of tools gets the time that they take.
std::string with_times(std::vector<Fold> folds, const queries::Sections& sections) {
  for (Fold& fold : folds) {
    const auto section = sections.find(fold.tool_line);
    if (section != sections.end()) fold.collapsed_text += ", " + queries::clock_text(section->second.seconds);
  }
  return rpc::write(Json(folds));
}

BackgroundRequest answer_folding(const Snapshot& snapshot, const protocol::DocumentParams&) {
  std::vector<Fold> folds = FoldFinder(snapshot).find();
  folds.resize(std::min(folds.size(), limit_of(snapshot.client())));
  std::sort(folds.begin(), folds.end());
  if (!snapshot.client().can("/textDocument/foldingRange/foldingRange/collapsedText")) {
    for (Fold& fold : folds) fold.collapsed_text.clear();
    return [folds = std::move(folds)](const std::function<bool()>&) { return rpc::write(Json(folds)); };
  }
  const auto times = queries::SectionTimes::of(snapshot);
  const auto known = times->known(snapshot);
  const auto program = known ? nullptr : std::make_shared<queries::TimedProgram>(snapshot, 0);
  return [times, known, program, folds = std::move(folds)](const std::function<bool()>& stop) {
    return with_times(folds, known ? *known : *times->time(*program, stop));
  };
}

Json folding_capabilities(const Client&) { return {{"foldingRangeProvider", true}}; }

}  // namespace

extern const Feature folding = {.capabilities = folding_capabilities,
                                .methods = {in_background<&answer_folding>("textDocument/foldingRange")}};

}  // namespace isocnc::features
