#pragma once

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
};

/// Runs a program on the machine of its configuration, with VGPL and all registers 0, in a scene if `scene` is not
/// null.
verification::VerifiedRun verified(std::string_view text, const ProgramSettings& settings,
                                   const verification::Scene* scene, const VerifyOptions& options = {});

}  // namespace isocnc::selection
