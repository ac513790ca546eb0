#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/restart/restart_survey.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::restart {

/// How a restart program comes to its point. Lengths in mm, feeds in mm/min.
struct RestartOptions {
  running::RunOptions run;
  simulation::TimedMachine machine;  ///< Whose travel the approach keeps to, and whose tools say where the tip is.
  std::uint64_t line = 0;            ///< From 0.
  /// Z of the frame in force from which the tool goes down in feed. Else the machine's (Setup::clearance), or the
  /// highest Z at which the program itself has begun or ended a feed move in that frame, whichever is higher. In any
  /// case 5 mm above the place where the tool has come there in feed.
  std::optional<double> clearance;
  double approach_feed = 1000;                              ///< The most at which the tool goes down from there.
  std::string name;                                         ///< Of the program, for the comment at the head.
  dialect::Language language = dialect::Language::English;  ///< Of the comments, which are ASCII in either.
};

/// The lines that bring a machine from the start of a program (D32) into the state of `point`, each ended by
/// `line_end`. First what moves nothing: modes, registers, workpiece frame, tool, spindle. Then the approach: straight
/// up to the highest point that the program has come to and the machine reaches, B and C, across, down to the clearance
/// in rapid, and down to the depth in feed. A face frame is approached from above the point at which the program has
/// stood highest in it, and then along its Z; a tool that B tilts without a face frame goes down beside the work, and
/// then along itself. A program that has not moved yet is not approached. Last F, the motion G, G91 and G93.
std::string restart_preamble(const RestartPoint& point, const RestartOptions& options, std::string_view line_end);

}  // namespace isocnc::restart
