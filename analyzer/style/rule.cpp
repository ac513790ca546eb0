#include "analyzer/style/rule.h"

#include <algorithm>
#include <unordered_set>

#include "interpreter/syntax/each_tree.h"

namespace isocnc::style {

#define ISOCNC_RULE(name) extern const RuleRow name;
#include <style_rules.inc>
#undef ISOCNC_RULE

static const RuleRow* const kRules[] = {
#define ISOCNC_RULE(name) &(name),
#include <style_rules.inc>
#undef ISOCNC_RULE
};

/// Whether the control reads a line: behind M02 only from a label on that a GOTO above names (D47).
class Reader::Liveness {
 public:
  bool is_read(const syntax::LineTree& line) {
    if (line.has_label() && targets_.contains(line.label)) ended_ = false;
    if (ended_) return false;
    if (line.jump && line.jump->has_target) targets_.insert(line.jump->target);
    ended_ = std::any_of(line.instructions.begin(), line.instructions.end(),
                         [&](const syntax::Instruction& each) { return line.ends_program(each); });
    return true;
  }

 private:
  std::unordered_set<std::uint64_t> targets_;
  bool ended_ = false;
};

Reader::Reader(const IsWanted& is_wanted) : liveness_(std::make_unique<Liveness>()) {
  for (const RuleRow* const row : kRules)
    if (is_wanted(row->id)) rules_.push_back(row->make());
}

Reader::~Reader() = default;

void Reader::read(const Line& line) {
  if (!liveness_->is_read(line.tree)) return;
  for (const std::unique_ptr<Rule>& rule : rules_) rule->read(line, remarks_);
}

std::vector<Remark> Reader::finish() {
  for (const std::unique_ptr<Rule>& rule : rules_) rule->end(remarks_);
  return std::move(remarks_);
}

std::vector<Remark> read_program(std::string_view text, const IsWanted& is_wanted) {
  Reader reader(is_wanted);
  if (reader.is_idle()) return {};
  std::uint64_t number = 0;
  syntax::each_tree(text, [&](const syntax::LineTree& tree, std::string_view terminator) {
    reader.read({number++, tree, terminator});
  });
  return reader.finish();
}

}  // namespace isocnc::style
