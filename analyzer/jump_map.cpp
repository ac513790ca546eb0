#include "analyzer/jump_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::analyzer {

/// Counts the lines of a text up to ever later places.
class LineCounter {
 public:
  explicit LineCounter(std::string_view text)
      : text_(text), has_carriage_returns_(text.find('\r') != text.npos) {}

  std::uint64_t line_of(std::size_t offset) {
    const std::string_view passed = text_.substr(offset_, offset - offset_);
    line_ += static_cast<std::uint64_t>(std::count(passed.begin(), passed.end(), '\n'));
    if (has_carriage_returns_)
      for (std::size_t i = 0; i < passed.size(); ++i)
        line_ += passed[i] == '\r' && offset_ + i + 1 < text_.size() && text_[offset_ + i + 1] != '\n' ? 1 : 0;
    offset_ = offset;
    return line_;
  }

 private:
  std::string_view text_;
  bool has_carriage_returns_;
  std::size_t offset_ = 0;
  std::uint64_t line_ = 0;
};

/// Whether a GOTO may end in the O at `offset`: of its letters O stands nowhere else outside comments.
static bool may_belong_to_goto(std::string_view text, std::size_t offset) {
  while (offset > 0 && syntax::is_blank(text[offset - 1])) --offset;
  if (offset == 0) return false;
  const char before = syntax::upper(text[offset - 1]);
  return before == 'G' || before == ')';
}

JumpMap::JumpMap(std::string_view text) {
  LineCounter counter(text);
  syntax::TreeStore store;
  const auto next_o = [&](std::size_t from, char letter) {
    const void* const at = from < text.size() ? std::memchr(text.data() + from, letter, text.size() - from) : nullptr;
    return at ? static_cast<std::size_t>(static_cast<const char*>(at) - text.data()) : text.size();
  };
  std::size_t upper_case = next_o(0, 'O');
  std::size_t lower_case = next_o(0, 'o');
  while (std::min(upper_case, lower_case) < text.size()) {
    std::size_t at = std::min(upper_case, lower_case);
    if (may_belong_to_goto(text, at)) {
      std::size_t begin = at;
      while (begin > 0 && !syntax::is_line_end(text[begin - 1])) --begin;
      store.clear();
      const char* const end = store.append_line(text.data() + begin, text.data() + text.size());
      const syntax::LineTree tree = store.tree(0, text.data() + begin);
      if (tree.jump && tree.jump->has_target) add(counter.line_of(begin), *tree.jump);
      at = static_cast<std::size_t>(end - text.data());
    } else {
      ++at;
    }
    if (upper_case < at) upper_case = next_o(at, 'O');
    if (lower_case < at) lower_case = next_o(at, 'o');
  }
  complete();
}

void JumpMap::add(std::uint64_t line, const syntax::Jump& jump) {
  sites_.push_back({line, jump});
  targets_.insert(jump.target);
  if (jump.variable <= 0 || !jump.condition_is_known()) return;
  const auto reg = static_cast<std::size_t>(jump.variable);
  constants_[reg].push_back(jump.value);
  last_read_[reg] = static_cast<std::uint32_t>(sites_.size());
}

void JumpMap::complete() {
  for (int reg = 1; reg <= dialect::kRegisterCount; ++reg) {
    std::vector<double>& values = constants_[static_cast<std::size_t>(reg)];
    if (values.empty()) continue;
    compared_.push_back(reg);
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
}

void JumpMap::resolve(const std::unordered_map<std::uint64_t, std::vector<std::uint64_t>>& label_lines) {
  targets_of_jumps_.clear();
  for (const Site& site : sites_) {
    const auto lines = label_lines.find(site.jump.target);
    Target target = Target::NotFound;
    if (lines != label_lines.end() && !lines->second.empty())
      target = lines->second.back() > site.line ? Target::Below : Target::Above;
    targets_of_jumps_.push_back(target);
  }
  resolved_ = true;
}

bool JumpMap::means_the_same(const JumpMap& other) const {
  const auto same = [](const Site& a, const Site& b) {
    return a.jump.variable == b.jump.variable && a.jump.comparison == b.jump.comparison &&
           (a.jump.value == b.jump.value || (std::isnan(a.jump.value) && std::isnan(b.jump.value))) &&
           a.jump.target == b.jump.target;
  };
  return std::equal(sites_.begin(), sites_.end(), other.sites_.begin(), other.sites_.end(), same) &&
         resolved_ == other.resolved_ && targets_of_jumps_ == other.targets_of_jumps_;
}

}  // namespace isocnc::analyzer
