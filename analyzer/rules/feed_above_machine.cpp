#include "analyzer/rules/rule.h"
#include "interpreter/execution/machine_move.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::rules {

/// An F that drives the tool tip faster than the machine's maximum, in mm/min; in G93 the length of the move counts.
static void check_feed_above_machine(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                                     execution::Sink& sink) {
  if (move.kind == execution::MoveKind::Rapid || block.line.feed < 0) return;
  const double length = execution::in_machine(move, block.after).length;
  if (length <= geometry::kEqualCoordinate) return;
  const double speed = move.inverse_time ? move.feed * length : move.feed;
  if (speed <= block.setup.limits.feed) return;
  const syntax::Word& word = block.line.words[static_cast<std::size_t>(block.line.feed)];
  sink.report({.id = "feed-above-machine"_diag, .span = word.span(), .values = {speed, block.setup.limits.feed}});
}

/// An F on its own line, for the moves that follow.
static void check_alone(const ExecutedBlock& block, execution::Sink& sink) {
  if (block.motion() || block.before.inverse_time()) return;
  const syntax::Word& word = block.line.words[static_cast<std::size_t>(block.line.feed)];
  const double speed = word.value * block.before.mm_per_unit();
  if (speed > block.setup.limits.feed)
    sink.report({.id = "feed-above-machine"_diag, .span = word.span(), .values = {speed, block.setup.limits.feed}});
}

extern const Rule feed_above_machine = {kFeed, check_alone, check_feed_above_machine};

}  // namespace isocnc::rules
