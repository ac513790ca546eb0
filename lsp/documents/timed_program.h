#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "interpreter/simulation/timed_run.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::lsp::documents {

/// A program as it stood, and the machine that it is timed on: what a study takes with it.
class TimedProgram {
 public:
  TimedProgram(const Snapshot& snapshot, double vgpl);

  std::int64_t version() const { return version_; }
  const configuration::Machine& machine() const { return *machine_; }

  /// Runs it, up to an error. Asked now and then whether to `stop`, it throws rpc::Error, RequestCancelled.
  running::RunResult run(const std::function<bool()>& stop, simulation::Timing::Listeners listeners) const;

 private:
  std::string text_;
  std::shared_ptr<const void> settings_owner_;
  const configuration::Machine* machine_;
  running::RunOptions options_;
  std::int64_t version_;
};

}  // namespace isocnc::lsp::documents
