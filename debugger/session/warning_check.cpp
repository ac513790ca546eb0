#include "debugger/session/warning_check.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/check/jump_map.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/shown_report.h"

namespace isocnc::session {

using dialect::Language;
using Warnings = std::multimap<std::size_t, breakpoints::Warning>;

/// The lines with labels that jumps name, ascending.
static std::vector<std::size_t> find_jump_targets(std::string_view text) {
  const check::JumpMap jumps(text);
  std::vector<std::size_t> lines;
  if (jumps.empty()) return lines;
  check::each_event_in(text, [&](const check::FlowEvent& event) {
    if (event.kind == check::FlowEvent::Kind::Label && jumps.names(event.label)) lines.push_back(event.line);
  });
  return lines;
}

/// The lines on which a run may meet a warning first: its own, and of those that repeat it (D66) the first after each
/// label, since a jump to it may have passed over the others.
static std::set<std::size_t> first_lines(const check::LocatedFinding& found, const check::Report& report,
                                         const std::vector<std::size_t>& jump_targets) {
  std::set<std::size_t> lines = {found.line};
  if (found.repetitions < 0) return lines;
  for (auto target = std::upper_bound(jump_targets.begin(), jump_targets.end(), found.line);
       target != jump_targets.end(); ++target)
    if (const check::Repetition* const again = check::repetition_from(*target, found, report))
      lines.insert(again->line);
  return lines;
}

/// The warnings that isolint shows, by line from 0.
static Warnings find_warnings(const debuggee::Debuggee& debuggee, const std::filesystem::path& program,
                              Language language) {
  configuration::Configurations configurations({}, language);
  selection::SettingsFinder finder(configurations, {});
  const selection::ProgramSettings& settings = finder.of(program);
  const std::string_view text = debuggee.text().text();
  const rules::CheckSetup setup{debuggee.setup(), settings.setup.thresholds, settings.setup.every_motion};
  const check::Report report = selection::shown_report(check::check_text(text, setup), text, settings.selection);
  const std::vector<std::size_t> jump_targets = find_jump_targets(text);
  Warnings warnings;
  for (const check::LocatedFinding& found : report.findings) {
    if (found.severity() != dialect::Severity::Warning) continue;
    const std::string_view line = debuggee.text().line(found.line);
    const breakpoints::Warning warning{found.finding.id, formats::message_of(found, report, line, language)};
    for (const std::size_t at : first_lines(found, report, jump_targets)) warnings.emplace(at, warning);
  }
  return warnings;
}

void WarningCheck::start_if_needed() {
  if (is_started_ || is_running_ || !state_.exception_filters.is_on(breakpoints::ExceptionFilter::Warnings)) return;
  is_running_ = is_started_ = true;
  pool_.post([this, debuggee = state_.debuggee, program = state_.launch_options.program, language = state_.language()] {
    loop_.post(
        [this, debuggee, warnings = find_warnings(*debuggee, program, language)] { finish(debuggee, warnings); });
  });
}

void WarningCheck::finish(const std::shared_ptr<debuggee::Debuggee>& checked, Warnings warnings) {
  is_running_ = false;
  if (checked == state_.debuggee) state_.exception_filters.warnings = std::move(warnings);
}

}  // namespace isocnc::session
