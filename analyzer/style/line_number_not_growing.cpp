#include "analyzer/style/rule.h"

namespace isocnc::style {

/// A line number that is not greater than the one before. This covers repeated numbers: between two equal ones, one
/// must fail to grow.
class LineNumberNotGrowing final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    const syntax::Word* const word = line.tree.label_word();
    if (!word) return;
    if (word->value <= last_) {
      style_findings.push_back(
          {line.number, {.id = "line-number-not-growing"_diag, .span = word->span(), .values = {last_}}});
    }
    last_ = word->value;
  }

 private:
  double last_ = -1;
};

extern const StyleRuleRow line_number_not_growing = rule<LineNumberNotGrowing>("line-number-not-growing"_diag);

}  // namespace isocnc::style
