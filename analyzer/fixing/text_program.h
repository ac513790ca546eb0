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

/// A text as fixes look at it. What they ask for is found when they do, and asked for from top to bottom, a state costs
/// no more than one check of the whole text.
class TextProgram final : public fixes::Program {
 public:
  /// Both must outlive this. `on_line` is called for each line that is asked for; it may throw to end a long search.
  TextProgram(std::string_view text, const execution::Setup& setup, std::function<void()> on_line = {});
  ~TextProgram() override;

  const execution::Setup& setup() const override { return setup_; }
  std::uint64_t line_count() const override;
  std::string_view text(std::uint64_t line) override;
  syntax::LineTree line(std::uint64_t line) override;
  std::optional<execution::State> state_before(std::uint64_t line) override;
  bool is_read(std::uint64_t line) override;
  bool is_jumped_to(std::uint64_t label) override;
  std::optional<std::uint64_t> free_line_number() override;

  /// Where the check stands before a line, up to line_count().
  const check::Frontier& frontier_before(std::uint64_t line);
  const check::JumpMap& jumps();

  /// Where in the text a place is.
  std::size_t offset(const syntax::Position& position) const;
  /// The line's terminator; on the last line that of the line above, and LF where there is none.
  std::string_view line_end(std::uint64_t line) const;

 private:
  struct Walk;

  const std::vector<std::size_t>& starts() const;
  std::uint64_t highest_line_number() const;

  std::string_view text_;
  const execution::Setup& setup_;
  std::function<void()> on_line_;
  mutable std::vector<std::size_t> starts_;  // Where lines start; found when first asked for.
  syntax::TreeStore tree_;                   // The tree of line `parsed_`.
  std::optional<std::uint64_t> parsed_;
  std::optional<check::JumpMap> jumps_;
  std::unique_ptr<Walk> walk_;  // The check, up to the last line asked for.
  std::optional<std::uint64_t> last_line_number_;
};

}  // namespace isocnc::fixing
