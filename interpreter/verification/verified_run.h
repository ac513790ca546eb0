#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "interpreter/simulation/run_findings.h"
#include "interpreter/verification/material.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::verification {

/// What a run in a scene has shown.
struct VerifiedRun {
  simulation::RunOutcome outcome;          ///< With the findings of the scene.
  std::vector<Contact> contacts;           ///< By time.
  std::optional<Certificate> certificate;  ///< None without a scene.
  std::optional<MaterialReport> material;  ///< None if the scene describes no stock.
};

/// The finding that tells a contact, without a span.
syntax::Finding finding_of(const Contact& contact);

/// The finding that tells what could not be verified, without a span.
syntax::Finding finding_of(const Unverified& gap);

/// Adds what could not be verified, and its finding.
void add_gap(VerifiedRun& run, const Unverified& gap, std::string_view text);

/// Ends a verifier, and adds what it has found to the outcome of the run that it has heard. `text` is that of the
/// program.
VerifiedRun verified_outcome(simulation::RunOutcome outcome, Verifier& verifier, std::string_view text,
                             const running::RunResult& result);

/// Runs a program on the machine and returns what that shows, in a scene if there is one. Without a scene, no times are
/// computed. `options.before_block` is replaced.
VerifiedRun verified_run(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine,
                         const Scene* scene, WorkTogether work_together = {}, const MaterialOptions& material = {});

}  // namespace isocnc::verification
