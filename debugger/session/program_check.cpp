#include "debugger/session/program_check.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/check/jump_map.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/shown_report.h"
#include "debugger/session/launch.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::session {

using dialect::Language;
using Findings = std::multimap<std::size_t, breakpoints::Warning>;

namespace {

/// What a run of the program as it was launched takes.
struct ProgramRun {
  std::filesystem::path program;
  running::RunOptions options;
  configuration::Configuration configuration;
  Language language = Language::English;
};

}  // namespace

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
static Findings find_warnings(const debuggee::Debuggee& debuggee, const std::filesystem::path& program,
                              Language language) {
  configuration::Configurations configurations({}, language);
  selection::SettingsFinder finder(configurations, {});
  const selection::ProgramSettings& settings = finder.of(program);
  const std::string_view text = debuggee.text().text();
  const rules::CheckSetup setup{debuggee.setup(), settings.setup.thresholds, settings.setup.every_motion,
                                settings.setup.house_rules};
  const check::Report report = selection::shown_report(check::check_text(text, setup), text, settings.selection);
  const std::vector<std::size_t> jump_targets = find_jump_targets(text);
  Findings warnings;
  for (const check::LocatedFinding& found : report.findings) {
    if (found.severity() != dialect::Severity::Warning) continue;
    const std::string_view line = debuggee.text().line(found.line);
    const breakpoints::Warning warning{found.finding.id, formats::message_of(found, report, line, language)};
    for (const std::size_t at : first_lines(found, report, jump_targets)) warnings.emplace(at, warning);
  }
  return warnings;
}

/// What a run from the start shows, as launched, by line from 0: of each mistake the first line.
static Findings find_by_run(const ProgramRun& run, const debuggee::Debuggee& debuggee,
                            const std::atomic<bool>& is_forgotten) {
  configuration::Configurations configurations({}, run.language);
  selection::SettingsFinder finder(configurations, {});
  const selection::ProgramSettings& settings = finder.of(run.program);
  const std::string_view text = debuggee.text().text();
  running::RunOptions options = run.options;
  options.stop = [&] { return is_forgotten.load(); };
  configuration::Scenes scenes(run.language);
  const auto scene = scenes.of(run.configuration, run.program);
  const verification::VerifiedRun verified =
      verification::verified_run(text, std::move(options), run.configuration.machine.timed, scene.get());
  const check::Report report = selection::shown_run_report(verified.outcome, text, settings.selection);
  Findings findings;
  for (const check::LocatedFinding& found : report.findings) {
    if (found.severity() == dialect::Severity::Info) continue;
    const std::string_view line = debuggee.text().line(found.line);
    findings.emplace(found.line,
                     breakpoints::Warning{found.finding.id, formats::message_of(found, report, line, run.language)});
  }
  return findings;
}

void ProgramCheck::start_if_needed() {
  using breakpoints::ExceptionFilter;
  using breakpoints::ExceptionFilters;
  const auto is_wanted = [&](ExceptionFilter filter, bool& has_started) {
    return state_.exception_filters.is_on(filter) && !std::exchange(has_started, true);
  };
  if (is_wanted(ExceptionFilter::Warnings, has_started_check_)) {
    const auto find = [debuggee = state_.debuggee, program = state_.launch_options.program,
                       language = state_.language()](const std::atomic<bool>&) {
      return find_warnings(*debuggee, program, language);
    };
    start(find, &ExceptionFilters::warnings);
  }
  if (!is_wanted(ExceptionFilter::Run, has_started_run_)) return;
  const auto run =
      std::make_shared<const ProgramRun>(ProgramRun{.program = state_.launch_options.program,
                                                    .options = run_options(state_.launch_options, state_.configuration),
                                                    .configuration = state_.configuration,
                                                    .language = state_.language()});
  const auto find = [debuggee = state_.debuggee, run](const std::atomic<bool>& is_forgotten) {
    return find_by_run(*run, *debuggee, is_forgotten);
  };
  start(find, &ExceptionFilters::of_run);
}

void ProgramCheck::start(const Find& find, Findings breakpoints::ExceptionFilters::*taker) {
  ++running_;
  pool_.post([this, find, taker, is_forgotten = is_forgotten_] {
    if (is_forgotten->load()) return;
    loop_.post([this, taker, is_forgotten, findings = find(*is_forgotten)] {
      if (is_forgotten->load()) return;
      --running_;
      state_.exception_filters.*taker = findings;
    });
  });
}

void ProgramCheck::forget() {
  is_forgotten_->store(true);
  is_forgotten_ = std::make_shared<std::atomic<bool>>(false);
  running_ = 0;
  has_started_check_ = has_started_run_ = false;
}

}  // namespace isocnc::session
