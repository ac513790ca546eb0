#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "interpreter/motion/planner.h"
#include "interpreter/running/event.h"
#include "interpreter/simulation/fifo.h"
#include "interpreter/simulation/tip_position.h"

namespace isocnc::simulation {

/// How long the machine takes for what is no motion; seconds.
struct Durations {
  double tool_change = 8;  ///< M06, from rest to rest.
  double spindle = 2;      ///< M03, M04, M05 that change something: until the spindle has its speed, or stands.
  double channel = 0.1;    ///< G09 in G48: until the emptied interpolation channel is full again (I.3.8).
  std::map<int, double> functions;  ///< User Ms; those that are not named take no time.
};

/// motion::default_machine(), with axes that have no end: where a machine is not described, nothing is outside it.
motion::Machine unbounded_machine();

/// The machine that a program is timed on.
struct TimedMachine {
  motion::Machine motion = unbounded_machine();
  Durations durations;
  std::map<execution::ToolCode, double> tool_lengths;  ///< mm; 0 for others.
  std::map<execution::ToolCode, double> tool_radii;    ///< mm; 0 for others: G41 and G42 then move nothing.
  double feed_override = 1;                            ///< Feeds are so many times as fast as they are written.
  /// Where the spindle nose is when a program begins, in the machine frame: the tip of no tool.
  geometry::Pose home;
  double spindle_speed = std::numeric_limits<double>::infinity();  ///< The greatest S, rev/min.

  double tool_length(const execution::ToolCode& tool) const;  ///< mm.
};

/// What happened, with its time in seconds from the program's begin.
struct TimedEvent {
  running::Event event;
  double start = 0;
  double duration = 0;
  /// Of a motion with a G09 in G48: how long the channel takes behind it until it is full again (I.3.8).
  double wait = 0;
  /// Of a motion: what the machine is asked for. It begins where the machine stands, which after a tool change is not
  /// where the program is (docs/motion.md).
  std::optional<motion::Move> move;
};

/// Gives the events of a run their times: the control looks ahead, so what a motion takes is known some motions later.
/// Events come out in the order in which they went in. Memory does not grow with the program: behind more events than
/// any control looks ahead the machine is taken to stop.
class Timing {
 public:
  /// What the spindle does. It takes up an S with the next M03 or M04 (I.4.2).
  struct Spindle {
    int function = 5;  ///< 3, 4 or 5.
    double speed = 0;  ///< Revolutions per minute; 0 while it stands, and before any S.

    friend bool operator==(const Spindle&, const Spindle&) = default;
  };

  /// A machine that stands, with a program behind it.
  struct Standing {
    double time = 0;
    geometry::Pose tip;         ///< Machine frame.
    geometry::Pose programmed;  ///< Where the program has led it, machine frame: elsewhere after a tool change.
    double tool_length = 0;
    geometry::Mat3 frame_axes = geometry::Mat3::Identity();  ///< Of the frame in force, machine frame.
    Spindle spindle;
    double spindle_speed = 0;  ///< The last S; 0 before any.
  };

  /// Who is told; any may be left out.
  struct Listeners {
    std::function<void(const TimedEvent&)> event;
    /// Each piece of motion, and the event that it belongs to, whose duration is not known yet; before that is told.
    std::function<void(const motion::Stretch&, const TimedEvent&)> stretch;
  };

  Timing(const TimedMachine& machine, Listeners listeners);
  /// From there on, and not from the begin.
  Timing(const TimedMachine& machine, const Standing& standing);

  /// Who is told from now on. A timing is a value: a copy goes on by itself, and tells the same listeners.
  void listen(Listeners listeners) { listeners_ = std::move(listeners); }

  void take(const running::Event& event);

  /// The run is over: the machine comes to rest.
  void finish();

  /// Lets go of what has been told: a copy is then as small as it can be.
  void release_reported() {
    waiting_.forget_popped();
    planner_.forget_handed_out();
  }

  /// Bytes that it holds, beside itself.
  std::size_t memory() const { return waiting_.size() * sizeof(Waiting) + planner_.memory(); }

  /// Seconds so far, that of all events told.
  double time() const { return planner_.time(); }

  /// Where the machine stands, tip (machine frame) and joints: at the begin, while a tool change is told, at the end.
  geometry::Pose tip() const { return position_.tip(); }
  motion::Coordinates joints() const { return position_.joints(machine_->motion.kinematics); }

 private:
  /// An event that has no time yet.
  struct Waiting {
    TimedEvent timed;
    std::uint64_t motion = 0;  ///< Number of the motion that it is, or else of the next one.
    bool is_motion = false;
    bool has_begun = false;
  };

  Waiting& enqueue(const running::Event& event);
  void push_motion();
  void take_stretches();
  void take_stretch(const motion::Stretch& stretch);
  void report_first();
  void come_to_rest();
  void rest(const running::Event& event, double seconds);
  double seconds_of(const running::Event& event) const;
  Spindle spindle_after(int function) const;
  void turn_spindle(const running::Event& event);

  const TimedMachine* machine_;  ///< Outlives it.
  Listeners listeners_;
  motion::Planner planner_;
  Fifo<Waiting> waiting_;
  std::uint64_t motions_ = 0;
  bool holds_motion_ = false;  ///< The last of waiting_: a G09 may follow.
  bool stops_exactly_ = false;
  TipPosition position_;
  Spindle spindle_;
  double spindle_speed_ = 0;  ///< The last S; 0 before any.
};

/// What a motion asks of the machine, where that is where the program has it.
motion::Move planned_move(const running::MoveEvent& move, const TimedMachine& machine, double tool_length);

/// How far the tip goes in a motion, on the path that the machine takes; mm. 0 for what is no motion.
double tip_length(const TimedEvent& timed, const TimedMachine& machine);

/// As to_json(event), with `start` and `duration` in seconds, for feed moves `feed`, mm/min, and for all moves
/// tip_length() as `lengthMm`.
std::string to_json(const TimedEvent& timed, const TimedMachine& machine);

}  // namespace isocnc::simulation
