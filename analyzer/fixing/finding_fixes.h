#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/fixing/fix_trial.h"
#include "analyzer/fixing/text_program.h"

namespace isocnc::fixing {

/// An edit as the output formats show it: lines and columns from 1, columns in code points, the end exclusive; the text
/// has the program's own line ends.
struct ShownEdit {
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t end_line = 0;
  std::size_t end_column = 0;
  std::string text;
};

/// The maximum number of lines with edits of one fix, where a reader looks at them.
inline constexpr std::size_t kMaxFixedLines = 1'000;

/// The fix of a finding, with the edits for the lines that repeat it (D66), unless there are `max_lines` of them.
std::optional<fixes::Fix> fix_of_all_lines(const check::LocatedFinding& located, const check::Report& report,
                                           bool on_every_path, fixes::FixProgram& program, std::size_t max_lines);

/// The fixes of a report's findings; fastest if asked for in the order of the findings.
class FindingFixes {
 public:
  /// All must outlive this.
  FindingFixes(std::string_view text, const check::Report& report, const rules::CheckSetup& setup);

  std::optional<fixes::Fix> of(const check::LocatedFinding& located, std::size_t max_lines = kMaxFixedLines);
  /// of() without fixes that a trial rejects (FixTrial): what may be offered to users. For a habit, only the edits of
  /// the finding's own line.
  std::optional<fixes::Fix> offered(const check::LocatedFinding& located, std::size_t max_lines = kMaxFixedLines);
  /// offered() with all edits of the fix. The edits of a habit come with the first of its findings; the others have no
  /// fix, since applying it twice would be wrong.
  std::optional<fixes::Fix> offered_in_full(const check::LocatedFinding& located);
  std::vector<ShownEdit> shown(const fixes::Fix& fix);
  /// The line as the fix would leave it, if the fix changes nothing else.
  std::optional<std::string> changed_line(const check::LocatedFinding& located, const fixes::Fix& fix);
  TextProgram& program() { return program_; }

 private:
  std::size_t column(const syntax::Position& position);

  TextProgram program_;
  const check::Report& report_;
  const rules::CheckSetup& setup_;
  std::optional<FixTrial> trial_;                         // Made when first needed.
  std::array<bool, fixes::kHabitCount> given_in_full_{};  // Habits already given by offered_in_full().
  std::size_t reduced_from_;                              // The first line from which not every path is known.
  // The last counted column; the next one on the same line is counted from there.
  std::size_t counted_line_ = 0;
  std::size_t counted_bytes_ = 0;
  std::size_t counted_columns_ = 0;
};

/// The text with the edits applied. They must not overlap; they are sorted.
std::string edited(std::string_view text, std::vector<fixes::Edit>& edits, const TextProgram& program);

}  // namespace isocnc::fixing
