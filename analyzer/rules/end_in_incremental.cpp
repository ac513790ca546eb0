#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// M02 with G91 in force.
static void check(const Block& block, execution::Sink& sink) {
  const syntax::Word* const end = block.m(dialect::kProgramEnd);
  if (end && block.before.incremental()) report(sink, "end-in-incremental"_diag, end->span());
}

extern const Rule end_in_incremental = {kFunction, check};

}  // namespace isocnc::analyzer::rules
