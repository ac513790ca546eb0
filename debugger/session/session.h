#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "debugger/session/breakpoints.h"
#include "debugger/session/client.h"
#include "debugger/session/debuggee.h"
#include "debugger/session/journal.h"
#include "debugger/session/launch.h"
#include "debugger/session/request_error.h"
#include "debugger/session/watchmen.h"
#include "interpreter/dialect/format.h"
#include "lsp/rpc/loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::debugger::session {

/// How far a step goes.
enum class Step : std::uint8_t { Block, Instruction };

/// The program that is debugged, and what is being done with it. It lives on the loop's thread. A run is cut into
/// slices of a few milliseconds, each a task of the loop, so that whatever the client asks is answered in between.
class Session {
 public:
  using Emit = std::function<void(std::string_view event, const Json& body)>;

  Session(lsp::rpc::Loop& loop, Emit emit, std::optional<dialect::Language> language);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Client client;
  /// A breakpoint as the client wants it, which lies on a line that does something, if one follows.
  struct LineWish {
    std::int64_t id = 0;
    std::uint64_t wanted = 0;
    std::optional<std::uint64_t> line;  ///< None: nowhere.
    BreakpointRules rules;
    std::string problem;  ///< Of its rules; then it is nowhere, too.
  };
  Breakpoints breakpoints;
  Watchmen watchmen;
  std::string waiting_blocks;  ///< Typed into the console, for a G909 to apply.

  dialect::Language language() const;
  std::string_view in_language(const dialect::Text& text) const { return text.in(language()); }
  template <class Value, class... Values>
  std::string in_language(const dialect::Text& text, const Value& value, const Values&... values) const {
    return dialect::format(text, language(), value, values...);
  }

  // --- Lifecycle. All throw RequestError where the session is not in the state for it.
  void launch(LaunchWishes wishes);
  /// The client has told its breakpoints: the run may begin.
  void configuration_done();
  /// From the begin, or from a line; the file is read again. New wishes take the place of those of the launch.
  void restart(std::optional<LaunchWishes> wishes);
  /// Ends the debuggee; the client is told.
  void terminate();
  /// Nothing is told any more.
  void abandon();

  bool is_launched() const { return debuggee_ != nullptr; }
  bool is_running() const { return activity_ != Activity::None; }
  const LaunchWishes& wishes() const { return wishes_; }
  const configuration::Configuration& configuration() const { return configuration_; }

  /// The debuggee, whether or not it runs.
  const Debuggee& debuggee() const;
  /// The debuggee, which stands still.
  Debuggee& standing() const;
  const Journal& journal() const { return journal_; }
  Moment moment() const;
  const std::optional<Exception>& exception() const { return exception_; }

  // --- Running. What comes of it is told by events.
  void go_on();
  void go_back();
  void pause();
  void step(Step step);
  void step_back(Step step);
  /// To the end of the tool's section or of the frame, whichever comes first.
  void step_out();
  /// Back or on to a line, with the state that a run to it has; not stopped by anything on the way.
  void go_to_line(std::uint64_t line);

  // --- Changing.
  void set_speed(double speed);
  double speed() const { return wishes_.speed; }
  /// Throws where it is none that can be set.
  void set_quantity(const Quantity& quantity, double value);
  static bool can_set(const Quantity& quantity);
  /// Throws what is said where that is tried.
  [[noreturn]] void refuse_to_set(std::string_view name) const;
  /// Runs blocks by hand: what they did, for the console.
  std::string run_by_hand(std::string_view text);

  // --- Breakpoints.
  std::int64_t new_breakpoint_id() { return ++breakpoint_ids_; }
  /// Those in the program's lines. Tells where they lie.
  const std::vector<LineWish>& set_line_breakpoints(std::vector<LineWish> wishes);
  bool is_program(const std::filesystem::path& file) const;

  // --- Telling.
  void tell_output(std::string_view category, const std::string& text, std::optional<std::uint64_t> line = {});
  void tell_stop(std::string_view reason, Json more = Json::object());
  Json source() const;
  /// What an event says, for people.
  std::string describe(const running::Event& event) const;

 private:
  using Clock = std::chrono::steady_clock;

  enum class Activity : std::uint8_t { None, Running, RunningBack, GoingOn };
  /// A stop that is due.
  struct Stop {
    std::string_view reason;
    Json more = Json::object();
  };

  void begin(LaunchWishes wishes);
  void place_line_breakpoints();
  void tell_of_moved_breakpoints();
  void begin_run(std::uint64_t generation);
  void start(Activity activity);
  void schedule(std::chrono::milliseconds delay = {});
  void run_slice();
  void run_on(Clock::time_point deadline);
  void run_back(Clock::time_point deadline);
  void go_on_to_line(std::uint64_t line, std::string_view reason);
  void run_to_line(Clock::time_point deadline);
  std::uint64_t end_of_past() const;
  double next_moment();
  std::optional<Stop> go_on_one_block(double until);
  template <class Move>
  std::uint64_t advance(const Move& move);
  std::optional<Stop> arrive();
  std::optional<Stop> look_at_breakpoints(Debuggee& debuggee);
  std::optional<Stop> look_at_block(Debuggee& debuggee);
  void begin_trail();
  std::optional<Stop> end_block(std::uint64_t block);
  bool is_hit_on_the_way_back(const running::Block& block, std::uint64_t start, bool& is_behind);
  void stop(const Stop& stop);
  void finish(int exit_code);
  Stop failure();
  void settle(std::string_view reason);
  void lead_back(const std::function<void(Debuggee& debuggee)>& move);
  void forget_from(std::uint64_t block);
  void changed_by_hand();
  void require_no_hindrance() const;
  void tell_where_it_is();
  void tell_position(bool at_once);
  void tell_events(std::span<const running::Event> events);
  void tell_untold();
  void tell_messages(const Breakpoints::Outcome& outcome, std::uint64_t line);
  void tell_progress(double part);
  void end_progress();
  void tell_of_changed_file();
  void check_for_warnings();

  lsp::rpc::Loop& loop_;
  const Emit emit_;
  const std::optional<dialect::Language> commanded_;

  LaunchWishes wishes_;
  configuration::Configuration configuration_;
  std::shared_ptr<Debuggee> debuggee_;
  Journal journal_;
  std::vector<LineWish> line_wishes_;
  std::int64_t breakpoint_ids_ = 0;
  bool is_configured_ = false;  ///< configuration_done() has been called.
  bool has_begun_ = false;
  std::optional<std::filesystem::file_time_type> file_time_;
  bool has_told_of_file_ = false;
  Clock::time_point last_look_at_file_;

  Activity activity_ = Activity::None;
  std::uint64_t generation_ = 0;  ///< Slices of an earlier one are void.
  bool has_arrived_ = false;      ///< What stands before the next block has been looked at.
  std::optional<Exception> exception_;
  std::optional<execution::State> step_out_of_;  ///< The run stops where frame or tool become others.
  std::uint64_t target_line_ = 0;
  std::optional<simulation::Simulation> origin_;  ///< Where the way to target_line_ began.
  std::uint64_t search_begin_ = 0;                ///< Blocks, when a search began.
  std::uint64_t searched_ = 0;                    ///< From this block on there is nothing.
  std::string_view arrival_reason_ = "goto";
  Trail trail_;  ///< Of the block in progress.

  Clock::time_point pace_begin_;  ///< When the machine was at pace_time_.
  double pace_time_ = 0;
  Clock::time_point last_position_;
  Clock::time_point activity_begin_;
  Clock::time_point last_progress_;
  std::optional<std::int64_t> progress_;
  std::int64_t progresses_ = 0;
  Clock::time_point output_second_;
  std::size_t outputs_ = 0;  ///< Told in that second.
  std::size_t untold_ = 0;
  std::size_t messages_ = 0;  ///< Of log points, told in this slice.

  bool is_checking_ = false;
  bool is_checked_ = false;
  lsp::rpc::Pool pool_{1};  ///< Last: its thread ends before anything else does.
};

}  // namespace isocnc::debugger::session
