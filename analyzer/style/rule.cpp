#include "analyzer/style/rule.h"

#include "interpreter/syntax/each_tree.h"
#include "interpreter/syntax/forward_paths.h"

namespace isocnc::style {

#define ISOCNC_RULE(name) extern const StyleRuleRow name;
#include <style_rules.inc>
#undef ISOCNC_RULE

static const StyleRuleRow* const kRules[] = {
#define ISOCNC_RULE(name) &(name),
#include <style_rules.inc>
#undef ISOCNC_RULE
};

/// Whether the control reads a line: after M02, only from a label on that a jump above names (D47).
class StyleReader::Liveness {
 public:
  bool is_read(const syntax::LineTree& line) {
    paths_.arrive(line);
    const bool is_reached = paths_.live.is_reached;
    paths_.pass(line, [](Reach&) {});
    return is_reached;
  }

 private:
  struct Reach {
    bool is_reached = false;

    bool empty() const { return !is_reached; }
    void join(Reach&&) {}
  };

  syntax::ForwardPaths<Reach> paths_{Reach{true}};
};

StyleReader::StyleReader(const IsWanted& is_wanted) : liveness_(std::make_unique<Liveness>()) {
  for (const StyleRuleRow* const row : kRules)
    if (is_wanted(row->id)) rules_.push_back(row->make());
}

StyleReader::~StyleReader() = default;

void StyleReader::read(const StyleLine& line) {
  if (!liveness_->is_read(line.tree)) return;
  for (const std::unique_ptr<StyleRule>& rule : rules_) rule->read(line, style_findings_);
}

std::vector<StyleFinding> StyleReader::finish() {
  for (const std::unique_ptr<StyleRule>& rule : rules_) rule->end(style_findings_);
  return std::move(style_findings_);
}

std::vector<StyleFinding> read_program(std::string_view text, const IsWanted& is_wanted) {
  StyleReader reader(is_wanted);
  if (reader.is_idle()) return {};
  std::size_t number = 0;
  syntax::each_tree(text, [&](const syntax::LineTree& tree, std::string_view terminator) {
    reader.read({number++, tree, terminator});
  });
  return reader.finish();
}

}  // namespace isocnc::style
