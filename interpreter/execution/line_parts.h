#pragma once

#include <optional>

#include "interpreter/dialect/letters.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::execution {

/// Words that a block lacks, which has been reported. Such words at the start of the next line belong to it.
struct Lack {
  dialect::LetterSet letters = 0;
  bool is_of_motion = false;  ///< The letters are words of a motion.
  bool value = false;         ///< A number, or a `=` with its number.
  bool jump = false;          ///< The rest of an IF without its GOTO.

  bool empty() const { return letters == 0 && !value && !jump; }
  /// Takes what a finding reports as missing.
  void take(dialect::Cause finding);
  /// Removes what the line has, since a second word with its letter starts another block.
  void remove_words_of(const syntax::LineTree& line);

  friend bool operator==(const Lack&, const Lack&) = default;
};

/// A line that starts with words that the block before it lacks: its author broke the line too early, or put a word on
/// the wrong line. The lack has been reported, so these words need no finding of their own. Both parts have the columns
/// of the line.
class SplitLine {
 public:
  /// Nothing if the line does not start with such words.
  static std::optional<SplitLine> split(const syntax::LineTree& line, const Lack& lack);

  /// The words that belong to the block before.
  syntax::LineTree carried() const { return carried_.tree(); }
  syntax::LineTree rest() const { return rest_.tree(); }

 private:
  SplitLine(std::string_view carried, std::string_view rest) : carried_(carried), rest_(rest) {}

  syntax::ParsedLine carried_;
  syntax::ParsedLine rest_;
};

}  // namespace isocnc::execution
