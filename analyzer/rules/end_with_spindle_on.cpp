#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// M02 while M03 or M04 is in force.
static void check(const Block& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.spindle_turns()) report(sink, "end-with-spindle-on"_diag, end->span());
}

extern const Rule end_with_spindle_on = {kFunction, check};

}  // namespace isocnc::analyzer::rules
