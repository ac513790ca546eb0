#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/verification/surroundings.h"
#include "lsp/queries/line_run.h"

namespace isocnc::queries {

/// What is nearest to a motion in the setup of its program.
struct NearestObstacle {
  verification::Neighbor neighbor;  ///< Its clearance, or the depth of a contact, is what counts.
  bool is_without_tool = false;     ///< The shape of the tool is not known: only what carries it was compared.
};

/// The obstacle that the motion of a line hits deepest, or comes nearest to, on the path on which it does most. `runs`
/// are the runs of the line on all paths, each with a motion. Nothing without a setup, where nothing is within half a
/// meter, or where it is not known where the tool goes. Reads the files of a setup once.
std::optional<NearestObstacle> nearest_obstacle(const documents::Snapshot& snapshot, std::size_t line,
                                                const std::vector<LineRun>& runs);

}  // namespace isocnc::queries
