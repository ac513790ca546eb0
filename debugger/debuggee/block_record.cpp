#include "debugger/debuggee/block_record.h"

namespace isocnc::debuggee {

BlockRecord record_block(simulation::Simulation& simulation) {
  BlockRecord record{.block = simulation.blocks() - (simulation.is_in_block() ? 1 : 0),
                     .start = simulation.time(),
                     .frame = simulation.run().state.frame_in_force()};
  simulation.trace_stretches([&](const timing::TimedEvent& timed, const motion::Stretch* stretch) {
    record.pieces.push_back({.timed = timed, .stretch = {}});
    if (stretch != nullptr) record.pieces.back().stretch = *stretch;
  });
  const auto events = simulation.runner().events();
  record.events.assign(events.begin(), events.end());
  record.end = simulation.time();
  return record;
}

}  // namespace isocnc::debuggee
