#include "analyzer/style/rule.h"

namespace isocnc::style {

/// The first line end that differs from those above; the lines after it are not reported.
class MixedLineEnds final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    if (reported_ || line.terminator.empty()) return;
    if (first_.empty()) first_ = line.terminator;
    if (line.terminator == first_) return;
    const auto end = static_cast<std::uint32_t>(line.tree.text.size());
    style_findings.push_back({line.number, {.id = "mixed-line-ends"_diag, .span = {0, end}}});
    reported_ = true;
  }

 private:
  std::string_view first_;
  bool reported_ = false;
};

extern const StyleRuleRow mixed_line_ends = rule<MixedLineEnds>("mixed-line-ends"_diag);

}  // namespace isocnc::style
