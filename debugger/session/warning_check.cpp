#include "debugger/session/warning_check.h"

#include <algorithm>
#include <utility>

#include "analyzer/check/check_text.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/shown_report.h"

namespace isocnc::session {

using dialect::Language;
using Warnings = std::multimap<std::uint64_t, breakpoints::Warning>;

static breakpoints::Warning warning_of(const check::LocatedFinding& found, std::string_view line, Language language) {
  const auto& finding = found.finding;
  const std::string_view marked =
      line.substr(std::min<std::size_t>(finding.span.begin, line.size()), finding.span.end - finding.span.begin);
  return {finding.id, dialect::message(finding.id, language, marked, finding.values)};
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
  Warnings warnings;
  for (const check::LocatedFinding& found : report.findings)
    if (found.severity() == dialect::Severity::Warning)
      warnings.emplace(found.line, warning_of(found, debuggee.text().line(found.line), language));
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
