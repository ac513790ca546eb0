#include <unordered_set>

#include "analyzer/style/rule.h"

namespace isocnc::style {

/// A line number that no GOTO names, in a program that has jumps and numbers only few lines: there a number is meant as
/// a label.
class LabelNeverUsed final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    static_cast<void>(style_findings);
    if (!line.tree.is_empty()) ++blocks_;
    if (const syntax::Word* const word = line.tree.label_word())
      labels_.push_back({line.tree.label, line.number, word->span()});
    if (line.tree.jump && line.tree.jump->has_target) targets_.insert(line.tree.jump->target);
    leads_anywhere_ |= line.tree.jump && !line.tree.jump->has_target;
  }

  void end(std::vector<StyleFinding>& style_findings) override {
    if (targets_.empty() || leads_anywhere_ || 2 * labels_.size() >= blocks_) return;
    for (const WrittenLabel& label : labels_)
      if (!targets_.contains(label.label))
        style_findings.push_back({label.line, {.id = "label-never-used"_diag, .span = label.span}});
  }

 private:
  struct WrittenLabel {
    std::uint64_t label;
    std::size_t line;
    syntax::Span span;
  };
  std::vector<WrittenLabel> labels_;
  std::unordered_set<std::uint64_t> targets_;
  std::size_t blocks_ = 0;
  bool leads_anywhere_ = false;  // Whether a jump has no label that can be read.
};

extern const StyleRuleRow label_never_used = rule<LabelNeverUsed>("label-never-used"_diag);

}  // namespace isocnc::style
