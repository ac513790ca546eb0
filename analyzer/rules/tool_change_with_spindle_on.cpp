#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// M06 while M03 or M04 is in force.
static void check_tool_change_with_spindle_on(const ExecutedBlock& block, execution::Sink& sink) {
  const syntax::Word* const change = block.m(dialect::kToolChange);
  if (!change) return;
  const int function = block.spindle_function_before(*change);
  const bool turns = function == 0 ? block.spindle_turns() : function != 5;
  if (turns) report(sink, "tool-change-with-spindle-on"_diag, change->span());
}

extern const Rule tool_change_with_spindle_on = {kToolChange, check_tool_change_with_spindle_on};

}  // namespace isocnc::rules
