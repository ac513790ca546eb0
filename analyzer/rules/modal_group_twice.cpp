#include <array>

#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// Of two Gs of one modal group on a line only the later one counts (D20), unless a motion between them uses the first
/// (D14). W001 reports the same G twice.
static void check_modal_group_twice(const ExecutedBlock& block, execution::Sink& sink) {
  std::array<const syntax::Word*, dialect::kModalGroupCount> first{};
  for (const syntax::Instruction& instruction : block.line.instructions) {
    const dialect::GCode* const code = instruction.kind == syntax::InstructionKind::G ? instruction.g() : nullptr;
    const bool moves = instruction.is_motion();
    if (moves) first = {};
    if (!code || moves || code->group == dialect::ModalGroup::None) continue;
    const syntax::Word*& seen = first[static_cast<std::size_t>(code->group)];
    const syntax::Word& word = block.line.command(instruction);
    // ISO018 reports frames that are not alone on the line.
    const bool is_repeated = seen && seen->value == word.value && code->repeated != dialect::kNoDiagnostic;
    if (seen && !is_repeated && code->alone == dialect::kNoDiagnostic)
      report(sink, "modal-group-twice"_diag, word.span(), 0, seen->span());
    seen = &word;
  }
}

extern const Rule modal_group_twice = {kModal, check_modal_group_twice};

}  // namespace isocnc::rules
