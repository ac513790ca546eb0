#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "debugger/session/session_state.h"

namespace isocnc::session {

/// A moment within a block at which a run may stop: a contact, or a limit of a data breakpoint.
struct InnerMoment {
  double time = 0;  ///< Seconds since the start.
  std::optional<verification::Contact> contact;
  std::size_t limit = 0;  ///< Without a contact: index among the limits of the data breakpoints.
};

/// What comes of a moment.
struct MomentVerdict {
  std::optional<breakpoints::Exception> exception;
  breakpoints::Breakpoints::BreakpointOutcome outcome;

  bool stops() const { return exception || !outcome.stopped.empty(); }
};

/// Whether a run may stop within a block.
bool watches_blocks(const SessionState& state);

/// Takes a simulation of the debuggee to the end of the block in progress or, between two blocks, of the next one.
/// Returns the moments on the way at which a run may stop, by time.
std::vector<InnerMoment> pass_block(const SessionState& state, simulation::Simulation& simulation);

/// Judges a moment in a block that `there` has reached.
MomentVerdict judge_moment(const InnerMoment& moment, SessionState& state, const simulation::Simulation& there,
                           std::uint64_t block, breakpoints::RunDirection direction);

}  // namespace isocnc::session
