#pragma once

#include <cstddef>
#include <span>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::syntax {

/// The number of trailing words that are probably plain text (OP 10): a malformed word (without letter or number, or
/// unknown characters), and one correct word after it.
inline std::size_t prose_at_end(std::span<const Word> words) {
  const auto is_prose = [](const Word& word) {
    return word.letter == kError || word.letter == kNumber || word.has(Word::kMissing);
  };
  if (words.empty()) return 0;
  if (is_prose(words.back())) return 1;
  return words.size() > 1 && is_prose(words[words.size() - 2]) ? 2 : 0;
}

}  // namespace isocnc::syntax
