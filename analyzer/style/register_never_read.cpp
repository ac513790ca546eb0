#include <array>
#include <optional>

#include "analyzer/style/rule.h"

namespace isocnc::style {

/// A register that is assigned and that no IF compares, reported at its first V.
class RegisterNeverRead final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    static_cast<void>(style_findings);
    if (line.tree.jump && line.tree.jump->variable > 0)
      is_read_[static_cast<std::size_t>(line.tree.jump->variable)] = true;
    for (const syntax::Instruction& instruction : line.tree.instructions) {
      if (instruction.kind != syntax::InstructionKind::Assignment) continue;
      const syntax::Word& word = line.tree.command(instruction);
      if (word.register_number() == 0) continue;
      std::optional<StyleFinding>& first = first_[static_cast<std::size_t>(word.register_number())];
      if (!first) first = StyleFinding{line.number, {.id = "register-never-read"_diag, .span = word.span()}};
    }
  }

  void end(std::vector<StyleFinding>& style_findings) override {
    for (std::size_t i = 1; i < first_.size(); ++i)
      if (first_[i] && !is_read_[i]) style_findings.push_back(*first_[i]);
  }

 private:
  std::array<std::optional<StyleFinding>, dialect::kRegisterCount + 1> first_;
  std::array<bool, dialect::kRegisterCount + 1> is_read_{};
};

extern const StyleRuleRow register_never_read = rule<RegisterNeverRead>("register-never-read"_diag);

}  // namespace isocnc::style
