#pragma once

#include <cstddef>
#include <string_view>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

/// Calls `look(tree, terminator)` for each line of a text, in order. Text after the last terminator is a line unless it
/// is empty. The tree is valid during the call.
template <class Look>
void each_tree(std::string_view text, Look&& look) {
  TreeStore store;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end;) {
    store.clear();
    const char* const line_end = store.append_line(p, end);
    const char* const next = text::skip_line_end(line_end, end);
    look(store.tree(0, p), std::string_view(line_end, static_cast<std::size_t>(next - line_end)));
    p = next;
  }
}

}  // namespace isocnc::syntax
