#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// M02 without G40 before it.
static void check(const Block& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.compensated())
    report(sink, "end-with-compensation"_diag, end->span(), block.before.mode(dialect::ModalGroup::CutterCompensation));
}

extern const Rule end_with_compensation = {kFunction, check};

}  // namespace isocnc::analyzer::rules
