#pragma once

#include "interpreter/dialect/letters.h"
#include "interpreter/syntax/line_tree.h"

namespace isocnc::execution {

/// Words that a block lacks, which has been reported. Such words at the start of the next line belong to it.
struct Lack {
  dialect::LetterSet letters = 0;
  bool is_of_motion = false;  ///< The letters are words of a motion.
  bool value = false;         ///< A number, or a `=` with its number.
  bool jump = false;          ///< The rest of an IF without its GOTO.

  bool empty() const { return letters == 0 && !value && !jump; }
  /// Takes what a finding reports as missing.
  void take(dialect::DiagnosticId finding);
  /// Removes what the line has, since a second word with its letter starts another block.
  void remove_words_of(const syntax::LineTree& line);

  friend bool operator==(const Lack&, const Lack&) = default;
};

}  // namespace isocnc::execution
