#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// A tool change to another tool although the last one has not been used.
static void check_tool_never_cuts(const Block& block, execution::Sink& sink) {
  const syntax::Word* const change = block.m(dialect::kToolChange);
  if (!change || !block.before.knows(execution::State::kUncut) || block.after.tool == block.before.tool) return;
  const bool cuts_here = block.has_feed_move() && block.motion_word().begin < change->begin;
  if (!cuts_here) report(sink, "tool-never-cuts"_diag, change->span());
}

extern const Rule tool_never_cuts = {kToolChange, check_tool_never_cuts};

}  // namespace isocnc::rules
