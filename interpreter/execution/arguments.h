#pragma once

#include <array>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::execution {

/// The arguments of one instruction by letter. Values as written: neither units nor G91 are applied.
class Arguments {
 public:
  Arguments(const syntax::LineTree& line, const syntax::Instruction& instruction) : line_(line) {
    const bool is_g = instruction.kind == syntax::InstructionKind::G;
    for (std::uint16_t i = instruction.begin; i < instruction.end; ++i) {
      const syntax::Word& word = line.words[i];
      if (word.owner != instruction.number || (is_g && i == instruction.command)) continue;
      if (present_ == 0) first_ = i;
      present_ |= dialect::letter_bit(word.letter);
      index_[slot(word.letter)] = i;
    }
  }

  dialect::LetterSet present() const { return present_; }
  bool empty() const { return present_ == 0; }
  bool has(char letter) const { return dialect::contains(present_, letter); }
  /// The word of a letter that is present.
  const syntax::Word& word(char letter) const { return line_.words[index_[slot(letter)]]; }
  /// The value of a letter that is present; NaN when it could not be read.
  double operator[](char letter) const { return word(letter).value; }
  double value_or(char letter, double otherwise) const { return has(letter) ? word(letter).value : otherwise; }
  const syntax::Word& first() const { return line_.words[first_]; }
  /// The span of the words with a letter in `set`; empty without such a word.
  syntax::Span span_of(dialect::LetterSet set) const {
    syntax::Span span;
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      if (dialect::contains(present_ & set, letter))
        span = span.empty() ? word(letter).span() : syntax::hull(span, word(letter).span());
    return span;
  }

 private:
  static constexpr std::size_t slot(char letter) { return static_cast<std::size_t>(letter - 'A'); }

  const syntax::LineTree& line_;
  dialect::LetterSet present_ = 0;
  std::uint16_t first_ = 0;
  std::array<std::uint16_t, 26> index_;  // Word by letter; set only for the letters in `present_`.
};

}  // namespace isocnc::execution
