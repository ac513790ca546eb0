#pragma once

#include <optional>

#include "analyzer/fixes/fix.h"
#include "analyzer/formatting/renumbering.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

/// A snapshot as the program that fixes and rewrites read.
class SnapshotProgram final : public fixes::FixProgram {
 public:
  explicit SnapshotProgram(const documents::Snapshot& snapshot) : snapshot_(snapshot) {}

  const execution::Setup& setup() const override { return snapshot_.setup(); }
  const dialect::LintThresholds& thresholds() const override { return snapshot_.check_setup().thresholds; }
  std::size_t line_count() const override { return snapshot_.document().line_count(); }
  std::string_view text(std::size_t line) override { return snapshot_.document().text_of_line(line); }
  syntax::LineTree line(std::size_t line) override;
  std::optional<execution::State> state_before(std::size_t line) override { return snapshot_.state_before(line); }
  /// The habits, found by one check of the whole text and kept until the document changes.
  fixes::Habits& habits() override;
  bool is_read(std::size_t line) override;
  bool is_jumped_to(std::uint64_t label) override;

 private:
  std::uint64_t highest_line_number() override;

  const documents::Snapshot& snapshot_;
  std::optional<syntax::DocumentLine> line_;  // The line requested last.
  std::uint32_t lines_seen_ = 0;
};

/// Visits all lines of the snapshot's document; calls throw_if_unwanted() at intervals.
formatting::EachLine each_line_of(const documents::Snapshot& snapshot);

}  // namespace isocnc::queries
