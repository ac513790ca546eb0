#pragma once

#include <memory>
#include <optional>
#include <string>

#include "interpreter/kinematics/move.h"
#include "interpreter/running/event.h"
#include "interpreter/timing/timed_machine.h"

namespace isocnc::timing {

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

/// Length of the tip's path in a motion, as the machine makes it; mm. 0 for other events.
double tip_length(const TimedEvent& timed, const TimedMachine& machine);

/// Like to_json(event), with the further keys `start` and `duration` in seconds, `feed` in mm/min for feed moves, and
/// tip_length() as `lengthMm` for all moves.
std::string to_json(const TimedEvent& timed, const TimedMachine& machine);

}  // namespace isocnc::timing
