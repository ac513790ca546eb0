#include "debugger/difference/first_difference.h"

#include <algorithm>

#include "interpreter/comparison/comparison_text.h"
#include "interpreter/dialect/format.h"

namespace isocnc::difference {

using comparison::BehaviorChange;
using dialect::Text;

static constexpr Text kFirst{"first difference: {}, {}", "prima differenza: {}, {}"};
static constexpr Text kLine{"line {} of {}", "riga {} di {}"};
static constexpr Text kLines{"lines {}-{} of {}", "righe {}-{} di {}"};
static constexpr Text kBeforeLine{"before line {} of {}", "prima della riga {} di {}"};
static constexpr Text kSame{"no difference from {} in what the machine does",
                            "nessuna differenza da {} in ciò che fa la macchina"};
static constexpr Text kStops{"{} cannot be compared: it stops at its line {} with {}",
                             "{} non si può confrontare: si ferma alla sua riga {} con {}"};

/// `line 34 of old.iso`
static std::string shown_place(const BehaviorChange& change, const std::string& name, dialect::Language language) {
  if (!change.old_lines) return dialect::format(kBeforeLine, language, change.old_start + 1, name);
  const auto [first, last] = *change.old_lines;
  return first == last ? dialect::format(kLine, language, first + 1, name)
                       : dialect::format(kLines, language, first + 1, last + 1, name);
}

FirstDifference ReferenceComparison::find(const std::function<bool()>& stop) const {
  running::RunOptions old_options = reference.options;
  running::RunOptions new_options = options;
  old_options.stop = new_options.stop = stop;
  const comparison::RecordedRun old_run = comparison::record(reference.text, old_options, reference.machine);
  if (stop()) return {};
  if (const std::string_view error = comparison::error_of(old_run); !error.empty())
    return {.line = {},
            .text = dialect::format(kStops, language, reference.name, old_run.actions.back().line + 1, error)};
  const comparison::RecordedRun new_run = comparison::record(debuggee->text().text(), new_options, machine);
  if (stop()) return {};
  const std::vector<BehaviorChange> changes = comparison::compare(old_run, new_run, {});
  if (changes.empty()) return {.line = {}, .text = dialect::format(kSame, language, reference.name)};
  // Jumps lead forward only, so the order of the lines is that of the run.
  const BehaviorChange& first = *std::min_element(
      changes.begin(), changes.end(),
      [](const BehaviorChange& one, const BehaviorChange& other) { return one.new_start < other.new_start; });
  return {.line = first.new_start,
          .text = dialect::format(kFirst, language, comparison::in_words(first, language),
                                  shown_place(first, reference.name, language))};
}

}  // namespace isocnc::difference
