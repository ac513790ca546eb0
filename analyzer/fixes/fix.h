#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/document.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::analyzer::fixes {

/// Replaces what stands between two places: lines and byte columns from 0, the end exclusive; a place at the start of
/// the line behind the last terminator is the end of the program.
struct Edit {
  syntax::Position begin;
  syntax::Position end;
  std::string text;  ///< `\n` is a line end, whatever the program's line ends are.

  /// The text with the program's own line ends.
  std::string text_with(std::string_view line_end) const;

  friend bool operator==(const Edit&, const Edit&) = default;
};

/// `Safe`: what the program does, or was plainly meant to do, is beyond doubt. `Unsafe`: what is most likely meant.
enum class Safety : std::uint8_t { None, Safe, Unsafe };

/// How a finding can be mended, as data: no file, screen or protocol is needed to make or to apply it.
struct Fix {
  Safety safety = Safety::Unsafe;
  dialect::Text title;
  std::string marked;  ///< What the title calls `{text}`: the program text under the finding's mark.
  std::string what;    ///< What the title calls `{new}`.
  std::vector<Edit> edits;

  /// A few words in the imperative, without a full stop.
  std::string title_in(dialect::Language language) const;
};

/// What a fix may have to know of the program around its line. Lines are counted as syntax::Document counts them: a
/// terminator at the end is followed by an empty line.
class Program {
 public:
  virtual ~Program() = default;

  virtual std::uint64_t line_count() const = 0;
  /// Without its terminator.
  virtual std::string_view text(std::uint64_t line) = 0;
  /// Valid until the next call.
  virtual syntax::LineTree line(std::uint64_t line) = 0;
  /// The state before a line, where all paths to it agree; lines up to line_count(), which is the end.
  virtual std::optional<execution::State> state_before(std::uint64_t line) = 0;
  /// Whether a GOTO names this label.
  virtual bool is_jumped_to(std::uint64_t label) = 0;
  /// A line number that the program does not have, another one each time.
  virtual std::optional<std::uint64_t> free_line_number() = 0;
};

/// A finding and where it stands.
struct Place {
  std::uint64_t line = 0;  ///< From 0.
  const syntax::Finding& finding;
  bool on_every_path = true;
};

/// The fix of a finding, when there is one. Lines of more than 1000 bytes have none.
std::optional<Fix> fix_of(const Place& place, Program& program);

}  // namespace isocnc::analyzer::fixes
