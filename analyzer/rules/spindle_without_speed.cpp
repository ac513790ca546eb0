#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M03 or M04 before any S.
static void check_spindle_without_speed(const ExecutedBlock& block, execution::Sink& sink) {
  if (block.before.speed_given || block.line.spindle >= 0) return;
  for (const int m : {3, 4})
    if (const syntax::Word* const word = block.m(m)) return report(sink, "spindle-without-speed"_diag, word->span());
}

extern const Rule spindle_without_speed = {kFunction, check_spindle_without_speed};

}  // namespace isocnc::rules
