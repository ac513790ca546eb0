#pragma once

#include "analyzer/rules/memory.h"

namespace isocnc::rules {

// How the program uses the spindle: a memory that two rules share, since an S decides which of them may report.

/// M05 has stopped a turning spindle, and no feed move has followed.
inline constexpr Facts kStopped = 1;
/// No M03, M04 or user M has started the spindle. Ended by a feed move, unless an S comes after it.
inline constexpr Facts kNotStarted = 2;
/// Feed moves have found the spindle never started, and no S given.
inline constexpr Facts kCutNotStarted = 4;

/// Without an S the program may need no spindle: the first feed move then settles that it does not. An S after it
/// shows that it does, so the next feed move is judged again.
constexpr Facts follow_spindle_use(BlockStep step, const execution::State& before, Facts held, Facts next) {
  const bool feeds = step == BlockStep::FeedMove || step == BlockStep::InverseTimeFeedMove;
  if (step == BlockStep::SpindleSpeed && (held & kCutNotStarted) != 0) return next | kNotStarted;
  if (!feeds || (held & kNotStarted) == 0) return next;
  return before.speed_given ? next & ~kCutNotStarted : next | kCutNotStarted;
}

inline constexpr Steps kMayStartSpindle =
    at(BlockStep::SpindleStart, BlockStep::UserFunction, kMayBeMotion, kMayBeFunction);

inline constexpr RuleMemory kSpindleUse = {
    .facts = {Fact{.started_by = at(BlockStep::SpindleStop),
                   .ended_by = at(BlockStep::SpindleStart, BlockStep::RepeatedStop, BlockStep::FeedMove,
                                  BlockStep::InverseTimeFeedMove, kMayBeMotion, kMayBeFunction)},
              Fact{.ended_by = at(BlockStep::FeedMove, BlockStep::InverseTimeFeedMove) | kMayStartSpindle,
                   .holds_at_start = true},
              Fact{.ended_by = kMayStartSpindle}},
    .follow = follow_spindle_use};

}  // namespace isocnc::rules
