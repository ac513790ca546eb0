#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/syntax/number.h"
#include "interpreter/text/unicode.h"

namespace isocnc::syntax {

using namespace dialect::literals;

LineParser::LineParser(TreeStore& store, const char* begin, const char* end) : store_(store), begin_(begin), end_(end) {
  line_.first_word = static_cast<std::uint32_t>(store.words_.size());
  line_.first_instruction = static_cast<std::uint32_t>(store.instructions_.size());
  line_.first_comment = static_cast<std::uint32_t>(store.comments_.size());
  line_.first_finding = static_cast<std::uint32_t>(store.findings_.size());
}

const char* LineParser::lex() {
  const char* p = begin_;
  while (p != end_) {
    switch (text::char_class(*p)) {
      case text::CharClass::Blank:
        ++p;
        break;
      case text::CharClass::Letter:
        p = lex_word(p);
        break;
      case text::CharClass::LineEnd:
        return p;
      case text::CharClass::Digit:
      case text::CharClass::NumberSign:
        p = lex_number_alone(p);
        break;
      case text::CharClass::Open:
        p = lex_comment(p);
        break;
      case text::CharClass::Semicolon: {
        const char* const line_end = text::find_line_end(p, end_);
        store_.comments_.push_back({column(p), column(line_end)});
        return line_end;
      }
      case text::CharClass::Close:
        drop_comment_text();
        report("unopened-comment"_diag, {column(p), column(p) + 1});
        ++p;
        break;
      case text::CharClass::Equals:
        p = lex_equals(p);
        break;
      case text::CharClass::Compare:
        p = in_condition_ ? lex_comparison(p) : lex_unknown(p);
        break;
      case text::CharClass::Other:
        p = lex_unknown(p);
        break;
    }
    if (word_count() >= kMaxWords) {
      const char* const line_end = text::find_line_end(p, end_);
      line_.flags |= LineTree::kCut;
      report("line-too-long"_diag, {column(p), column(line_end)}, {static_cast<double>(kMaxWords)});
      return line_end;
    }
  }
  return p;
}

Word& LineParser::add_word(char letter, const char* begin, const char* end) {
  Word& added = store_.words_.push_back(Word{});
  added.letter = letter;
  added.begin = column(begin);
  added.end = column(end);
  added.owner = Word::kNoOwner;
  return added;
}

static_assert(Number::kSigned == Word::kSigned && Number::kPoint == Word::kPoint &&
              Number::kMalformed == Word::kMalformed);

Word& LineParser::add_word(char letter, const char* begin, const Number& number) {
  Word& added = add_word(letter, begin, number.end);
  added.value = number.value;
  added.digits = number.digits;
  added.flags = number.flags;
  return added;
}

/// Ends the condition after a GOTO, once the label, or the text in its place, has been read.
void LineParser::end_target() {
  if (after_goto_) in_condition_ = after_goto_ = false;
}

/// Whether a malformed number of this letter has a diagnostic of its own (D9, D12, D49).
static bool has_own_code(char letter) { return dialect::contains(dialect::letters("GMNTV"), letter); }

const char* LineParser::lex_word(const char* start) {
  const char* p = start + 1;
  while (p != end_ && text::is_blank(*p)) ++p;
  return p != end_ && text::is_number_char(*p) ? lex_with_number(start, p) : lex_without_number(start, p);
}

/// Reads a letter and the number at `p`, with blanks or comments between them.
const char* LineParser::lex_with_number(const char* start, const char* p) {
  const Number number = scan_number(p, end_);
  const char letter = text::upper(*start);
  if (number.has(Number::kMalformed) && !in_condition_) {
    const char* const after = number.digits == 0 ? lex_formula(start, number.end) : lex_corner(start, p, number.end);
    if (after) return after;
  }
  add_word(letter, start, number);
  if (number.has(Number::kMalformed) && !in_condition_ && !has_own_code(letter)) report_number(p, number.end);
  if (p != start + 1 || number.has_more_inside(p)) note_comments_inside(start, number.end);
  end_target();
  return number.end;
}

/// The start of the number after a sign that only looks like a minus (D67); null if there is no such number.
const char* LineParser::digits_of_foreign_minus(const char* p) const {
  if (p == end_ || text::char_class(*p) != text::CharClass::Other) return nullptr;
  const std::size_t length = text::foreign_minus_length({p, static_cast<std::size_t>(end_ - p)});
  const char* const digits = skip_space(p + length);
  const bool is_number = length > 0 && digits != end_ && (text::is_digit(*digits) || *digits == '.');
  return is_number ? digits : nullptr;
}

/// Reads a word whose number has a sign at `minus` that only looks like a minus. The number is what it looks like.
const char* LineParser::lex_with_foreign_minus(char letter, const char* start, const char* minus) {
  const Number number = scan_number(digits_of_foreign_minus(minus), end_);
  Word& added = add_word(letter, start, number);
  added.value = 0.0 - added.value;
  added.flags |= Word::kSigned | Word::kReported;
  report("unknown-word/foreign-minus"_cause, {column(minus), column(number.end)});
  note_comments_inside(start, number.end);
  return number.end;
}

void LineParser::report_number(const char* begin, const char* end) {
  const bool has_comma = std::find(begin, end, ',') != end;
  report(has_comma ? "malformed-number"_diag : "malformed-number/shape"_cause, {column(begin), column(end)});
}

/// Reads a keyword, a letter with a comment before its number, or a letter without a number.
const char* LineParser::lex_without_number(const char* start, const char* p) {
  const char letter = text::upper(*start);
  const char* const after = skip_space(p);
  if (after != end_ && text::is_number_char(*after)) return lex_with_number(start, after);  // X(comment)10
  if (!in_condition_ && digits_of_foreign_minus(after)) return lex_with_foreign_minus(letter, start, after);
  if (const char* end = lex_keyword(start, letter)) return end;
  if (const char* const end = in_condition_ ? nullptr : lex_formula(start, after)) return end;
  Word& added = add_word(letter, start, start + 1);
  added.value = std::numeric_limits<double>::quiet_NaN();
  added.flags = Word::kMissing;
  has_prose_ = true;
  // Before a `=` the value is given in a wrong form (ISO058); inside a condition, E003 reports the error.
  const bool assigned = after != end_ && *after == '=' && letter != 'V';
  if (!in_condition_ && !assigned) report_letter_alone(start, after);
  end_target();
  return start + 1;
}

/// Whether a character is a letter that looks like a digit: O like 0, L like 1.
static bool looks_like_digit(char c) { return text::upper(c) == 'O' || text::upper(c) == 'L'; }

/// Reports the letter at `start`, which has no number; `after` is what follows it.
void LineParser::report_letter_alone(const char* start, const char* after) {
  const Span letter{column(start), column(start) + 1};
  if (after == end_ || !looks_like_digit(*after)) return report("word-without-number"_diag, letter);
  report("word-without-number/letter-for-digit"_cause, letter, {}, {column(after), column(after) + 1});
}

/// The maximum length of a formula, so that a line with many open brackets is not searched to its end for each.
static constexpr std::ptrdiff_t kLongestFormula = 1'000;

/// The end of a formula of other controls: #1, #<name>, [#1+5], Q1. Null where there is none.
const char* LineParser::end_of_formula(const char* p) const {
  while (p != end_ && *p == '#') ++p;
  if (p != end_ && (*p == '[' || *p == '<')) {
    const char close = *p == '[' ? ']' : '>';
    int depth = 0;
    const char* const limit = end_ - p > kLongestFormula ? p + kLongestFormula : end_;
    for (; p != limit && !text::is_line_end(*p) && *p != ';'; ++p) {
      depth += *p == '[' || *p == '<' ? 1 : 0;
      depth -= *p == ']' || *p == '>' ? 1 : 0;
      if (*p == close && depth == 0) return p + 1;
    }
    return nullptr;
  }
  if (p != end_ && text::upper(*p) == 'Q') ++p;
  const char* const digits = p;
  while (p != end_ && text::is_digit(*p)) ++p;
  return p == digits ? nullptr : p;
}

/// Reads a letter whose number other controls compute, at `p`: X#1, Z-#100, X[#1+5], X+Q1. One finding for all of the
/// line. Null where there is no formula.
const char* LineParser::lex_formula(const char* start, const char* p) {
  p = skip_space(p);
  if (p == end_ || (*p != '#' && *p != '[' && text::upper(*p) != 'Q')) return nullptr;
  const char* const end = end_of_formula(p);
  if (!end) return nullptr;
  Word& letter = add_word(text::upper(*start), start, start + 1);
  letter.value = std::numeric_limits<double>::quiet_NaN();
  letter.flags = Word::kMissing;
  if (!std::exchange(has_formula_, true)) report("word-without-number"_diag, letter.span());
  Word& formula = add_word(kError, p, end);
  formula.value = std::numeric_limits<double>::quiet_NaN();
  formula.flags = Word::kReported;
  return end;
}

/// Reads a letter whose number, at `p`, is followed by the chamfer or rounding of other controls: X10 ,C2 and X10,R2.
/// Null where there is none; X10, R2 has a comma too many.
const char* LineParser::lex_corner(const char* start, const char* p, const char* number_end) {
  const char* const comma = number_end - 1;
  const char* const corner = skip_space(number_end);
  const bool is_separator = corner != number_end && !text::is_blank(*(comma - 1));
  if (*comma != ',' || is_separator || corner == end_) return nullptr;
  const char letter = text::upper(*corner);
  const char* const size = skip_space(corner + 1);
  if ((letter != 'C' && letter != 'R') || size == end_ || !text::is_number_char(*size)) return nullptr;
  const Number number = scan_number(p, comma);
  if (number.has(Number::kMalformed)) return nullptr;
  add_word(text::upper(*start), start, number);
  const char* const end = scan_number(size, end_).end;
  Word& added = add_word(letter, corner, end);
  added.value = std::numeric_limits<double>::quiet_NaN();
  added.flags = Word::kMalformed | Word::kReported;
  report("unknown-word"_diag, {column(comma), column(end)});
  return end;
}

/// Reads IF, GOTO and VGPL. They cannot be words: I and V are followed by a letter here, and O does not start a word.
const char* LineParser::lex_keyword(const char* p, char letter) {
  if (letter == 'G') {
    const char* const end = match_keyword(p, "GOTO");
    if (!end) return nullptr;
    add_word(kGoto, p, end);
    note_comments_inside(p, end);
    in_condition_ = after_goto_ = true;
    return end;
  }
  if (letter == 'V') {
    const char* const end = match_keyword(p, "VGPL");
    if (!end) return nullptr;
    add_word(kVgpl, p, end);
    note_comments_inside(p, end);
    return end;
  }
  if (letter == 'I') {
    const char* const end = match_keyword(p, "IF");
    if (!end) return nullptr;
    const char* const next = skip_space(end);
    const bool may_be_text = (next != end_ && text::is_number_char(*next)) || ends_in_text();
    if (may_be_text && !goto_follows(next)) return nullptr;  // I F2000, ENDIF
    add_word(kIf, p, end);
    note_comments_inside(p, end);
    in_condition_ = true;
    return end;
  }
  return nullptr;
}

/// Whether the words so far end in letters without numbers, or in text that is no word.
bool LineParser::ends_in_text() const {
  if (word_count() == 0) return false;
  const Word& last = word(word_count() - 1u);
  return last.letter == kError || last.has(Word::kMissing);
}

const char* LineParser::match_keyword(const char* p, const char* keyword) const {
  const char* after = nullptr;
  for (; *keyword != '\0'; ++keyword) {
    p = skip_space(p);
    if (p == end_ || text::upper(*p) != *keyword) return nullptr;
    after = ++p;
  }
  return after;
}

bool LineParser::goto_follows(const char* p) {
  if (!last_goto_) {  // One search per line, however many IFs it has.
    last_goto_ = begin_;
    for (const char* at = p; at != end_ && !text::is_line_end(*at) && *at != ';'; ++at)
      if (text::upper(*at) == 'G' && match_keyword(at, "GOTO")) last_goto_ = at;
  }
  return last_goto_ > p;
}

const char* LineParser::skip_space(const char* p) const { return text::skip_space(p, end_); }

/// Records the comments between the characters of one word.
void LineParser::note_comments_inside(const char* p, const char* end) {
  for (; p < end; ++p) {
    if (*p != '(') continue;
    const char* const open = p;
    while (*p != ')') ++p;
    store_.comments_.push_back({column(open), column(p) + 1});
  }
}

const char* LineParser::lex_comment(const char* p) {
  if (const char* const after = text::skip_closed_comment(p, end_)) {
    store_.comments_.push_back({column(p), column(after)});
    return after;
  }
  const char* const line_end = text::find_line_end(p, end_);
  store_.comments_.push_back({column(p), column(line_end)});
  // X(10: the number of the X may be in the comment.
  if (word_count() > 0 && word(word_count() - 1u).has(Word::kMissing))
    take_back("word-without-number"_diag, word(word_count() - 1u).span());
  report("unclosed-comment"_diag, {column(p), column(line_end)});
  line_.flags |= LineTree::kUnclosed;
  return line_end;
}

/// Removes the malformed words before a lone `)`, which were meant as a comment: one finding, not one for each letter.
void LineParser::drop_comment_text() {
  std::uint32_t begin = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t prose = 0; (prose = prose_at_end({store_.words_.data() + line_.first_word, word_count()})) > 0;) {
    for (; prose > 0; --prose) {
      begin = store_.words_.back().begin;
      store_.words_.pop_back();
    }
  }
  while (store_.findings_.size() > line_.first_finding && store_.findings_.back().span.begin >= begin)
    store_.findings_.pop_back();
}

const char* LineParser::lex_number_alone(const char* p) {
  const Number number = scan_number(p, end_);
  note_comments_inside(p, number.end);
  Word& added = add_word(kNumber, p, number);
  if (in_condition_) {
    end_target();
  } else if (number.digits == 0) {
    added.letter = kError;
    report("unknown-word/no-digits"_cause, added.span());
  } else {
    report("number-without-letter"_diag, added.span());
  }
  return number.end;
}

const char* LineParser::lex_equals(const char* p) {
  if (in_condition_ && !after_goto_) return lex_comparison(p);
  const char* const at = skip_space(p + 1);
  if (digits_of_foreign_minus(at)) return lex_with_foreign_minus(kAssign, p, at);
  if (at == end_ || !text::is_number_char(*at)) {
    Word& added = add_word(kAssign, p, p + 1);
    added.value = std::numeric_limits<double>::quiet_NaN();
    added.flags = Word::kMissing;
    return p + 1;
  }
  const Number number = scan_number(at, end_);
  add_word(kAssign, p, number);
  if (number.has(Number::kMalformed)) report_number(at, number.end);
  note_comments_inside(p, number.end);
  return number.end;
}

static Comparison comparison_of(std::string_view text) {
  if (text == "=") return Comparison::Equal;
  if (text == "<>") return Comparison::NotEqual;
  if (text == "<") return Comparison::Less;
  if (text == "<=") return Comparison::LessEqual;
  if (text == ">") return Comparison::Greater;
  if (text == ">=") return Comparison::GreaterEqual;
  return Comparison::Invalid;
}

const char* LineParser::lex_comparison(const char* p) {
  const char* const start = p;
  const char* after = p;
  char text[3] = {};
  std::size_t length = 0;
  while (p != end_ && (text::char_class(*p) == text::CharClass::Compare || *p == '=')) {
    if (length < sizeof text) text[length] = *p;
    ++length;
    after = ++p;
    p = skip_space(p);
  }
  note_comments_inside(start, after);
  Word& added = add_word(kOperator, start, after);
  added.digits = static_cast<std::uint32_t>(length > 2 ? Comparison::Invalid : comparison_of({text, length}));
  return after;
}

/// What unknown text does to the number of the last word: it is in its place (G#1, MO6), which has been reported, or
/// continues it (X1O, X1L, X1E5), which makes that number unknown.
LineParser::BesideNumber LineParser::garble_number(char first) {
  using enum BesideNumber;
  if (word_count() == 0) return No;
  Word& before = word(word_count() - 1u);
  const bool is_word = before.letter >= 'A' && before.letter <= 'Z';
  if (is_word && before.has(Word::kMissing)) return InItsPlace;
  if (first == ']' && word_count() > 1 && begin_[word(word_count() - 2u).begin] == '[') return InItsPlace;  // X[V1]
  const bool is_code = dialect::contains(dialect::letters("GMN"), before.letter);  // No exponent: GOTO N10 ELSE.
  const bool is_apart = text::is_blank(begin_[before.end]);
  const bool reads_as_digit = looks_like_digit(first) && !(first == 'L' && is_apart);  // G10 L2: of other controls.
  if (is_word && reads_as_digit && before.digits == 0 && before.has(Word::kMalformed)) return InItsPlace;  // X-O.5
  if ((!is_word && before.letter != kAssign) || (!reads_as_digit && (first != 'E' || is_code))) return No;
  before.value = std::numeric_limits<double>::quiet_NaN();
  before.flags |= Word::kMalformed | Word::kReported;
  return Continues;
}

/// The cause of text that is no word.
static dialect::Cause cause_of_unknown(std::string_view text, bool continues_number) {
  const auto compares = [](char c) {
    const text::CharClass cls = text::char_class(c);
    return cls == text::CharClass::Compare || text::is_blank(c) || text::is_number_char(c);
  };
  if (std::all_of(text.begin(), text.end(), compares)) return "unknown-word/outside-if"_cause;
  if (continues_number && looks_like_digit(text.front())) return "unknown-word/letter-for-digit"_cause;
  return "unknown-word"_diag;
}

/// Whether text is U or W with a number, as the word before it: increments of other controls, which have one finding.
bool LineParser::continues_increments(const char* start, const char* end) {
  const auto is_increment = [&](const char* letter, const char* after) {
    const bool is_letter = text::upper(*letter) == 'U' || text::upper(*letter) == 'W';
    return is_letter && after != letter + 1 && text::is_number_char(*(after - 1));
  };
  if (word_count() == 0 || word(word_count() - 1u).letter != kError || store_.findings_.size() == line_.first_finding)
    return false;
  Word& before = word(word_count() - 1u);
  Finding& finding = store_.findings_.back();
  if (!is_increment(begin_ + before.begin, begin_ + before.end) || !is_increment(start, end)) return false;
  if (finding.span != before.span()) return false;
  before.end = finding.span.end = column(end);
  return true;
}

/// One finding for a series of characters that do not start a word, together with the number after them (D10).
const char* LineParser::lex_unknown(const char* p) {
  if (in_condition_ && !after_goto_ && digits_of_foreign_minus(p)) return lex_with_foreign_minus(kNumber, p, p);
  const char* const start = p;
  const char* after = p;
  for (;;) {
    p = skip_space(after);
    if (p == end_) break;
    const text::CharClass cls = text::char_class(*p);
    if (cls != text::CharClass::Other && (cls != text::CharClass::Compare || in_condition_)) break;
    after = p + 1;
  }
  Number number;
  if (p != end_ && text::is_number_char(*p)) {
    number = scan_number(p, end_);
    after = number.end;
    const char* const close = skip_space(after);
    if (*start == '[' && close != end_ && *close == ']') after = close + 1;  // [10]
  }
  note_comments_inside(start, after);
  has_prose_ = true;
  const BesideNumber beside = in_condition_ ? BesideNumber::No : garble_number(text::upper(*start));
  if (!in_condition_ && continues_increments(start, after)) return after;
  Word& added = add_word(kError, start, after);
  added.value = number.value;
  added.digits = number.digits;
  added.flags = number.flags;
  if (!in_condition_ && beside != BesideNumber::InItsPlace)
    report(
        cause_of_unknown(text_of(added.span()), beside == BesideNumber::Continues && text::is_number_char(start[-1])),
        added.span());
  end_target();
  return after;
}

}  // namespace isocnc::syntax
