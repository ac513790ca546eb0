#pragma once

#include <limits>
#include <map>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/running/event.h"
#include "interpreter/timing/tip_position.h"

namespace isocnc::timing {

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

/// The motion requested from a machine that stands where the program has it.
kinematics::Move planned_move(const running::MoveEvent& move, const TimedMachine& machine, double tool_length);

}  // namespace isocnc::timing
