#pragma once

#include <map>

#include "debugger/session/session_state.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::session {

/// Lets the checker read the program on a thread of its own, so that the run can stop at its warnings.
class WarningCheck {
 public:
  /// Keeps references to both.
  WarningCheck(rpc::Loop& loop, SessionState& state) : loop_(loop), state_(state), pool_(loop, 1) {}

  /// Starts where warnings are asked for and the program has not been checked. They go to the exception filters.
  void start_if_needed();
  bool is_running() const { return is_running_; }
  /// Another program has been launched.
  void forget() { is_started_ = false; }

 private:
  void finish(const std::shared_ptr<debuggee::Debuggee>& checked,
              std::multimap<std::size_t, breakpoints::Warning> warnings);

  rpc::Loop& loop_;
  SessionState& state_;
  bool is_running_ = false;
  bool is_started_ = false;
  rpc::Pool pool_;  ///< Last, so that its thread ends before the rest is destroyed.
};

}  // namespace isocnc::session
