#include "interpreter/simulation/timed_run.h"

#include <utility>

namespace isocnc::simulation {

running::RunResult run_timed(std::string_view text, const running::RunOptions& options,
                             const timing::TimedMachine& machine, timing::TimingListeners listeners) {
  timing::Timing timing(machine, std::move(listeners));
  Compensation compensation(machine);
  const Compensation::Listeners compensated = {.event = [&](const running::Event& event) { timing.take(event); },
                                               .warning = [](const RunWarning&) {}};
  running::RunResult result =
      run(text, options, [&](const running::Event& event) { compensation.take(event, compensated); });
  compensation.finish(compensated);
  timing.finish();
  return result;
}

}  // namespace isocnc::simulation
