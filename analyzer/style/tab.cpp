#include "analyzer/style/rule.h"

namespace isocnc::style {

/// The first tab of a line outside comments.
class TabRule final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    std::size_t at = line.tree.text.find('\t');
    for (const syntax::Span comment : line.tree.comments)
      if (at != std::string_view::npos && comment.holds(static_cast<std::uint32_t>(at)))
        at = line.tree.text.find('\t', comment.end);
    if (at == std::string_view::npos) return;
    const auto column = static_cast<std::uint32_t>(at);
    style_findings.push_back({line.number, {.id = "tab"_diag, .span = {column, column + 1}}});
  }
};

extern const StyleRuleRow tab = rule<TabRule>("tab"_diag);

}  // namespace isocnc::style
