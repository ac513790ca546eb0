#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analyzer/selection/selection.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/runner.h"
#include "interpreter/timing/timing.h"
#include "interpreter/verification/scene.h"

/// Tries programs that are made of others, such as a restart, before they are written.
namespace isocnc::formats {

/// The machine on which a program is tried, and what of it is shown.
struct TrialMachine {
  const timing::TimedMachine& timed;
  const verification::Scene* scene;  ///< What stands around it; null for nothing.
  const selection::Selection& selection;
  dialect::Language language;
};

/// An error on the way of a program: what stops it, or what it hits.
struct WayError {
  dialect::DiagnosticId id;
  std::string block;    ///< The text of its line.
  std::string message;  ///< For an operator.
};

/// What stops a program, or is hit on its way. `cuts` says whether the stock counts.
std::vector<WayError> errors_on_the_way(std::string_view program, const running::RunOptions& options,
                                        const TrialMachine& machine, bool cuts);

/// What a program that holds parts of another one would hit though the other one does not: on the way there. The stock
/// does not count, since what has been cut before is not known. Empty for nothing.
std::string obstacle_on_the_way_there(std::string_view program, std::string_view original,
                                      const running::RunOptions& options, const TrialMachine& machine);

/// Why there is no restart before a line, counted from 0, which `obstacle` stands in the way of.
std::string restart_hits(std::size_t line, std::string_view obstacle, dialect::Language language);

}  // namespace isocnc::formats
