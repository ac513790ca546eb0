#include "lsp/queries/snapshot_program.h"

#include <algorithm>
#include <memory>
#include <string>

#include "analyzer/fixing/text_program.h"
#include "interpreter/syntax/formatter.h"

namespace isocnc::queries {

static constexpr std::uint32_t kLinesWithoutPause = 1024;

namespace {

/// The habits of one version of a document.
class HabitsOfDocument {
 public:
  fixes::Habits& of(const documents::Snapshot& snapshot) {
    present_ = &snapshot;
    if (!program_ || version_ != snapshot.version() || settings_ != snapshot.settings_owner()) {
      program_.reset();
      version_ = snapshot.version();
      settings_ = snapshot.settings_owner();
      text_ = snapshot.document().text();
      program_ = std::make_unique<fixing::TextProgram>(text_, snapshot.check_setup(), [this] { pause(); });
    }
    return program_->habits();
  }

 private:
  void pause() {
    if (++lines_seen_ % kLinesWithoutPause == 0) present_->throw_if_unwanted();
  }

  const documents::Snapshot* present_ = nullptr;  // The snapshot of the present request.
  std::int64_t version_ = 0;
  std::shared_ptr<const void> settings_;  // Keeps the setup alive.
  std::string text_;
  std::unique_ptr<fixing::TextProgram> program_;
  std::uint32_t lines_seen_ = 0;
};

}  // namespace

fixes::Habits& SnapshotProgram::habits() {
  auto& memory = snapshot_.memory<std::shared_ptr<HabitsOfDocument>>();
  if (!memory) memory = std::make_shared<HabitsOfDocument>();
  return memory->of(snapshot_);
}

syntax::LineTree SnapshotProgram::line(std::size_t line) {
  if (++lines_seen_ % kLinesWithoutPause == 0) snapshot_.throw_if_unwanted();
  return *line_.emplace(snapshot_.document().line(line));
}

bool SnapshotProgram::is_read(std::size_t line) {
  const syntax::DocumentLine next = snapshot_.document().line(line);
  return !snapshot_.frontier_before(line).live_at(*next).empty();
}

bool SnapshotProgram::is_jumped_to(std::uint64_t label) {
  return !snapshot_.index().landmarks(documents::kinds(documents::LandmarkKind::Jump), label).empty();
}

std::uint64_t SnapshotProgram::highest_line_number() { return snapshot_.index().highest_label(); }

formatting::EachLine each_line_of(const documents::Snapshot& snapshot) {
  return [&snapshot](const std::function<void(const syntax::LineTree&)>& look) {
    const syntax::Document& document = snapshot.document();
    syntax::ChunkTrees trees;
    for (std::size_t chunk = 0; chunk < document.chunk_count(); ++chunk) {
      snapshot.throw_if_unwanted();
      trees.read(document, chunk);
      for (std::size_t i = 0; i < trees.size(); ++i) look(trees[i]);
    }
  };
}

}  // namespace isocnc::queries
