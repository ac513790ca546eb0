#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "debugger/session/notifier.h"
#include "debugger/session/session_state.h"

namespace isocnc::session {

/// A stop that is due.
struct Stop {
  std::string_view reason;        ///< In the protocol.
  Json details = Json::object();  ///< Further members of the event.
};

/// Decides where a run forward stops: at breakpoints, at exceptions, and at the end of what is stepped out of. Each
/// block is judged once, when the run comes to stand before it. Costly questions are asked only where a breakpoint or
/// filter needs the answer.
class StopCheck {
 public:
  /// Keeps references to both. Messages of log points go to the notifier.
  StopCheck(SessionState& state, Notifier& notifier) : state_(state), notifier_(notifier) {}

  /// The run is about to execute the next block. A block that has been judged on arrival is not judged again.
  std::optional<Stop> before_block();
  /// The run has come to stand before a block, or within one.
  std::optional<Stop> on_arrival();
  /// The next block counts as not judged, or as judged already.
  void expect_judgement() { set_judged(false); }
  void skip_judgement() { set_judged(true); }

  /// The next moment within the block in progress or, between two blocks, within the next one at which the run may
  /// stop; seconds since the start.
  std::optional<double> next_moment();
  /// The run has come to that moment.
  std::optional<Stop> at_moment();
  /// The run has come to this moment, going back.
  Stop at_moment(const breakpoints::InnerMoment& moment, std::uint64_t block);

  /// A block begins: takes the values that data breakpoints watch.
  void start_block();
  /// The block with this number has ended, and not the program.
  std::optional<Stop> after_block(std::uint64_t block);
  /// An error has ended the program.
  Stop at_error();

  /// Stops where the tool or the frame is no longer that of now.
  void step_out();
  void forget_step_out() { step_out_from_.reset(); }

  /// Messages of log points since the last reset.
  std::size_t message_count() const { return message_count_; }
  void reset_message_count() { message_count_ = 0; }

 private:
  /// Moments that are still to come in a block.
  struct ComingMoments {
    std::uint64_t block = 0;
    std::uint64_t revision = 0;  ///< Of what stops the run.
    std::deque<breakpoints::InnerMoment> moments;
  };

  /// The machine may have been moved, or changed.
  void set_judged(bool is_judged) {
    is_judged_ = is_judged;
    coming_.reset();
  }
  std::optional<Stop> judge_block();
  bool ends_step_out() const;
  std::optional<Stop> judge_breakpoints();
  std::optional<Stop> judge_exceptions();
  Stop stop_at(breakpoints::Exception exception);
  Stop stop_at(breakpoints::MomentVerdict verdict);
  std::optional<breakpoints::Exception> find_exception() const;
  std::optional<breakpoints::Exception> find_coming_overtravel() const;
  void report_messages(const breakpoints::Breakpoints::BreakpointOutcome& outcome, std::size_t line);

  SessionState& state_;
  Notifier& notifier_;
  bool is_judged_ = false;  ///< The block that comes next.
  std::optional<ComingMoments> coming_;
  std::optional<execution::State> step_out_from_;  ///< State in which the step out began.
  expressions::ValueTrail trail_;                  ///< Values of the block in progress.
  std::size_t message_count_ = 0;
};

}  // namespace isocnc::session
