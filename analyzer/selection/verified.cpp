#include "analyzer/selection/verified.h"

namespace isocnc::selection {

verification::VerifiedRun verified(std::string_view text, const ProgramSettings& settings,
                                   const verification::Scene* scene, const VerifyOptions& options) {
  const configuration::MachineConfiguration& machine = settings.configuration.machine;
  return verification::verified_run(text, {.setup = machine.setup, .stop = options.stop}, machine.timed, scene,
                                    options.together);
}

}  // namespace isocnc::selection
