#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/execution/sink.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::lsp::documents {

/// What one line does, from the state in which the program comes to it.
struct LineRun {
  execution::State before;
  execution::State after;
  std::optional<execution::Move> move;  ///< The line's motion, in the frame in force in `moved_in`.
  execution::State moved_in;
  double dwell = 0;  ///< Seconds.
};

/// Nothing where no path leads to the line, or where paths come to it in different states.
std::optional<LineRun> run_line(const Snapshot& snapshot, std::size_t line);

/// From each of the states in which paths come to the line; nothing where not all of them are known.
std::vector<LineRun> run_line_on_all_paths(const Snapshot& snapshot, std::size_t line);

}  // namespace isocnc::lsp::documents
