#include "analyzer/selection/verified.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "analyzer/selection/joined_runs.h"
#include "analyzer/selection/vgpl_values.h"

namespace isocnc::selection {

using verification::VerifiedRun;

VerifiedRun verified(std::string_view text, const ProgramSettings& settings, const verification::Scene* scene,
                     const VerifyOptions& options) {
  const configuration::MachineConfiguration& machine = settings.configuration.machine;
  return verified_on_paths(text, {.setup = machine.setup, .stop = options.stop}, machine.timed, scene, options.together,
                           options.material);
}

/// Adds what no run has shown because of a jump.
static void add_gaps(VerifiedRun& run, const VgplValues& values) {
  std::vector<simulation::RunFinding>& findings = run.outcome.findings;
  for (const simulation::RunFinding& each : values.findings()) {
    const auto is_before = [](const simulation::RunFinding& a, const simulation::RunFinding& b) {
      return std::pair(a.line, a.finding.span.begin) < std::pair(b.line, b.finding.span.begin);
    };
    findings.insert(std::upper_bound(findings.begin(), findings.end(), each, is_before), each);
  }
  if (!run.certificate) return;
  const std::vector<verification::Unverified> gaps = values.gaps();
  run.certificate->gaps.insert(run.certificate->gaps.end(), gaps.begin(), gaps.end());
}

VerifiedRun verified_on_paths(std::string_view text, const running::RunOptions& options,
                              const simulation::TimedMachine& machine, const verification::Scene* scene,
                              const verification::WorkTogether& together,
                              const verification::MaterialOptions& material) {
  VerifiedRun first = verification::verified_run(text, options, machine, scene, together, material);
  if (first.outcome.runs.front().decisions.empty()) return first;  // Most programs have no jump.
  VgplValues values(text);
  values.take(first.outcome.runs.front());
  std::optional<double> vgpl = values.next();
  if (vgpl) {
    JoinedRuns joined;
    joined.add(std::move(first.outcome));
    for (std::size_t paths = 1; vgpl && paths < kMaxVerifiedPaths; ++paths) {
      if (options.stop && options.stop()) break;
      running::RunOptions other = options;
      other.vgpl = *vgpl;
      VerifiedRun run = verification::verified_run(text, other, machine, scene, together, material);
      values.take(run.outcome.runs.front());
      joined.add(std::move(run.outcome));
      vgpl = values.next();
    }
    first.outcome = std::move(joined).finish();
  }
  add_gaps(first, values);
  return first;
}

void add_other_paths(VerifiedRun& run, std::string_view text) {
  if (run.outcome.runs.front().decisions.empty()) return;
  VgplValues values(text);
  values.take(run.outcome.runs.front());
  add_gaps(run, values);
}

}  // namespace isocnc::selection
