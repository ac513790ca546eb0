#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// The last F was given in G93, and no feed move in G94 has followed.
static constexpr Facts kMeansTime = 1;

static constexpr RuleMemory kFeedMode = {.facts = {Fact{.started_by = at(BlockStep::InverseTimeFeed),
                                                        .ended_by = at(BlockStep::Feed, BlockStep::FeedMove)}}};

/// The first feed move back in G94, if the last F was given in G93 and so meant a time (D43).
static void check_feed_of_inverse_time(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.has_feed_move() || block.line.feed >= 0 || block.after.inverse_time()) return;
  if (!block.holds(kMeansTime)) return;
  const execution::ProgrammedFeed feed = execution::feed_in_force(block.before);
  report(sink, "feed-of-inverse-time"_diag, block.motion_word().span(), feed.number * feed.mm_per_unit);
}

extern const Rule feed_of_inverse_time = {
    .concerns = kMotion, .check = check_feed_of_inverse_time, .memory = &kFeedMode};

}  // namespace isocnc::rules
