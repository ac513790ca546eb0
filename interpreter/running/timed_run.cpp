#include "interpreter/running/timed_run.h"

#include <utility>

namespace isocnc::running {

RunResult run_timed(std::string_view text, const RunOptions& options, const TimedMachine& machine,
                    Timing::Listeners listeners) {
  Timing timing(machine, std::move(listeners));
  Compensation compensation(machine);
  const Compensation::Listeners compensated = {.event = [&](const Event& event) { timing.take(event); },
                                               .warning = [](const RunWarning&) {}};
  RunResult result = run(text, options, [&](const Event& event) { compensation.take(event, compensated); });
  compensation.finish(compensated);
  timing.finish();
  return result;
}

}  // namespace isocnc::running
