#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/lint_thresholds.h"
#include "interpreter/execution/state.h"
#include "interpreter/syntax/document.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::fixes {

/// Replaces the text between two positions: lines and byte columns from 0, the end exclusive; column 0 of the line
/// after the last terminator is the end of the program.
struct Edit {
  syntax::Position begin;
  syntax::Position end;
  std::string text;  ///< `\n` is a line end, whichever kind the program uses.

  /// The text with the program's own line ends.
  std::string text_with(std::string_view line_end) const;

  friend bool operator==(const Edit&, const Edit&) = default;
};

/// `Safe`: it is certain what the program does or was meant to do. `Unsafe`: the fix gives the most likely meaning.
enum class Safety : std::uint8_t { None, Safe, Unsafe };

/// A practice of the author that must be fixed throughout a program or not at all (D70): an instance that is left may
/// be legal and mean something else.
enum class Habit : std::uint8_t {
  None,
  CentersInG90,  ///< Centers of arcs counted from the start under G90.
  CentersInG91,  ///< Absolute centers under G91.
  ForeignUnits,  ///< G20 and G21 used for inches and millimeters.
  Milliseconds,  ///< Times of G04 in milliseconds.
};
inline constexpr std::size_t kHabitCount = 5;

/// A fix of a finding, as data: making and applying it needs no file, screen or protocol.
struct Fix {
  Safety safety = Safety::Unsafe;
  dialect::Text title;
  std::string marked;  ///< The value of `{text}` in the title: the program text under the finding's mark.
  std::string what;    ///< The value of `{new}` in the title.
  std::vector<Edit> edits;
  std::size_t more_lines = 0;      ///< The number of other lines on which the edits do the same.
  bool mends_repetitions = false;  ///< Whether the edits of the first of some repeated findings mend them all (D66).
  /// With a habit, `edits` are those of the finding's own line; they fix nothing without the others of
  /// Program::habits().
  Habit habit = Habit::None;

  /// The title: a few words in the imperative, without a period.
  std::string title_in(dialect::Language language) const;
};

class Habits;

/// The facts about the program that a fix may need. Lines are counted as in syntax::Document: a terminator at the end
/// is followed by an empty line.
class FixProgram {
 public:
  FixProgram();
  virtual ~FixProgram();
  FixProgram(const FixProgram&) = delete;
  FixProgram& operator=(const FixProgram&) = delete;

  virtual const execution::Setup& setup() const = 0;
  virtual const dialect::LintThresholds& thresholds() const = 0;

  virtual std::size_t line_count() const = 0;
  /// The text of a line without its terminator.
  virtual std::string_view text(std::size_t line) = 0;
  /// Valid until the next call.
  virtual syntax::LineTree line(std::size_t line) = 0;
  /// The state before a line, if it is the same on all paths; lines up to line_count(), the end of the program.
  virtual std::optional<execution::State> state_before(std::size_t line) = 0;
  /// Whether a path leads to the line.
  virtual bool is_read(std::size_t line) = 0;
  /// Whether a GOTO names this label.
  virtual bool is_jumped_to(std::uint64_t label) = 0;
  /// A line number that the program does not have; each call gives a new one.
  std::optional<std::uint64_t> free_line_number();

  virtual Habits& habits();

 private:
  /// The highest line number of the program.
  virtual std::uint64_t highest_line_number() = 0;

  std::optional<std::uint64_t> last_line_number_;  // The highest one, or the one that free_line_number() gave last.
  std::unique_ptr<Habits> habits_;
};

/// A finding and its line.
struct FindingPlace {
  std::size_t line = 0;  ///< The line, from 0.
  const syntax::Finding& finding;
  bool on_every_path = true;
};

/// The maximum length of a line with fixes. Longer lines have usually lost their line ends and may have thousands of
/// findings, so that looking through them for each finding would take too long.
inline constexpr std::size_t kLongestLine = 1'000;

/// The edits of a fix, with all other edits of its habit.
std::vector<Edit> all_edits(const Fix& fix, FixProgram& program);

/// The fix of a finding, if there is one.
std::optional<Fix> fix_of(const FindingPlace& place, FixProgram& program);

}  // namespace isocnc::fixes
