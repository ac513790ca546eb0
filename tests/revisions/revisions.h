#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "analyzer/revisions/path_comparison.h"
#include "analyzer/revisions/revision_report.h"

namespace isocnc::revisions {

/// A machine whose X ends at 100, and whose feed at 5000 mm/min.
inline timing::TimedMachine limited_machine() {
  timing::TimedMachine machine;
  machine.motion.axes[0].minimum = 0;
  machine.motion.axes[0].maximum = 100;
  machine.motion.feed_speed = 5000.0 / 60;
  return machine;
}

inline Revision revision_of(std::string_view text) {
  static const timing::TimedMachine machine = limited_machine();
  static const execution::Setup setup;
  static const selection::Selection selection;
  return {text, machine, setup, selection};
}

inline RevisionComparison compared(std::string_view old_program, std::string_view new_program) {
  const Revision old_revision = revision_of(old_program);
  const Revision new_revision = revision_of(new_program);
  return compare({old_revision, new_revision}, {});
}

/// `new W131 -|5`, a line for each change of a finding.
inline std::string shown_findings(const RevisionComparison& compared) {
  static constexpr std::string_view kKinds[] = {"new", "gone", "changed"};
  std::string text;
  for (const FindingChange& change : compared.findings) {
    const auto line = [](const RevisionRun& run, const std::optional<std::size_t>& finding) {
      return finding ? std::to_string(run.findings.findings[*finding].line + 1) : "-";
    };
    const check::LocatedFinding& located = change.new_finding ? compared.new_run.findings.findings[*change.new_finding]
                                                              : compared.old_run.findings.findings[*change.old_finding];
    text += fmt::format("{} {} {}|{}\n", kKinds[static_cast<std::size_t>(change.kind)],
                        dialect::definition(located.finding.id).code, line(compared.old_run, change.old_finding),
                        line(compared.new_run, change.new_finding));
  }
  return text;
}

}  // namespace isocnc::revisions
