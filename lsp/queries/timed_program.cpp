#include "lsp/queries/timed_program.h"

#include <utility>

#include "lsp/rpc/message.h"

namespace isocnc::queries {

TimedProgram::TimedProgram(const documents::Snapshot& snapshot, double vgpl)
    : text_(snapshot.document().text()),
      settings_(snapshot.settings()),
      options_{.setup = snapshot.setup(), .vgpl = vgpl},
      version_(snapshot.version()) {}

running::RunResult TimedProgram::run(const std::function<bool()>& stop, timing::TimingListeners listeners) const {
  running::RunOptions options = options_;
  options.stop = stop;
  running::RunResult result = simulation::run_timed(text_, options, machine().timed, std::move(listeners));
  if (result.ending == running::Ending::Stopped)
    throw rpc::Error(rpc::ErrorCode::RequestCancelled, "the answer is no longer needed");
  return result;
}

}  // namespace isocnc::queries
