#include "analyzer/revisions/revision_run.h"

#include <utility>

#include "analyzer/selection/run_report.h"

namespace isocnc::revisions {

using namespace dialect::literals;

/// The findings that are shown, but not that an error stops the run, which is a change if it is one.
static check::Report shown_findings(const simulation::RunOutcome& outcome, const Revision& revision) {
  simulation::RunOutcome rest = outcome;
  std::erase_if(rest.findings, [](const simulation::RunFinding& each) {
    return each.finding.id == "not-verified"_diag && each.finding.cause == 0;
  });
  return selection::shown_run_report(rest, revision.text, revision.selection);
}

RevisionRun run_revision(const Revision& revision, running::RunOptions options,
                         const verification::WorkTogether& together) {
  options.setup = revision.setup;
  RevisionRun run{.text = revision.text, .recorded = {}, .path = {}, .findings = {}, .material = {}};
  simulation::RunFindings findings(revision.machine);
  std::optional<verification::Verifier> verifier;
  if (revision.scene != nullptr)
    verifier.emplace(*revision.scene, revision.machine, verification::first_workpiece_origin(revision.text, options),
                     together);
  comparison::RecordingListeners listeners{
      .block = [&](const running::Block& block) { findings.take(block); },
      .programmed = [&](const running::Event& event) { findings.take(event); },
      .warning = [&](const simulation::RunWarning& warning) { findings.take(warning); },
      .made =
          [&](const timing::TimedEvent& timed, kinematics::MadeMove* made) {
            if (made != nullptr) findings.take(timed.event, *made);
            if (verifier) verifier->take(timed);
          },
      .stretch = {},
      .ended =
          [&](const running::RunResult& result) {
            simulation::RunOutcome outcome = findings.outcome(revision.text, result);
            run.path = outcome.runs.front();
            if (verifier) {
              verification::VerifiedRun verified =
                  verification::verified_outcome(std::move(outcome), *verifier, revision.text, result);
              outcome = std::move(verified.outcome);
              run.material = std::move(verified.material);
            }
            run.findings = shown_findings(outcome, revision);
          }};
  if (verifier)
    listeners.stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
      verifier->take(stretch, removal::MotionFacts(timed));
    };
  run.recorded = comparison::record(revision.text, std::move(options), revision.machine, listeners);
  return run;
}

}  // namespace isocnc::revisions
