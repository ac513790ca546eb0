#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M02 while M03 or M04 is in force.
static void check_end_with_spindle_on(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.after.spindle_turns()) report(sink, "end-with-spindle-on"_diag, end->span());
}

extern const Rule end_with_spindle_on = {kFunction, check_end_with_spindle_on};

}  // namespace isocnc::rules
