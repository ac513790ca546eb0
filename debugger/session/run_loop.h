#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

#include "debugger/dap/step.h"
#include "debugger/debuggee/file_watch.h"
#include "debugger/debuggee/pace.h"
#include "debugger/difference/difference_search.h"
#include "debugger/session/backward_search.h"
#include "debugger/session/notifier.h"
#include "debugger/session/program_check.h"
#include "debugger/session/stop_check.h"
#include "lsp/rpc/loop.h"

namespace isocnc::session {

/// Runs the debuggee, forward and backward, and reports where it stops. A run is cut into slices of a few milliseconds,
/// each a task of the loop, so that requests are answered in between. All members but reset(), finish() and abandon()
/// take a debuggee that is launched.
class RunLoop {
 public:
  /// Keeps references to all.
  RunLoop(rpc::Loop& loop, SessionState& state, Notifier& notifier);

  bool is_running() const { return activity_ != Activity::None; }

  /// Another program has been launched: nothing of the run before is left.
  void reset(const debuggee::FileWatch& file);
  /// Goes to where the launch wants the run to begin. Does nothing when the program has been started already.
  void start_program();
  bool has_started_program() const { return has_started_; }

  // The debuggee stands. What comes of these is reported by events.
  void resume();
  /// Back to the last stop, or to the start.
  void reverse();
  void step(dap::Step step);
  void step_back(dap::Step step);
  /// To the end of the tool's section or of the frame, whichever comes first.
  void step_out();
  /// Forward or backward to a line, with the state that a run to it has. Nothing stops the run before.
  void go_to_line(std::size_t line);
  /// Forward or backward to where the program, as it was launched, comes to do something else than the reference.
  /// Nothing stops the run before. Stays where there is no difference.
  void run_to_difference(difference::ReferenceProgram reference);

  /// Stops a run where it is.
  void pause();
  /// Ends the run, with this exit status.
  void end_later(int exit_code);
  /// No event is sent any more.
  void abandon();

  /// The speed of the launch options has changed.
  void restart_pace();
  /// The program has been changed at the block that comes next: what is remembered of later blocks is void.
  void forget_future();
  /// Blocks run by hand have led to where the machine stands. The block that comes next is not judged again.
  void skip_judgement() { stop_check_.skip_judgement(); }

 private:
  using Clock = std::chrono::steady_clock;

  enum class Activity : std::uint8_t { None, Running, RunningBack, GoingToLine, Comparing };

  // Slices.
  void post(const std::function<void()>& task);
  void start(Activity activity);
  void schedule(std::chrono::milliseconds delay = {});
  void run_slice();
  void run_forward(Clock::time_point deadline);
  void run_backward(Clock::time_point deadline);
  void run_to_line(Clock::time_point deadline);

  // Parts of a run.
  void begin_program();
  std::optional<Stop> run_block(double until);
  std::uint64_t advance(const std::function<void(debuggee::Debuggee& debuggee)>& move);
  std::optional<Stop> end_block(std::uint64_t block);
  void end_at_error();
  void step_now(dap::Step step);
  void go_to_line(std::size_t line, const Stop& arrival);
  void go_forward_to_line(std::size_t line, const Stop& arrival);
  void go_backward_to_line(std::size_t line, const Stop& arrival);
  void take_difference(const difference::FirstDifference& found);
  bool pass_block();
  void arrive_at_line();
  void report_missed_line(std::size_t line, std::optional<std::uint64_t> place = {});
  void go_back_to(const BackwardSearch::Hit& hit);
  void go_back_to_start();
  void move_back(const std::function<void(debuggee::Debuggee& debuggee)>& move);

  // Stops.
  void stop(const Stop& stop);
  void settle(const Stop& arrival);
  void finish(int exit_code);
  void report_on_the_way();

  rpc::Loop& loop_;
  SessionState& state_;
  Notifier& notifier_;
  StopCheck stop_check_;
  ProgramCheck program_check_;
  difference::DifferenceSearch difference_search_;
  debuggee::FileWatch file_watch_;
  debuggee::Pace pace_;

  Activity activity_ = Activity::None;
  std::uint64_t generation_ = 0;  ///< Tasks of an earlier one are void.
  bool has_started_ = false;

  std::optional<BackwardSearch> search_;
  std::size_t target_line_ = 0;
  Stop arrival_;                                  ///< At target_line_.
  std::optional<simulation::Simulation> origin_;  ///< Where the run to target_line_ began.
};

}  // namespace isocnc::session
