#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/execution/machine_move.h"

namespace isocnc::running {

// The effects. `kKind` is the kind in traces; where there are several, event.cpp decides. An event
// with `kStopsReading` makes the control execute all before it reads on (I.3.11, I.5), so no move is planned across it.

using MoveEvent = execution::MachineMove;
struct DwellEvent {
  static constexpr std::string_view kKind = "dwell";

  double seconds = 0;
};
struct SpindleSpeedEvent {
  static constexpr std::string_view kKind = "spindle";

  double speed = 0;  ///< Revolutions per minute.
};
struct FunctionEvent {
  int number = 0;
  std::vector<execution::FunctionParameter> parameters;
};
struct ToolEvent {
  static constexpr std::string_view kKind = "tool";

  execution::ToolCode tool;
};
/// A frame came into force or was removed.
struct FrameEvent {
  static constexpr std::string_view kKind = "frame";

  geometry::Vec3 workpiece_origin = geometry::Vec3::Zero();  ///< Machine frame, mm.
  bool face_mounted = false;
  geometry::Frame face;      ///< In the workpiece frame.
  geometry::Frame in_force;  ///< In the machine frame.
};
struct JumpEvent {
  static constexpr std::string_view kKind = "jump";
  static constexpr bool kStopsReading = true;

  bool taken = false;
  std::size_t target_line = 0;  ///< Line at which the program continues, from 0.
};
/// A G whose effect has no data, such as G990, at which the run waits until the control has reread its technological
/// parameters (I.3.11). The G's row holds the kind, and whether it stops reading.
struct SignalEvent {
  const dialect::GCode* code = nullptr;
};
/// A G09: the axes stop at the end of the last motion (I.3.8). Not in traces.
struct ExactStopEvent {
  static constexpr std::string_view kKind = "stop";
};
struct EndEvent {
  static constexpr std::string_view kKind = "end";
};

/// One effect of a program, with its line (from 0).
struct Event {
  std::size_t line = 0;
  std::variant<MoveEvent, DwellEvent, SpindleSpeedEvent, FunctionEvent, ToolEvent, FrameEvent, JumpEvent, SignalEvent,
               ExactStopEvent, EndEvent>
      what;
  bool is_in_inches = false;  ///< G70 is in force at its block: what is said to people about it is in inches.
};

/// Name of the event's kind in traces: `rapid`, `feed`, `arc`, `dwell`, `spindle`, `tool`, `m`, `frame`, `jump`,
/// `end`, or that of a signal.
std::string_view kind_of(const Event& event);

/// Whether the control executes all before the event before it reads on: at an IF and at a G990.
bool stops_reading(const Event& event);

/// The feed of a feed move as a speed: mm/min, or degrees/min where only B and C turn. 0 for rapids.
double feed_of(const MoveEvent& move);

/// The tool as programs write it: `T101001`.
std::string tool_name(const execution::ToolCode& tool);

/// The event as one line of JSON without the line end; keys as in docs/isorun.md, lines from 1.
std::string to_json(const Event& event);

/// The event as JSON with further keys and numbers.
std::string to_json(const Event& event, std::span<const std::pair<std::string_view, double>> more);

}  // namespace isocnc::running
