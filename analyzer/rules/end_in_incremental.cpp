#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M02 with G91 in force.
static void check_end_in_incremental(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.after.incremental() && !block.after.is_in_doubt(dialect::ModalGroup::Distance))
    report(sink, "end-in-incremental"_diag, end->span());
}

extern const Rule end_in_incremental = {kFunction, check_end_in_incremental};

}  // namespace isocnc::rules
