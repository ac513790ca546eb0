#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "interpreter/simulation/timed_run.h"
#include "interpreter/verification/verifier.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

/// A copy of a program and the machine to time it on, for use in a background request.
class TimedProgram {
 public:
  TimedProgram(const documents::Snapshot& snapshot, double vgpl);

  std::int64_t version() const { return version_; }
  const std::string& text() const { return text_; }
  const configuration::MachineConfiguration& machine() const { return settings_.configuration->machine; }
  /// What surrounds the program; null if nothing is known of it. May read files.
  std::shared_ptr<const verification::Scene> scene() const { return settings_.scene(); }
  /// The origin of the first workpiece frame; machine frame, mm.
  geometry::Vec3 workpiece_origin() const { return verification::first_workpiece_origin(text_, options_); }

  /// Runs the program to its end or first error. Calls `stop` at intervals and throws rpc::Error, RequestCancelled,
  /// when that returns true.
  running::RunResult run(const std::function<bool()>& stop, timing::TimingListeners listeners) const;

 private:
  std::string text_;
  documents::DocumentSettings settings_;
  running::RunOptions options_;
  std::int64_t version_;
};

}  // namespace isocnc::queries
