#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>

#include "interpreter/motion/planner.h"
#include "interpreter/running/event.h"

namespace isocnc::running {

/// How long the machine takes for what is no motion; seconds.
struct Durations {
  double tool_change = 8;           ///< M06, from rest to rest.
  double spindle = 2;               ///< M03, M04, M05: until the spindle has its speed, or stands.
  double channel = 0.1;             ///< G09 in G48: until the emptied interpolation channel is full again (I.3.8).
  std::map<int, double> functions;  ///< User Ms; those that are not named take no time.
};

/// motion::default_machine(), with axes that have no end: where a machine is not described, nothing is outside it.
motion::Machine unbounded_machine();

/// The machine that a program is timed on.
struct TimedMachine {
  motion::Machine motion = unbounded_machine();
  Durations durations;
  std::map<execution::ToolCode, double> tool_lengths;  ///< mm; 0 for others.
};

/// What happened, with its time in seconds from the program's begin.
struct TimedEvent {
  Event event;
  double start = 0;
  double duration = 0;
};

/// Gives the events of a run their times: the control looks ahead, so what a motion takes is known some motions later.
/// Events come out in the order in which they went in. Memory does not grow with the program.
class Timing {
 public:
  /// Who is told; any may be left out.
  struct Listeners {
    std::function<void(const TimedEvent&)> event;
    /// What the machine is asked for, before it has its time, and the line that asks.
    std::function<void(const motion::Move&, std::uint64_t line)> move;
    /// Each piece of motion, before the event that it belongs to.
    std::function<void(const motion::Stretch&)> stretch;
  };

  Timing(const TimedMachine& machine, Listeners listeners);

  void take(const Event& event);

  /// The run is over: the machine comes to rest.
  void finish();

  /// Seconds so far, that of all events told.
  double time() const { return planner_.time(); }

 private:
  /// An event that has no time yet.
  struct Waiting {
    TimedEvent timed;
    std::uint64_t motion = 0;  ///< Number of the motion that it is, or else of the next one.
    bool is_motion = false;
    bool has_begun = false;
  };

  void push_motion();
  void take_stretches();
  void take_stretch(const motion::Stretch& stretch);
  void tell_first();
  void rest(const Event& event, double seconds);
  double seconds_of(const Event& event) const;

  const TimedMachine& machine_;
  Listeners listeners_;
  motion::Planner planner_;
  std::deque<Waiting> waiting_;
  std::uint64_t motions_ = 0;
  bool holds_motion_ = false;  ///< The last of waiting_: a G09 may follow.
  bool stops_exactly_ = false;
  double tool_length_ = 0;
};

/// As to_json(event), with `start` and `duration` in seconds, and for feed moves `feed`, mm/min.
std::string to_json(const TimedEvent& timed);

/// The feed of a feed move as a speed: mm/min, or degrees/min where only B and C turn. 0 for rapids.
double feed_of(const execution::MachineMove& move);

}  // namespace isocnc::running
