#pragma once

#include <cstddef>
#include <span>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::syntax {

/// How many words at the end of these read as text for people: one that lacks its letter or number, or starts none,
/// with the right word behind it (OP 10).
inline std::size_t prose_at_end(std::span<const Word> words) {
  const auto is_prose = [](const Word& word) {
    return word.letter == kError || word.letter == kNumber || word.has(Word::kMissing);
  };
  if (words.empty()) return 0;
  if (is_prose(words.back())) return 1;
  return words.size() > 1 && is_prose(words[words.size() - 2]) ? 2 : 0;
}

}  // namespace isocnc::syntax
