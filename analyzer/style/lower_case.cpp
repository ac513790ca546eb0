#include <algorithm>

#include "analyzer/style/rule.h"

namespace isocnc::style {

static bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// Lower-case letters outside comments (D8): one finding a line, from the first such letter to the last.
class LowerCase final : public StyleRule {
 public:
  void read(const StyleLine& line, std::vector<StyleFinding>& style_findings) override {
    syntax::Span span;
    for (const syntax::Word& word : line.tree.words)
      for (std::uint32_t at = word.begin; at < word.end; ++at)
        if (is_lower(line.tree.text[at]) && !is_comment(line.tree, at))
          span = span.empty() ? syntax::Span{at, at + 1} : syntax::hull(span, {at, at + 1});
    if (!span.empty()) style_findings.push_back({line.number, {.id = "lower-case"_diag, .span = span}});
  }

 private:
  static bool is_comment(const syntax::LineTree& tree, std::uint32_t column) {
    return std::any_of(tree.comments.begin(), tree.comments.end(),
                       [&](syntax::Span comment) { return comment.holds(column); });
  }
};

extern const StyleRuleRow lower_case = rule<LowerCase>("lower-case"_diag);

}  // namespace isocnc::style
