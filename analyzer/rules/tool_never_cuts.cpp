#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// A tool change to another tool while the last one has done nothing.
static void check(const Block& block, execution::Sink& sink) {
  const syntax::Word* const change = block.m(dialect::kToolChange);
  if (!change || !block.before.knows(execution::State::kUncut) || block.after.tool == block.before.tool) return;
  const std::uint8_t motion = block.motion();
  const bool cuts_here = motion != 0 && motion != dialect::kNoMotion && block.motion_word().begin < change->begin;
  if (!cuts_here) report(sink, "tool-never-cuts"_diag, change->span());
}

extern const Rule tool_never_cuts = {kToolChange, check};

}  // namespace isocnc::analyzer::rules
