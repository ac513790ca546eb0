#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>

#include "debugger/session/session_state.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::session {

/// Lets the checker read the program, and a run on the machine show what it finds, on a thread of its own, so that the
/// run that is debugged can stop there.
class ProgramCheck {
 public:
  /// Keeps references to both.
  ProgramCheck(rpc::Loop& loop, SessionState& state) : loop_(loop), state_(state), pool_(loop, 1) {}
  ProgramCheck(const ProgramCheck&) = delete;
  ProgramCheck& operator=(const ProgramCheck&) = delete;
  ~ProgramCheck() { forget(); }

  /// Starts what exception filters ask for and has not been done for this program. The findings go to the filters.
  void start_if_needed();
  bool is_running() const { return running_ > 0; }
  /// Another program has been launched.
  void forget();

 private:
  using Findings = std::multimap<std::size_t, breakpoints::Warning>;
  /// Finds something about the program, on the check's thread; ends early once `is_forgotten`.
  using Find = std::function<Findings(const std::atomic<bool>& is_forgotten)>;

  void start(const Find& find, Findings breakpoints::ExceptionFilters::*taker);

  rpc::Loop& loop_;
  SessionState& state_;
  int running_ = 0;  ///< Checks of this program that are under way.
  bool has_started_check_ = false;
  bool has_started_run_ = false;
  std::shared_ptr<std::atomic<bool>> is_forgotten_ = std::make_shared<std::atomic<bool>>(false);
  rpc::Pool pool_;  ///< Last, so that its thread ends before the rest is destroyed.
};

}  // namespace isocnc::session
