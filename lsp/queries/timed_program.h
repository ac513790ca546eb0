#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "interpreter/simulation/timed_run.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

/// A copy of a program and the machine to time it on, for use in a background request.
class TimedProgram {
 public:
  TimedProgram(const documents::Snapshot& snapshot, double vgpl);

  std::int64_t version() const { return version_; }
  const configuration::MachineConfiguration& machine() const { return *machine_; }

  /// Runs the program to its end or first error. Calls `stop` at intervals and throws rpc::Error, RequestCancelled,
  /// when that returns true.
  running::RunResult run(const std::function<bool()>& stop, simulation::Timing::Listeners listeners) const;

 private:
  std::string text_;
  std::shared_ptr<const void> settings_owner_;
  const configuration::MachineConfiguration* machine_;
  running::RunOptions options_;
  std::int64_t version_;
};

}  // namespace isocnc::queries
