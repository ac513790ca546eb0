#include "interpreter/running/program.h"

#include <limits>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::running {

std::optional<LinePlace> Program::jump_target(const LinePlace& jump, std::uint64_t label) const {
  {
    const std::lock_guard lock(mutex_);
    const auto known = jump_targets_.find(jump.offset);
    if (known != jump_targets_.end()) return known->second;
  }
  const char* const begin = text_.data() + jump.offset;
  const char* const end = text_.data() + text_.size();
  const std::size_t length = std::string_view(text_).substr(jump.offset).find_first_of("\r\n");
  std::optional<LinePlace> found;
  if (length != std::string_view::npos) {
    const char* const below = text::skip_line_end(begin + length, end);
    found = find_label(label, {jump.line + 1, static_cast<std::size_t>(below - text_.data())},
                       std::numeric_limits<std::size_t>::max());
  }
  const std::lock_guard lock(mutex_);
  return jump_targets_.emplace(jump.offset, found).first->second;
}

bool Program::has_label_above(const LinePlace& jump, std::uint64_t label) const {
  return find_label(label, {}, jump.line + 1).has_value();
}

std::optional<LinePlace> Program::find_label(std::uint64_t label, LinePlace from, std::size_t end_line) const {
  syntax::TreeStore store;
  const char* p = text_.data() + from.offset;
  const char* const end = text_.data() + text_.size();
  for (std::size_t line = from.line; line < end_line && p != end; ++line) {
    store.clear();
    const char* const line_end = store.append_line(p, end);
    const syntax::LineTree tree = store.tree(0, p);
    if (tree.has_label() && tree.label == label) return LinePlace{line, static_cast<std::size_t>(p - text_.data())};
    p = text::skip_line_end(line_end, end);
  }
  return std::nullopt;
}

}  // namespace isocnc::running
