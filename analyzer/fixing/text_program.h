#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "analyzer/check/checker.h"
#include "analyzer/check/jump_map.h"
#include "analyzer/fixes/fix.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::fixing {

/// A text as a Program for fixes. Facts are computed on demand; if asked for from top to bottom, all states together
/// cost no more than one check of the text.
class TextProgram final : public fixes::FixProgram {
 public:
  /// Both must outlive this. `on_line` is called for each line asked for; it may throw to end a long search.
  TextProgram(std::string_view text, const rules::CheckSetup& setup, std::function<void()> on_line = {});
  ~TextProgram() override;

  const execution::Setup& setup() const override { return setup_.machine; }
  const dialect::LintThresholds& thresholds() const override { return setup_.thresholds; }
  std::size_t line_count() const override;
  std::string_view text(std::size_t line) override;
  syntax::LineTree line(std::size_t line) override;
  std::optional<execution::State> state_before(std::size_t line) override;
  bool is_read(std::size_t line) override;
  bool is_jumped_to(std::uint64_t label) override;

  /// The frontier before a line, up to line_count().
  const check::Frontier& frontier_before(std::size_t line);
  const check::JumpMap& jumps();

  /// The byte offset of a position in the text.
  std::size_t offset(const syntax::Position& position) const;
  /// The line's terminator; for the last line that of the line above, or LF if there is none.
  std::string_view line_end(std::size_t line) const;

 private:
  struct Walk;

  const std::vector<std::size_t>& starts() const;
  std::uint64_t highest_line_number() override;

  std::string_view text_;
  const rules::CheckSetup& setup_;
  std::function<void()> on_line_;
  mutable std::vector<std::size_t> starts_;  // The starts of the lines; computed on demand.
  syntax::TreeStore tree_;                   // The tree of line `parsed_`.
  std::optional<std::size_t> parsed_;
  std::optional<check::JumpMap> jumps_;
  std::unique_ptr<Walk> walk_;  // The check, up to the last line asked for.
};

}  // namespace isocnc::fixing
