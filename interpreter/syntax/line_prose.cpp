#include <algorithm>
#include <limits>
#include <string>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

/// The span from a word to the line's last, with the arguments of a call in parentheses: CYCLE81(5,0,2,-10).
Span LineParser::statement_span(std::uint16_t first) const {
  Span span = hull(word(first).span(), word(word_count() - 1u).span());
  for (std::size_t i = line_.first_comment; i < store_.comments_.size(); ++i)
    if (store_.comments_[i].begin == span.end && begin_[span.end] == '(') span.end = store_.comments_[i].end;
  return span;
}

/// Whether a word is a G that this control does not have.
static bool is_g_of_other_controls(const Word& word) {
  if (word.letter != 'G' || !word.is_plain_integer() || !word.known()) return false;
  return word.value > 999 || dialect::g_code(static_cast<std::size_t>(word.value)) == nullptr;
}

/// Whether the line starts with a G that only other controls have.
bool LineParser::starts_with_unknown_g() const {
  std::uint16_t first = 0;
  while (first < word_count() && word(first).letter == 'N') ++first;
  return first < word_count() && is_g_of_other_controls(word(first));
}

/// Reports a statement of another control once, and takes its words together as one that cannot be read.
bool LineParser::take_statement() {
  const dialect::ForeignForm* const form = dialect::foreign_statement({begin_, line_.length});
  if (!form) return false;
  std::uint16_t first = 0;
  while (first < word_count() && word(first).letter == 'N' && !word(first).has(Word::kMissing)) ++first;
  if (first == word_count() || word(first).letter == kIf) return false;  // A condition has its own diagnostic.
  const Span span = statement_span(first);
  take_back_within(span);
  const bool is_text = form->diagnostics[0] == "unknown-word"_diag;
  const bool starts_word = word(first).letter != kError;
  report(is_text && starts_word ? "word-without-number"_diag : form->diagnostics[0], span);
  while (word_count() > first + 1) store_.words_.pop_back();
  Word& statement = word(first);
  statement.letter = kError;
  statement.begin = span.begin;
  statement.end = span.end;
  statement.value = std::numeric_limits<double>::quiet_NaN();
  statement.flags = Word::kReported;
  if (form->may_move) line_.flags |= LineTree::kMayMove;
  return true;
}

/// Takes back the finding of a * at the end of a block of another control whose line has a finding already.
void LineParser::drop_block_end() {
  const Word* const last = word_count() > 1 ? &word(word_count() - 1u) : nullptr;
  const auto findings = store_.findings_.size() - line_.first_finding;
  if (last && last->letter == kError && text_of(last->span()) == "*" && findings > 1)
    take_back("unknown-word"_diag, last->span());
}

bool is_foreign_word(std::string_view text) {
  const std::string_view after = text.substr(1);
  const auto belongs = [](char c) {  // U0 W0: two increments that have one finding.
    return text::is_blank(c) || text::is_number_char(c) || text::upper(c) == 'U' || text::upper(c) == 'W';
  };
  return text::upper(text.front()) >= 'A' && text::upper(text.front()) <= 'Z' && !after.empty() &&
         text::is_number_char(after.back()) && std::all_of(after.begin(), after.end(), belongs);
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
/// something that is never valid there, as `X Y Z` does not. APRI is: nobody leaves out the numbers of letters together
/// in such an order.
std::uint16_t LineParser::end_of_prose(std::uint16_t index, bool& is_odd) const {
  const auto is_foreign = [&](const Word& it) {
    return it.letter == kError && (is_foreign_word(text_of(it.span())) || it.has(Word::kReported));
  };
  dialect::LetterSet seen = 0;
  const std::uint16_t begin = index;
  for (; index < word_count() && is_prose(index) && !is_foreign(word(index)); ++index) {
    const char letter = word(index).letter;
    is_odd |= letter == kError || !contains(dialect::kDimensionLetters, letter) || contains(seen, letter);
    is_odd |= index > begin && word(index).begin == word(index - 1u).end &&
              dialect::kArgumentOrder.find(letter) < dialect::kArgumentOrder.find(word(index - 1u).letter);
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

/// Whether words are one that another control has (SUPA), so that words after it are no part of a text.
bool LineParser::ends_with_foreign_word(std::uint16_t first, std::uint16_t end) const {
  if (end == word_count()) return false;
  const Span text = hull(word(first).span(), word(end - 1u).span());
  return dialect::foreign_form("word-without-number"_diag, {begin_, line_.length}, text.begin, text.end) != nullptr;
}

/// Replaces the findings of several words by one.
void LineParser::report_prose(std::uint16_t first, std::uint16_t end) {
  const Span span = hull(word(first).span(), word(end - 1u).span());
  take_back_within(span);
  if (first > 0 && is_g_of_other_controls(word(first - 1u))) return;  // G641 ADIS=0.1: reported at the G.
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
    if (!is_only_unit && !ends_with_foreign_word(i, end)) {
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
