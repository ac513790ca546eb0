#include <algorithm>
#include <limits>
#include <string>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

/// Whether unknown characters are a letter of another control with its number (H2, D3): a word, not plain text.
bool LineParser::is_foreign_word(const Word& unknown) const {
  const std::string_view text = text_of(unknown.span());
  const std::string_view after = text.substr(1);
  return text::upper(text.front()) >= 'A' && text::upper(text.front()) <= 'Z' && !after.empty() &&
         std::all_of(after.begin(), after.end(), [](char c) { return text::is_blank(c) || text::is_number_char(c); });
}

/// Whether two words are a unit (X10mm, X2in, C90deg), or one letter without a number written twice.
bool LineParser::is_unit(const Word& first, const Word& second) const {
  std::string unit;
  for (std::uint32_t i = first.begin; i < second.end && unit.size() < 4; ++i)
    if (!text::is_blank(begin_[i])) unit += text::upper(begin_[i]);
  return unit == "IN" || unit == "DEG" || (unit.size() == 2 && unit[0] == unit[1]);
}

/// Whether a word is a number that belongs to the text before it: PROGRAM 12, CALL SUB1.
bool LineParser::is_number_of_prose(std::uint16_t index) const {
  const char letter = index < word_count() ? word(index).letter : '\0';
  const char before = text::upper(begin_[word(index - 1u).begin]);
  const bool follows_letter = before >= 'A' && before <= 'Z';
  return letter == kNumber || (follows_letter && contains(dialect::kDimensionLetters | dialect::letters("NT"), letter));
}

/// The end of the letters without numbers, and of text that is no word, from a word on. `is_odd`: whether they contain
/// something that is never valid there, as `X Y Z` does not.
std::uint16_t LineParser::end_of_prose(std::uint16_t index, bool& is_odd) const {
  const auto is_prose = [&](const Word& it) {
    return it.letter == kError ? !is_foreign_word(it) : it.has(Word::kMissing) && it.letter >= 'A' && it.letter <= 'Z';
  };
  dialect::LetterSet seen = 0;
  for (; index < word_count() && is_prose(word(index)); ++index) {
    const char letter = word(index).letter;
    is_odd |= letter == kError || !contains(dialect::kDimensionLetters, letter) || contains(seen, letter);
    if (letter != kError) seen |= dialect::letter_bit(letter);
  }
  return index;
}

/// Replaces the findings of several words by one.
void LineParser::report_prose(std::uint16_t first, std::uint16_t end) {
  const Span span = hull(word(first).span(), word(end - 1u).span());
  take_back_within(span);
  report(word(first).letter == kError ? "unknown-word"_diag : "word-without-number"_diag, span);
}

/// Joins letters without numbers that were meant as a comment: one finding, not one for each letter.
void LineParser::join_prose() {
  for (std::uint16_t i = 0; i < word_count(); ++i) {
    if (word(i).letter == kIf) return;  // A condition has its own diagnostic.
    bool is_odd = false;
    std::uint16_t end = end_of_prose(i, is_odd);
    const bool is_only_unit = end - i == 2 && is_unit(word(i), word(i + 1u));
    if (!is_only_unit && (end - i < 3 || !is_odd)) {
      i = std::max(i, end);
      continue;
    }
    if (!is_only_unit && is_number_of_prose(end)) ++end;
    report_prose(i, end);
    if (is_only_unit && word(i).letter == word(i + 1u).letter && contains(dialect::kDimensionLetters, word(i).letter))
      ++i;  // XX: the first X remains a word.
    for (; i < end; ++i) {
      word(i).letter = kError;
      word(i).value = std::numeric_limits<double>::quiet_NaN();
      word(i).flags |= Word::kReported;
    }
  }
}

}  // namespace isocnc::syntax
