#include "analyzer/formats/way_errors.h"

#include <algorithm>

#include "analyzer/formats/rendering.h"
#include "analyzer/selection/run_report.h"
#include "interpreter/dialect/format.h"
#include "interpreter/running/error_message.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::formats {

using dialect::Text;

std::vector<WayError> errors_on_the_way(std::string_view program, const running::RunOptions& options,
                                        const TrialMachine& machine, bool cuts) {
  const running::RunResult result = run(program, options, [](const running::Event&) {});
  syntax::LineFinder lines(program);
  if (result.ending == running::Ending::Error)
    return {{result.error.id, std::string(lines.line(result.line)), running::error_message(result, machine.language)}};
  const verification::VerifiedRun verified =
      verification::verified_run(program, options, machine.timed, machine.scene, {}, {.is_cut = cuts});
  const check::Report shown = selection::shown_run_report(verified.outcome, program, machine.selection);
  std::vector<WayError> errors;
  for (const check::LocatedFinding& located : shown.findings) {
    if (located.severity() != dialect::Severity::Error) continue;
    const std::string_view line = lines.line(located.line);
    errors.push_back({located.finding.id, std::string(line), message_of(located, shown, line, machine.language)});
  }
  return errors;
}

std::string obstacle_on_the_way_there(std::string_view program, std::string_view original,
                                      const running::RunOptions& options, const TrialMachine& machine) {
  if (machine.scene == nullptr) return {};
  const std::vector<WayError> found = errors_on_the_way(program, options, machine, false);
  if (found.empty()) return {};
  const std::vector<WayError> known = errors_on_the_way(original, options, machine, false);
  const auto is_new = [&](const WayError& error) {
    return std::none_of(known.begin(), known.end(),
                        [&](const WayError& each) { return each.id == error.id && each.block == error.block; });
  };
  const auto first = std::find_if(found.begin(), found.end(), is_new);
  return first == found.end() ? "" : first->message;
}

std::string restart_hits(std::size_t line, std::string_view obstacle, dialect::Language language) {
  static constexpr Text kRestartHits{"no safe restart before line {}: on the way, {}",
                                     "nessuna ripresa sicura dalla riga {}: lungo il percorso, {}"};
  return dialect::format(kRestartHits, language, line + 1, obstacle);
}

}  // namespace isocnc::formats
