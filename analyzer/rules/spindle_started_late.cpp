#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// The first M03 or M04 after feed moves.
static void check_spindle_started_late(const Block& block, execution::Sink& sink) {
  if (!block.before.knows(execution::State::kCutNotStarted)) return;
  for (const int m : {3, 4})
    if (const syntax::Word* const word = block.m(m)) return report(sink, "spindle-started-late"_diag, word->span());
}

extern const Rule spindle_started_late = {kFunction, check_spindle_started_late};

}  // namespace isocnc::rules
