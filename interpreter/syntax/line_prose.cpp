#include <algorithm>
#include <limits>
#include <string>

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/line_parser.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

/// Whether unknown characters are a letter of another control with its number (H2, D3): a word, not plain text.
bool LineParser::is_foreign_word(const Word& unknown) const {
  const std::string_view text = text_of(unknown.span());
  const std::string_view behind = text.substr(1);
  return upper(text.front()) >= 'A' && upper(text.front()) <= 'Z' && !behind.empty() &&
         std::all_of(behind.begin(), behind.end(), [](char c) { return is_blank(c) || is_number_char(c); });
}

/// Whether two words are a unit (X10mm, X2in, C90deg), or one letter without a number written twice.
bool LineParser::is_unit(const Word& first, const Word& second) const {
  std::string unit;
  for (std::uint32_t i = first.begin; i < second.end && unit.size() < 4; ++i)
    if (!is_blank(begin_[i])) unit += upper(begin_[i]);
  return unit == "IN" || unit == "DEG" || (unit.size() == 2 && unit[0] == unit[1]);
}

/// Whether a word is a number that belongs to the text before it: PROGRAM 12, CALL SUB1.
bool LineParser::is_number_of_prose(std::uint16_t index) const {
  const char letter = index < word_count() ? word(index).letter : '\0';
  const char before = upper(begin_[word(index - 1u).begin]);
  const bool follows_letter = before >= 'A' && before <= 'Z';
  return letter == kNumber || (follows_letter && contains(dialect::kDimensionLetters | dialect::letters("NT"), letter));
}

/// Joins letters without numbers that were meant as a comment: one finding, not one for each letter. `X Y Z` is not
/// joined; the text must contain something that is never valid there.
void LineParser::join_prose() {
  const auto is_prose = [&](std::uint16_t i) {
    const Word& it = word(i);
    return it.letter == kError ? !is_foreign_word(it) : it.has(Word::kMissing) && it.letter >= 'A' && it.letter <= 'Z';
  };
  for (std::uint16_t i = 0; i < word_count(); ++i) {
    if (word(i).letter == kIf) return;  // A condition has its own diagnostic.
    dialect::LetterSet seen = 0;
    bool is_odd = false;
    std::uint16_t last = i;
    for (; last < word_count() && is_prose(last); ++last) {
      const char letter = word(last).letter;
      is_odd |= letter == kError || !contains(dialect::kDimensionLetters, letter) || contains(seen, letter);
      if (letter != kError) seen |= dialect::letter_bit(letter);
    }
    const bool is_only_unit = last - i == 2 && is_unit(word(i), word(i + 1u));
    if (!is_only_unit && (last - i < 3 || !is_odd)) {
      i = std::max(i, last);
      continue;
    }
    if (!is_only_unit && is_number_of_prose(last)) ++last;
    const Span span = hull(word(i).span(), word(last - 1u).span());
    const dialect::DiagnosticId id = word(i).letter == kError ? "unknown-word"_diag : "word-without-number"_diag;
    take_back_within(span);
    report(id, span);
    if (is_only_unit && word(i).letter == word(i + 1u).letter && contains(dialect::kDimensionLetters, word(i).letter))
      ++i;  // XX: the first X remains a word.
    for (; i < last; ++i) {
      word(i).letter = kError;
      word(i).value = std::numeric_limits<double>::quiet_NaN();
      word(i).flags |= Word::kReported;
    }
  }
}

}  // namespace isocnc::syntax
