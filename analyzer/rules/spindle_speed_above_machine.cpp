#include "analyzer/rules/rule.h"

namespace isocnc::rules {

static void check_spindle_speed_above_machine(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word& word = block.line.words[static_cast<std::size_t>(block.line.spindle)];
  if (word.value > block.setup.limits.spindle_speed)
    report(sink, "spindle-speed-above-machine"_diag, word.span(), block.setup.limits.spindle_speed);
}

extern const Rule spindle_speed_above_machine = {kSpindle, check_spindle_speed_above_machine};

}  // namespace isocnc::rules
