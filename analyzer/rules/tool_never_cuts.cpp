#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// No feed move and no user M since the tool change.
static constexpr Facts kUncut = 1;

static constexpr RuleMemory kToolUse = {
    .facts = {Fact{.started_by = at(BlockStep::ToolMounted),
                   .ended_by = at(BlockStep::FeedMove, BlockStep::InverseTimeFeedMove, BlockStep::UserFunction,
                                  BlockStep::ToolLost, kMayBeMotion, kMayBeFunction)}}};

/// A tool change to another tool although the last one has not been used.
static void check_tool_never_cuts(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const change = block.m(dialect::kToolChange);
  if (!change || !block.holds(kUncut) || block.after.tool == block.before.tool) return;
  const bool cuts_here = block.has_feed_move() && block.motion_word().begin < change->begin;
  if (!cuts_here) report(sink, "tool-never-cuts"_diag, change->span());
}

extern const Rule tool_never_cuts = {.concerns = kToolChange, .check = check_tool_never_cuts, .memory = &kToolUse};

}  // namespace isocnc::rules
