#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "debugger/debuggee/file_watch.h"
#include "debugger/session/session_state.h"

namespace isocnc::session {

/// Sends the client its events. Positions and output come no faster than an editor can show them.
class Notifier {
 public:
  using Emit = std::function<void(std::string_view event, const Json& body)>;

  /// Keeps a reference to the state.
  Notifier(Emit emit, const SessionState& state) : emit_(std::move(emit)), state_(state) {}

  /// `details` are further members of the event.
  void report_stop(std::string_view reason, Json details);
  /// The program runs because of a request of which the client does not know that.
  void report_resumption();
  /// `exited` and `terminated`.
  void report_exit(int exit_code);
  /// All that the client shows may have changed.
  void report_invalidated();

  /// `isocnc/position` of a machine that stands.
  void report_standing_position();
  /// `isocnc/position` of a machine that runs, at most 60 times a second.
  void report_running_position();

  /// A line of output, with its place in the program where one is given.
  void report_output(std::string_view category, const std::string& text, std::optional<std::size_t> line = {});
  /// What the machine does besides motions. At most 200 lines a second; the others are counted.
  void report_events(std::span<const running::Event> events);
  /// How many of these lines have been left out since the last call.
  void report_omissions();
  /// Messages of log points. None is left out.
  void report_messages(const breakpoints::Breakpoints::BreakpointOutcome& outcome, std::size_t line);

  /// The breakpoint, a `Breakpoint` of the protocol, lies elsewhere than before.
  void report_moved_breakpoint(const Json& breakpoint);
  void report_file_change(debuggee::FileWatch::FileChange change);

  /// A search or run starts that may report its progress.
  void start_progress();
  /// Progress from 0 to 1, of what takes longer than half a second.
  void report_progress(const std::string& title, double part);
  void end_progress();

 private:
  using Clock = std::chrono::steady_clock;

  void report_position(bool is_running);
  Json tool_json() const;
  bool may_report_event();

  const Emit emit_;
  const SessionState& state_;

  Clock::time_point last_position_;
  Clock::time_point output_second_;
  std::size_t outputs_ = 0;  ///< Lines reported in that second.
  std::size_t omitted_ = 0;
  Clock::time_point progress_start_;
  Clock::time_point last_progress_;
  std::optional<std::int64_t> progress_;  ///< Id of the progress that the client shows.
  std::int64_t progress_ids_ = 0;
};

}  // namespace isocnc::session
