#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "analyzer/selection/program_settings.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::selection {

/// How a program is verified.
struct VerifyOptions {
  verification::WorkTogether together = {};  ///< Without it, on the caller's thread alone.
  /// Asked at intervals: where it returns true, the run ends there, and the result is that of the blocks before.
  std::function<bool()> stop = {};
  verification::MaterialOptions material = {};
};

/// The number of paths on which a program is verified at most.
inline constexpr std::size_t kMaxVerifiedPaths = 8;

/// Runs a program on the machine of its configuration, with all registers 0, in a scene if `scene` is not null: with
/// VGPL 0, and with other values that lead it along other paths. See verified_on_paths().
verification::VerifiedRun verified(std::string_view text, const ProgramSettings& settings,
                                   const verification::Scene* scene, const VerifyOptions& options = {});

/// Runs a program with the VGPL of `options`, and once more for each other path that a value of VGPL leads it along;
/// VGPL keeps its value during a run. The outcome is that of all runs: what only others than the first find has a path.
/// Where more than kMaxVerifiedPaths paths are left, or a jump depends on a register that the program has not assigned,
/// a finding says so (W162). The certificate is that of all runs; the contacts are those of the first.
verification::VerifiedRun verified_on_paths(std::string_view text, const running::RunOptions& options,
                                            const timing::TimedMachine& machine, const verification::Scene* scene,
                                            const verification::WorkTogether& together = {},
                                            const verification::MaterialOptions& material = {});

/// Adds to a single run of a program, and to its certificate, that other values of VGPL and of registers lead
/// elsewhere.
void add_other_paths(verification::VerifiedRun& run, std::string_view text);

}  // namespace isocnc::selection
