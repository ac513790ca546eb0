#include "analyzer/style/rule.h"

namespace isocnc::style {

/// Where the line ends first differ from those above: one mistake, however many lines follow.
class MixedLineEnds final : public Rule {
 public:
  void read(const Line& line, std::vector<Remark>& remarks) override {
    if (told_ || line.terminator.empty()) return;
    if (first_.empty()) first_ = line.terminator;
    if (line.terminator == first_) return;
    const auto end = static_cast<std::uint32_t>(line.tree.text.size());
    remarks.push_back({line.number, {.id = "mixed-line-ends"_diag, .span = {0, end}}});
    told_ = true;
  }

 private:
  std::string_view first_;
  bool told_ = false;
};

extern const RuleRow mixed_line_ends = rule<MixedLineEnds>("mixed-line-ends"_diag);

}  // namespace isocnc::style
