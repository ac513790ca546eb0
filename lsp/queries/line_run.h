#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/execution/sink.h"
#include "lsp/documents/snapshot.h"

namespace isocnc::queries {

/// The execution of one line from the state before it.
struct LineRun {
  execution::State before;
  execution::State after;
  std::optional<execution::ProgrammedMove> move;  ///< The line's motion, in the frame in force in `moved_in`.
  execution::State moved_in;
  double dwell = 0;  ///< Seconds.
};

/// Executes a line. Returns nothing if no path leads to the line, or if paths reach it in states that are judged
/// differently.
std::optional<LineRun> run_line(const documents::Snapshot& snapshot, std::size_t line);

/// Executes a line from each state in which paths reach it. Returns an empty list if not all of these states are known.
std::vector<LineRun> run_line_on_all_paths(const documents::Snapshot& snapshot, std::size_t line);

/// Whether it is known that no path leads to a line.
bool is_never_reached(const documents::Snapshot& snapshot, std::size_t line);

}  // namespace isocnc::queries
