#include "analyzer/rules/rule.h"
#include "analyzer/rules/spindle_use.h"

namespace isocnc::rules {

/// The first M03 or M04 after feed moves.
static void check_spindle_started_late(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.holds(kCutNotStarted)) return;
  for (const int m : {3, 4})
    if (const syntax::Word* const word = block.m(m)) return report(sink, "spindle-started-late"_diag, word->span());
}

extern const Rule spindle_started_late = {
    .concerns = kFunction, .check = check_spindle_started_late, .memory = &kSpindleUse};

}  // namespace isocnc::rules
