#include <algorithm>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// A tool change to the tool that is already mounted.
static void check_tool_already_mounted(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.before.tool_known || block.after.tool != block.before.tool) return;
  const auto tool = std::find_if(block.line.words.begin(), block.line.words.end(),
                                 [](const syntax::Word& word) { return word.letter == 'T'; });
  if (tool != block.line.words.end()) report(sink, "tool-already-mounted"_diag, tool->span());
}

extern const Rule tool_already_mounted = {kToolChange, check_tool_already_mounted};

}  // namespace isocnc::rules
