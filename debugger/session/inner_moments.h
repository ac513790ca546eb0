#pragma once

#include <optional>
#include <vector>

#include "debugger/session/session_state.h"

namespace isocnc::session {

/// A moment within a block at which a run may stop.
struct InnerMoment {
  double time = 0;  ///< Seconds since the start.
  verification::Contact contact;
};

/// Whether a run may stop within a block.
bool watches_blocks(const SessionState& state);

/// Takes a simulation of the debuggee to the end of the block in progress or, between two blocks, of the next one.
/// Returns the moments on the way at which a run may stop, by time.
std::vector<InnerMoment> pass_block(const SessionState& state, simulation::Simulation& simulation);

/// Why a run stops at a moment that `there` has reached; none where it does not.
std::optional<breakpoints::Exception> judge_moment(const InnerMoment& moment, const SessionState& state,
                                                   const simulation::Simulation& there);

}  // namespace isocnc::session
