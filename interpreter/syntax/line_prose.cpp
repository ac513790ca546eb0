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

/// Whether a word is a number that belongs to the text before it: SIDE B 2, CALL SUB1, fine lato 2, WHILE V1 < 5. X, Y,
/// Z and codes do not: DOOR X10 has a coordinate.
bool LineParser::is_number_of_prose(std::uint16_t index) const {
  static constexpr dialect::LetterSet kNames =
      (dialect::kDimensionLetters & ~dialect::letters("XYZ")) | dialect::letters("NT");
  if (index >= word_count() || !is_prose(index - 1u)) return false;
  const char letter = word(index).letter;
  if (letter == kNumber || letter == kError) return true;
  if (letter == 'V') return !is_assigned(index) && index + 1 < word_count() && word(index + 1u).letter == kError;
  const double value = word(index).value;
  const bool is_code = value >= 0 && value <= 999 && dialect::g_code(static_cast<std::size_t>(value)) != nullptr;
  if (letter == 'G' && !is_code) return true;
  const char before = text::upper(begin_[word(index - 1u).begin]);
  return before >= 'A' && before <= 'Z' && contains(kNames, letter);
}

/// Whether a word is a letter without a number, or text that is no word.
bool LineParser::is_prose(std::size_t index) const {
  const Word& it = word(index);
  return it.letter == kError || (it.has(Word::kMissing) && it.letter >= 'A' && it.letter <= 'Z');
}

/// The end of the letters without numbers, and of text that is no word, from a word on. `is_odd`: whether they contain
/// something that is never valid there, as `X Y Z` does not.
std::uint16_t LineParser::end_of_prose(std::uint16_t index, bool& is_odd) const {
  const auto is_foreign = [&](const Word& it) { return it.letter == kError && is_foreign_word(it); };
  dialect::LetterSet seen = 0;
  for (; index < word_count() && is_prose(index) && !is_foreign(word(index)); ++index) {
    const char letter = word(index).letter;
    is_odd |= letter == kError || !contains(dialect::kDimensionLetters, letter) || contains(seen, letter);
    if (letter != kError) seen |= dialect::letter_bit(letter);
  }
  return index;
}

/// The end of a text of which some words have been found: numbers and further words belong to it, as in `pausa 2 s`.
std::uint16_t LineParser::end_of_text(std::uint16_t index) const {
  for (;;) {
    bool is_odd = false;
    const bool is_number = is_number_of_prose(index);
    const std::uint16_t end = is_number ? static_cast<std::uint16_t>(index + 1) : end_of_prose(index, is_odd);
    if (end == index) return end;
    index = end;
  }
}

/// Replaces the findings of several words by one.
void LineParser::report_prose(std::uint16_t first, std::uint16_t end) {
  const Span span = hull(word(first).span(), word(end - 1u).span());
  take_back_within(span);
  const char letter = word(first).letter;
  if (letter == kError || letter == kNumber) return report("unknown-word/prose"_cause, span);
  const bool is_doubled = end - first == 2 && letter == word(end - 1u).letter;  // XX
  report(is_doubled ? "word-without-number"_diag : "word-without-number/prose"_cause, span);
}

/// Joins letters without numbers that were meant as a comment: one finding, not one for each letter.
void LineParser::join_prose() {
  for (std::uint16_t i = 0; i < word_count(); ++i) {
    if (word(i).letter == kIf) return;  // A condition has its own diagnostic.
    bool is_odd = false;
    std::uint16_t end = end_of_prose(i, is_odd);
    const bool is_only_unit = end - i == 2 && is_unit(word(i), word(i + 1u));
    const bool ends_in_name = is_odd && end - i == 2 && end < word_count() && word(end).letter == kError;  // END1
    if (!is_only_unit && !ends_in_name && (end - i < 3 || !is_odd)) {
      i = std::max(i, end);
      continue;
    }
    if (!is_only_unit) {
      end = end_of_text(end);
      if (i > 0 && word(i - 1u).letter == kNumber) --i;  // 2 s di pausa
    }
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
