#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/restart/restart_survey.h"
#include "interpreter/timing/timing.h"

namespace isocnc::restart {

/// Options of a restart program. Lengths in mm, feeds in mm/min.
struct RestartOptions {
  running::RunOptions run;
  timing::TimedMachine machine;  ///< The approach keeps to its travel; its tools give the position of the tip.
  std::size_t line = 0;          ///< From 0.
  /// The line before which the restart program ends, by an M02; from 0. Without it, it ends like the original.
  std::optional<std::size_t> end;
  /// Z of the frame in force at which the tool changes from rapid to feed on its way down. Without it: the machine's
  /// value (Setup::clearance) or the maximum Z at which the program itself has started or ended a feed move in that
  /// frame, whichever is higher. In any case at least 5 mm above the restart position if the tool has reached that in
  /// feed.
  std::optional<double> clearance;
  double approach_feed = 1000;                              ///< Maximum feed of the tool's way down from there.
  std::string name;                                         ///< Name of the program, for the comment at the head.
  dialect::Language language = dialect::Language::English;  ///< Language of the comments, which are ASCII in both.
};

/// Returns the lines that bring a machine from the start of a program (D32) into the state of `point`, each ended by
/// `line_end`. The first lines move nothing: modes, registers, workpiece frame, tool, spindle. Then comes the approach:
/// straight up to the highest point that the program has reached and the machine can reach, B and C, X and Y, down to
/// the clearance in rapid, and down to the depth in feed. A face frame is approached from above the highest point of
/// the program in that frame, and then along its Z. A tool that B tilts without a face frame goes down beside the work,
/// and then along its own axis. There is no approach for a program that has not moved yet. The last lines restore F,
/// the motion G, G91 and G93.
std::string restart_preamble(const RestartPoint& point, const RestartOptions& options, std::string_view line_end);

}  // namespace isocnc::restart
