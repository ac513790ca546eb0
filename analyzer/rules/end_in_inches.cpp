#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M02 with G70 in force.
static void check_end_in_inches(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.after.in_inches() && !block.after.is_in_doubt(dialect::ModalGroup::Units))
    report(sink, "end-in-inches"_diag, end->span());
}

extern const Rule end_in_inches = {kFunction, check_end_in_inches};

}  // namespace isocnc::rules
