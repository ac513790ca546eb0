#pragma once

#include <optional>
#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "interpreter/comparison/machine_action.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::revisions {

/// One of two programs that are compared, with what it runs on. All must outlive it.
struct Revision {
  std::string_view text;
  const timing::TimedMachine& machine;
  const execution::Setup& setup;
  const selection::Selection& selection;       ///< Of findings.
  const verification::Scene* scene = nullptr;  ///< What surrounds it, if it is to be verified.
};

/// What the machine does in a run of a revision, and what that shows.
struct RevisionRun {
  std::string_view text;
  comparison::RecordedRun recorded;
  simulation::TakenPath path;
  check::Report findings;  ///< Those of the run that are shown, each mistake once.
  std::optional<verification::MaterialReport> material;
};

/// Runs a revision on its machine, with the VGPL and the registers of `options`, and in its scene if it has one.
RevisionRun run_revision(const Revision& revision, running::RunOptions options,
                         const verification::WorkTogether& together);

}  // namespace isocnc::revisions
