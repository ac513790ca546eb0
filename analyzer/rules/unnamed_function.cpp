#include <algorithm>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// A user-defined M that the machine file does not list.
static void check_unnamed_function(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.setup.functions) return;
  const auto& named = *block.setup.functions;
  for (const syntax::Instruction& instruction : block.line.instructions) {
    if (instruction.kind != syntax::InstructionKind::Function) continue;
    const syntax::Word& word = block.line.command(instruction);
    const std::optional<int> number = word.whole();
    if (number && dialect::is_user_function(*number) && std::find(named.begin(), named.end(), *number) == named.end())
      report(sink, "unnamed-function"_diag, word.span());
  }
}

extern const Rule unnamed_function = {kFunction, check_unnamed_function};

}  // namespace isocnc::rules
