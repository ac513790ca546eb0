#include <array>

#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// Of two Gs of one modal group on a line only the later one counts (D20).
static void check(const Block& block, execution::Sink& sink) {
  std::array<const syntax::Word*, dialect::kModalGroupCount> first{};
  for (const syntax::Instruction& instruction : block.line.instructions) {
    const dialect::GCode* const code = instruction.kind == syntax::InstructionKind::G ? instruction.g() : nullptr;
    if (!code || code->is_motion() || code->group == dialect::ModalGroup::None) continue;
    const syntax::Word*& seen = first[static_cast<std::size_t>(code->group)];
    const syntax::Word& word = block.line.command(instruction);
    // Frames have a code of their own for company (ISO018).
    if (seen && code->alone == dialect::kNoDiagnostic)
      report(sink, "modal-group-twice"_diag, word.span(), 0, seen->span());
    seen = &word;
  }
}

extern const Rule modal_group_twice = {kModal, check};

}  // namespace isocnc::analyzer::rules
