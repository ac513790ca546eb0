#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/document.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::fixes {

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

/// What an author does throughout a program, so that it is mended everywhere or nowhere (D70): what is left of it may
/// be legal, and mean something else.
enum class Habit : std::uint8_t {
  None,
  CentersInG90,  ///< Centers of arcs count from the start under G90.
  CentersInG91,  ///< Centers are absolute under G91.
  ForeignUnits,  ///< G20 and G21 for inches and millimeters.
  Milliseconds,  ///< Waiting times of G04.
};
inline constexpr std::size_t kHabitCount = 5;

/// How a finding can be mended, as data: no file, screen or protocol is needed to make or to apply it.
struct Fix {
  Safety safety = Safety::Unsafe;
  dialect::Text title;
  std::string marked;  ///< What the title calls `{text}`: the program text under the finding's mark.
  std::string what;    ///< What the title calls `{new}`.
  std::vector<Edit> edits;
  /// With a habit, `edits` are those of the finding's own line, and mend nothing without Program::habits().
  Habit habit = Habit::None;

  /// A few words in the imperative, without a full stop.
  std::string title_in(dialect::Language language) const;
};

class Habits;

/// What a fix may have to know of the program around its line. Lines are counted as syntax::Document counts them: a
/// terminator at the end is followed by an empty line.
class Program {
 public:
  Program();
  virtual ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  virtual const execution::Setup& setup() const = 0;

  virtual std::uint64_t line_count() const = 0;
  /// Without its terminator.
  virtual std::string_view text(std::uint64_t line) = 0;
  /// Valid until the next call.
  virtual syntax::LineTree line(std::uint64_t line) = 0;
  /// The state before a line, where all paths to it agree; lines up to line_count(), which is the end.
  virtual std::optional<execution::State> state_before(std::uint64_t line) = 0;
  /// Whether a path leads to the line.
  virtual bool is_read(std::uint64_t line) = 0;
  /// Whether a GOTO names this label.
  virtual bool is_jumped_to(std::uint64_t label) = 0;
  /// A line number that the program does not have, another one each time.
  virtual std::optional<std::uint64_t> free_line_number() = 0;

  virtual Habits& habits();

 private:
  std::unique_ptr<Habits> habits_;
};

/// A finding and where it stands.
struct Place {
  std::uint64_t line = 0;  ///< From 0.
  const syntax::Finding& finding;
  bool on_every_path = true;
};

/// Longer lines have lost their line ends; they may have thousands of findings, and to look through them for each would
/// take long. They have no fix.
inline constexpr std::size_t kLongestLine = 1'000;

/// The edits of a fix, with all others that its habit takes.
std::vector<Edit> all_edits(const Fix& fix, Program& program);

/// The fix of a finding, when there is one.
std::optional<Fix> fix_of(const Place& place, Program& program);

}  // namespace isocnc::fixes
