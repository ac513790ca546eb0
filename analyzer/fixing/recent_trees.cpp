#include "analyzer/fixing/recent_trees.h"

namespace isocnc::fixing {

syntax::LineTree RecentTrees::operator[](std::size_t line) {
  KeptTree& parsed = parsed_[line % kMaxTrees];
  const std::string_view text = program_.text(line);
  if (parsed.line != line) {
    parsed.store.clear();
    parsed.store.append_line(text.data(), text.data() + text.size());
    parsed.line = line;
  }
  return parsed.store.tree(0, text.data());
}

}  // namespace isocnc::fixing
