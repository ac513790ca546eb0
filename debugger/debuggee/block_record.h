#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/simulation/simulation.h"

namespace isocnc::debuggee {

/// A stretch of motion, or something else that takes time, or a tool change.
struct RecordedPiece {
  timing::TimedEvent timed;  ///< The duration of a motion is not known.
  std::optional<motion::Stretch> stretch;

  double start() const { return stretch ? stretch->start : timed.start; }
  double end() const { return stretch ? stretch->start + stretch->duration : timed.start + timed.duration; }
};

/// What the machine does in a block.
struct BlockRecord {
  std::uint64_t block = 0;  ///< Blocks executed before it.
  double start = 0;         ///< Seconds since the start of the run.
  double end = 0;
  geometry::Frame frame;              ///< In force before it; in the machine frame.
  std::vector<RecordedPiece> pieces;  ///< Those that had not been completed when the record began.
  std::vector<running::Event> events;
};

/// Takes a simulation to the end of the block in progress or, between two blocks, of the next one.
BlockRecord record_block(simulation::Simulation& simulation);

}  // namespace isocnc::debuggee
