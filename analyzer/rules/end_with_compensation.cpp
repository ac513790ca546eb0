#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M02 without G40 before it.
static void check_end_with_compensation(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.after.is_compensated() && !block.after.is_in_doubt(dialect::ModalGroup::CutterCompensation))
    report(sink, "end-with-compensation"_diag, end->span(), block.after.mode(dialect::ModalGroup::CutterCompensation));
}

extern const Rule end_with_compensation = {kFunction, check_end_with_compensation};

}  // namespace isocnc::rules
