#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interpreter/motion/planner.h"
#include "interpreter/running/event.h"
#include "interpreter/simulation/fifo.h"
#include "interpreter/simulation/tip_position.h"

namespace isocnc::simulation {

/// Durations of events that are not motions; seconds.
struct Durations {
  double tool_change = 8;  ///< M06, from rest to rest.
  double spindle = 2;      ///< M03, M04, M05 with an effect: until the spindle has reached its speed or stands.
  double channel = 0.1;    ///< G09 in G48: until the emptied interpolation channel is full again (I.3.8).
  std::map<int, double> functions;  ///< User M functions; others take no time.
};

/// motion::default_machine() with unlimited axes, so that without a machine file every position is inside the travel.
kinematics::Machine unbounded_machine();

/// The machine that a program is timed on.
struct TimedMachine {
  kinematics::Machine motion = unbounded_machine();
  Durations durations;
  std::map<execution::ToolCode, double> tool_lengths;  ///< mm; 0 for others.
  std::map<execution::ToolCode, double> tool_radii;    ///< mm; 0 for others: G41 and G42 then move nothing.
  double feed_override = 1;                            ///< Factor on programmed feeds.
  /// Position of the spindle nose at the program start, in the machine frame; equals the tip without a tool.
  geometry::Pose home;
  double spindle_speed = std::numeric_limits<double>::infinity();  ///< Maximum S, rev/min.

  ToolLength length_of(const execution::ToolCode& tool) const;
  double tool_length(const execution::ToolCode& tool) const { return length_of(tool).mm; }  ///< mm.
  /// The highest Z of the machine frame to which Z lifts the tip of a tool while B and C stand at these angles; mm,
  /// rounded down to 0.001.
  double highest_tip(const execution::ToolCode& tool, double b, double c) const;
};

/// An event with its time in seconds since the program start.
struct TimedEvent {
  running::Event event;
  double start = 0;
  double duration = 0;
  /// For a motion with a G09 in G48: time after it until the interpolation channel is full again (I.3.8).
  double wait = 0;
  /// For a motion: the motion requested from the machine. It starts at the machine's position, which after a tool
  /// change differs from the programmed one (docs/motion.md).
  std::optional<kinematics::Move> move;
  /// For a motion and a tool change: whether it is known where the machine is before and after it (TipPosition).
  bool begins_at_known_place = true;
  bool ends_at_known_place = true;
  std::shared_ptr<const UnknownOffset> unknown_offset;  ///< Of the tip after it; null where it is 0.

  bool is_at_known_place() const { return begins_at_known_place && ends_at_known_place; }
};

/// Computes the times of the events of a run. The control looks ahead, so the duration of a motion is known some
/// motions later. Events are reported in the order in which they were taken. Memory does not grow with the program:
/// after more waiting events than any control looks ahead the machine is assumed to stop.
class Timing {
 public:
  /// State of the spindle. An S takes effect with the next M03 or M04 (I.4.2).
  struct SpindleMotion {
    int function = 5;  ///< 3, 4 or 5.
    double speed = 0;  ///< Revolutions per minute; 0 while it stands, and before any S.

    friend bool operator==(const SpindleMotion&, const SpindleMotion&) = default;
  };

  /// State of a machine at rest after a program (part) has run.
  struct Standing {
    double time = 0;
    geometry::Pose tip;         ///< Machine frame.
    geometry::Pose programmed;  ///< Programmed position, machine frame; differs from `tip` after a tool change.
    ToolLength tool;
    UnknownOffset unknown;
    geometry::Mat3 frame_axes = geometry::Mat3::Identity();  ///< Axes of the frame in force, machine frame.
    SpindleMotion spindle;
    double spindle_speed = 0;  ///< The last S; 0 before any.
  };

  /// Callbacks; each is optional.
  struct Listeners {
    std::function<void(const TimedEvent&)> event;
    /// Called for each piece of motion, with its event. Called before `event`, so the event's duration is not known
    /// yet.
    std::function<void(const motion::Stretch&, const TimedEvent&)> stretch;
  };

  Timing(const TimedMachine& machine, Listeners listeners);
  /// Continues from `standing` instead of the program start.
  Timing(const TimedMachine& machine, const Standing& standing);

  /// Replaces the callbacks. A Timing is a value: a copy runs independently but calls the same callbacks.
  void listen(Listeners listeners) { listeners_ = std::move(listeners); }

  void take(const running::Event& event);

  /// Ends the run: the machine comes to rest.
  void finish();

  /// Frees the memory of events already reported. Call it before copying, so that the copy is small.
  void release_reported() {
    waiting_.forget_popped();
    planner_.forget_handed_out();
  }

  /// Heap memory in bytes, without the object itself.
  std::size_t memory() const { return waiting_.size() * sizeof(WaitingEvent) + planner_.memory(); }

  /// Total time in seconds of all events reported.
  double time() const { return planner_.time(); }

  /// Position of the resting machine, tip (machine frame) and joints: at the start, in the callback of a tool change,
  /// and at the end.
  geometry::Pose tip() const { return position_.tip(); }
  kinematics::Coordinates joints() const { return position_.joints(machine_->motion.kinematics); }

 private:
  /// An event without a known time.
  struct WaitingEvent {
    TimedEvent timed;
    std::uint64_t motion = 0;  ///< Number of this motion or, for other events, of the next motion.
    bool is_motion = false;
    bool has_begun = false;
  };

  bool is_place_known() const { return position_.is_place_known(machine_->motion.kinematics); }
  std::shared_ptr<const UnknownOffset> unknown_offset() const;
  WaitingEvent& enqueue(const running::Event& event);
  void push_motion();
  void take_stretches();
  void take_stretch(const motion::Stretch& stretch);
  void report_first();
  void come_to_rest();
  void rest(const running::Event& event, double seconds);
  double seconds_of(const running::Event& event) const;
  SpindleMotion spindle_after(int function) const;
  void turn_spindle(const running::Event& event);

  const TimedMachine* machine_;  ///< Must outlive this object.
  Listeners listeners_;
  motion::Planner planner_;
  Fifo<WaitingEvent> waiting_;
  std::uint64_t motions_ = 0;
  bool holds_motion_ = false;  ///< The last of waiting_ is a motion that a G09 may follow.
  bool stops_exactly_ = false;
  TipPosition position_;
  SpindleMotion spindle_;
  double spindle_speed_ = 0;  ///< The last S; 0 before any.
};

/// The motion requested from a machine that stands where the program has it.
kinematics::Move planned_move(const running::MoveEvent& move, const TimedMachine& machine, double tool_length);

/// Length of the tip's path in a motion, as the machine makes it; mm. 0 for other events.
double tip_length(const TimedEvent& timed, const TimedMachine& machine);

/// Like to_json(event), with the further keys `start` and `duration` in seconds, `feed` in mm/min for feed moves, and
/// tip_length() as `lengthMm` for all moves.
std::string to_json(const TimedEvent& timed, const TimedMachine& machine);

}  // namespace isocnc::simulation
