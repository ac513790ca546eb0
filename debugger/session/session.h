#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "debugger/breakpoints/source_breakpoint.h"
#include "debugger/dap/request_error.h"
#include "debugger/expressions/locations.h"
#include "debugger/session/notifier.h"
#include "debugger/session/run_loop.h"
#include "debugger/session/session_state.h"

namespace isocnc::session {

/// The program that is debugged, as requests see it: what they may ask about it and what they may do with it. It lives
/// on the loop's thread. What comes of a run is reported by events. Everything throws RequestError where the program is
/// not in a state for it.
class Session : public expressions::Controls {
 public:
  Session(rpc::Loop& loop, Notifier::Emit emit, std::optional<dialect::Language> language);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  dap::ClientProfile& client() { return state_.client; }
  const dap::ClientProfile& client() const { return state_.client; }
  dialect::Language language() const { return state_.language(); }
  std::string_view in_language(const dialect::Text& text) const override { return state_.in_language(text); }
  template <class Value, class... Values>
  std::string in_language(const dialect::Text& text, const Value& value, const Values&... values) const {
    return state_.in_language(text, value, values...);
  }

  // --- Lifecycle.
  void launch(LaunchOptions options);
  /// The client has set its breakpoints: the run may begin.
  void configuration_done();
  /// From the start, or from a line; the file is read again. New options take the place of those of the launch.
  void restart(std::optional<LaunchOptions> options);
  /// Ends the debuggee, and reports it.
  void terminate();
  /// No event is sent any more.
  void abandon() { run_loop_.abandon(); }

  // --- Asking.
  bool is_launched() const { return state_.is_launched(); }
  bool is_running() const { return run_loop_.is_running(); }
  const LaunchOptions& launch_options() const { return state_.launch_options; }
  const configuration::Configuration& configuration() const { return state_.configuration; }
  /// The debuggee, whether or not it runs.
  const debuggee::Debuggee& debuggee() const;
  /// The debuggee, which stands.
  debuggee::Debuggee& stopped_debuggee() const override;
  /// Of the debuggee.
  const debuggee::Surroundings& surroundings() const { return *state_.surroundings; }
  const debuggee::Journal& journal() const { return state_.journal; }
  expressions::Moment moment() const;
  /// See expressions::location_of().
  std::int64_t location_of(const expressions::Quantity& quantity) const {
    return expressions::location_of(quantity, journal(), debuggee().present());
  }
  /// Reason of the present stop, where it is an exception.
  const std::optional<breakpoints::Exception>& exception() const { return state_.exception; }
  bool is_program(const std::filesystem::path& file) const { return state_.is_program(file); }
  /// The program, as a `Source` of the protocol.
  Json source() const { return state_.source(); }

  // --- Running. A pause takes no debuggee that stands; all others do.
  void resume();
  void reverse();
  void pause();
  void step(dap::Step step);
  void step_back(dap::Step step);
  /// To the end of the tool's section or of the frame, whichever comes first.
  void step_out();
  /// Forward or backward to a line, with the state that a run to it has. Nothing stops the run before.
  void go_to_line(std::size_t line);
  /// Forward or backward to the first difference from a file, whose name may be relative to the folder of the program.
  /// Nothing stops the run before.
  void run_to_difference(const std::filesystem::path& file);
  /// The same with a program that is no file; the name is for people.
  void run_to_difference(std::string name, std::string text);

  // --- Changing.
  void set_quantity(const expressions::Quantity& quantity, double value);
  void change_variables(const std::function<void(debuggee::Debuggee& debuggee)>& change) override;
  void change_machine(const std::function<void(debuggee::Debuggee& debuggee)>& change) override;
  void set_playback(double speed) override;
  /// Throws the refusal to set something of this name.
  [[noreturn]] void refuse_to_set(std::string_view name) const;
  /// Runs blocks by hand. Returns what they did, for the console.
  std::string run_by_hand(std::string_view text);
  /// Blocks typed into the console, which a G909 is to apply.
  std::string& waiting_blocks() { return waiting_blocks_; }

  // --- Breakpoints.
  std::int64_t new_breakpoint_id() { return ++breakpoint_ids_; }
  /// Takes the place of all breakpoints in lines. Returns them with the lines where they lie.
  const std::vector<breakpoints::SourceBreakpoint>& set_source_breakpoints(
      std::vector<breakpoints::SourceBreakpoint> breakpoints);
  breakpoints::Breakpoints& breakpoints() { return state_.breakpoints; }
  breakpoints::ExceptionFilters& exception_filters() { return state_.exception_filters; }

 private:
  void begin(LaunchOptions options);
  std::shared_ptr<const verification::Scene> load_scene();
  void place_source_breakpoints();
  void report_moved_breakpoints();
  void require_launch() const;
  void require_change_by_hand() const;
  void finish_change();

  SessionState state_;
  Notifier notifier_;
  RunLoop run_loop_;
  std::vector<breakpoints::SourceBreakpoint> source_breakpoints_;
  std::int64_t breakpoint_ids_ = 0;
  bool is_configured_ = false;  ///< configuration_done() has been called.
  std::string waiting_blocks_;
};

}  // namespace isocnc::session
