#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M04 while M03 is in force, or the other way round.
static void check_spindle_reversed(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.spindle_turns()) return;
  const syntax::Word* const against = block.m(block.before.spindle == execution::Spindle::Clockwise ? 4 : 3);
  if (against && !block.m(5)) report(sink, "spindle-reversed"_diag, against->span());
}

extern const Rule spindle_reversed = {kFunction, check_spindle_reversed};

}  // namespace isocnc::rules
