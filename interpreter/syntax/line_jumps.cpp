#include <algorithm>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

using namespace dialect::literals;

static bool is_no_word(const Word& word) { return word.letter == kError || word.has(Word::kMissing); }

std::uint16_t LineParser::add_jump(std::uint16_t index) {
  Instruction& added = add_instruction(InstructionKind::Jump, index);
  needs_check_ = true;
  if (line_.jump >= 0) {  // A second IF on the line: neither is alone, which is reported at the first.
    Jump ignored{.if_span = word(index).span()};
    return read_condition(ignored, index);
  }
  Jump jump;
  jump.if_span = word(index).span();
  const std::uint16_t last = read_condition(jump, index);
  // An incomplete IF: the other words on the line may be the missing part.
  if (half_jump_) added.flags |= Instruction::kReportedElsewhere;
  for (auto i = static_cast<std::uint16_t>(index + 1); i <= last; ++i) own(added, i);
  line_.jump = static_cast<std::int32_t>(store_.jumps_.size());
  store_.jumps_.push_back(jump);
  return last;
}

/// Reports a condition of another control once, from its IF to the end of the line: IF [#1 EQ 5] GOTO 10.
bool LineParser::take_foreign_jump() {
  const Span begin = store_.jumps_[static_cast<std::size_t>(line_.jump)].if_span;
  const char* const condition = skip_space(begin_ + begin.end);
  const bool has_bracket = condition != end_ && *condition == '[';
  const bool has_several = store_.findings_.size() > line_.first_finding + 1;
  const auto is_goto = [](const Word& it) { return it.letter == kGoto; };
  const Word* const words = &word(0);
  const bool has_goto = std::any_of(words, words + word_count(), is_goto);
  if ((has_goto && !has_several && !has_bracket) || !dialect::foreign_statement({begin_, line_.length})) return false;
  const Span span = hull(begin, word(word_count() - 1u).span());
  take_back_within(span);
  report("if-malformed"_diag, span);
  for (std::uint16_t i = 0; i < word_count(); ++i)
    if (word(i).begin > begin.begin && word(i).owner == Word::kNoOwner) word(i).letter = kError;
  return true;
}

/// Handles text after the label that is not a word: a malformed part of the jump, up to the end of the line (GOTO N10
/// ELSE N20). Returns the last word that belongs to the jump.
std::uint16_t LineParser::end_jump(std::uint16_t last) {
  if (take_foreign_jump()) return static_cast<std::uint16_t>(word_count() - 1);
  const auto next = static_cast<std::uint16_t>(last + 1);
  if (next >= word_count() || !store_.jumps_[static_cast<std::size_t>(line_.jump)].has_target) return last;
  if (!is_no_word(word(next))) return last;
  const Span rest = hull(word(next).span(), word(word_count() - 1u).span());
  auto& findings = store_.findings_;
  findings.erase(std::remove_if(own_findings(), findings.end(),
                                [&](const Finding& finding) { return finding.span.begin >= rest.begin; }),
                 findings.end());
  report("if-malformed/after-label"_cause, rest);
  return static_cast<std::uint16_t>(word_count() - 1);
}

/// Reads the words from IF to the label, both included. One finding for a malformed condition, else one for a malformed
/// label. Returns the last word that belongs to the jump.
std::uint16_t LineParser::read_condition(Jump& jump, std::uint16_t index) {
  std::uint16_t goto_at = index;
  while (goto_at < word_count() && word(goto_at).letter != kGoto) ++goto_at;
  const bool is_right = read_comparison(jump, static_cast<std::uint16_t>(index + 1), goto_at);
  if (!is_right) jump.variable = Jump::kUnknownVariable;
  if (goto_at == word_count()) return end_of_condition(index);
  const std::size_t findings = store_.findings_.size();
  const std::uint16_t last = read_target(jump, goto_at);
  // IF VGPL = 1 N30 GOTO: what the target lacks is in the condition.
  if (!is_right && store_.findings_.size() > findings && store_.findings_.back().id == "if-malformed"_diag)
    store_.findings_.pop_back();
  return last;
}

/// Reads the words from `at` to the GOTO: variable, operator, number. False if one of them, or the GOTO, is malformed
/// or missing, which is reported.
bool LineParser::read_comparison(Jump& jump, std::uint16_t at, std::uint16_t goto_at) {
  const auto fail = [&](char next_letter) {
    report_part(at, goto_at, next_letter);
    return false;
  };
  const bool has_operator = at + 1 < goto_at && word(at + 1u).letter == kOperator;
  if (at >= goto_at || !read_variable(jump, word(at), has_operator)) return fail(kOperator);
  ++at;
  if (at >= goto_at || word(at).letter != kOperator) return fail(kNumber);
  const auto comparison = static_cast<Comparison>(word(at).digits);
  if (comparison == Comparison::Invalid) return fail(kNumber);
  jump.comparison = comparison;
  ++at;
  if (at >= goto_at || word(at).letter != kNumber || word(at).has(Word::kMalformed)) return fail('\0');
  jump.value = word(at).value;
  ++at;
  if (goto_at < word_count()) return at == goto_at || fail('\0');
  report_half_jump(at, goto_at);
  return false;
}

/// Reports the words in the place of a required part, up to the part after it, which starts with `next_letter`, or to
/// the GOTO; without such words, an incomplete IF.
void LineParser::report_part(std::uint16_t where, std::uint16_t goto_at, char next_letter) {
  auto last = where;
  while (last < goto_at && word(last).letter != next_letter) ++last;
  if (last == where) return report_half_jump(where, goto_at);
  report("if-malformed"_diag, hull(word(where).span(), word(last - 1u).span()));
}

/// The last word of a condition without a GOTO: it ends at the first word that belongs to another instruction.
std::uint16_t LineParser::end_of_condition(std::uint16_t index) const {
  auto last = index;
  while (last + 1 < word_count()) {
    const char letter = word(last + 1u).letter;
    if (letter != kOperator && letter != kNumber && letter != kVgpl && letter != kError && letter != 'V') break;
    ++last;
  }
  return last;
}

/// The comment with a comparison between two columns of the line.
std::optional<Span> LineParser::comparison_in_comment(std::uint32_t begin, std::uint32_t end) const {
  for (std::size_t i = line_.first_comment; i < store_.comments_.size(); ++i) {
    const Span comment = store_.comments_[i];
    const std::string_view text = text_of(comment);
    if (comment.begin >= begin && comment.end <= end && text.find_first_of("=<>") != std::string_view::npos)
      return comment;
  }
  return std::nullopt;
}

/// Reports an IF that lacks a part before the word at `where`, which may be the word at `end`. Marks the text in place
/// of the missing part (THEN, a condition in parentheses), else the word after which it is missing.
void LineParser::report_half_jump(std::uint16_t where, std::uint16_t end) {
  half_jump_ = true;
  const std::uint32_t after = where < word_count() ? word(where).begin : line_.length;
  if (const std::optional<Span> comment = comparison_in_comment(word(where - 1u).end, after))
    return report("if-malformed/condition-in-comment"_cause, *comment);
  if (where == end) return report("if-malformed/incomplete"_cause, word(where - 1u).span());
  auto last = where;
  while (last + 1 < end && is_no_word(word(last)) && is_no_word(word(last + 1u))) ++last;
  report("if-malformed"_diag, hull(word(where).span(), word(last).span()));
}

/// Reads the variable: a register or VGPL. A bad register number keeps its own diagnostic (D50).
bool LineParser::read_variable(Jump& jump, const Word& written, bool has_operator) {
  jump.variable_span = written.span();
  if (written.letter == kVgpl) {
    jump.variable = Jump::kVgplVariable;
    return true;
  }
  if (written.letter != 'V' || written.has(Word::kMissing)) return false;
  if (!has_operator) return true;  // V5 1 reads as V51, but the operator is reported (E003).
  if (!written.is_plain_integer()) {
    report("invalid-register-number"_diag, written.span());
  } else if (!dialect::is_register(written.value)) {
    report("register-out-of-range"_diag, written.span(), {written.value});
  } else {
    jump.variable = static_cast<std::int8_t>(written.value);
  }
  return true;
}

/// The last word of the text in the place of a label that is none: N4O, LABEL, NV1, "N40".
std::uint16_t LineParser::end_of_target(std::uint16_t index) const {
  while (index + 1 < word_count()) {
    const Word& next = word(index + 1u);
    const bool is_number = next.letter == 'V' && word(index).has(Word::kMissing);
    const bool is_quoted = next.letter == 'N' && word(index).letter == kError;
    if (!is_no_word(next) && !is_number && !is_quoted) break;
    ++index;
  }
  return index;
}

/// Reports the text in the place of a label that is none. Returns its last word.
std::uint16_t LineParser::report_target(std::uint16_t index) {
  const std::uint16_t last = end_of_target(index);
  const Span target = hull(word(index).span(), word(last).span());
  take_back_within(target);
  report("if-malformed/label"_cause, target);
  return last;
}

/// Reads the label after the GOTO at `index`. A target that is none leaves open where the jump leads (D63).
std::uint16_t LineParser::read_target(Jump& jump, std::uint16_t index) {
  const auto at = static_cast<std::uint16_t>(index + 1);
  if (at >= word_count() || word(at).letter == 'G' || word(at).letter == kIf) {
    half_jump_ = true;
    report("if-malformed/incomplete"_cause, word(index).span());
    return index;
  }
  const Word& label = word(at);
  if (label.letter != 'N' || !label.is_plain_integer()) return report_target(at);
  jump.has_target = true;
  jump.target = label_of(label);
  jump.target_span = label.span();
  return at;
}

/// Takes back the finding at a letter before VGPL or a V, where a GOTO follows: F VGPL = 1, for IF.
void LineParser::take_back_half_if(std::uint16_t index) {
  for (std::uint16_t i = 0; i + 1 < index; ++i)
    if (word(i).has(Word::kMissing) && (word(i + 1u).letter == kVgpl || word(i + 1u).letter == 'V'))
      take_back("word-without-number"_diag, word(i).span());
}

/// Handles a GOTO without IF, or a second GOTO on the line, which is reported at the first: it must be alone. Its
/// target, right or wrong, belongs to the same mistake.
std::uint16_t LineParser::add_lone_goto(std::uint16_t index) {
  if (line_.jump < 0) {
    take_back_half_if(index);
    const auto is_of_condition = [&](const Word& it) {
      return it.letter == kVgpl ||
             (it.letter == kError && text::char_class(begin_[it.begin]) == text::CharClass::Compare);
    };
    for (std::uint16_t i = 0; i < index; ++i)  // V5 > 30 GOTO N340: the IF is missing.
      if (is_of_condition(word(i))) take_back("unknown-word"_diag, word(i).span());
    report("if-malformed/goto-alone"_cause, word(index).span());
  }
  const auto at = static_cast<std::uint16_t>(index + 1);
  if (at >= word_count()) return index;
  const char letter = word(at).letter;
  if (letter != 'N' && letter != kNumber && !is_no_word(word(at))) return index;
  const bool is_label = letter == 'N' && word(at).is_plain_integer();
  const std::uint16_t last = is_label ? at : end_of_target(at);
  if (!is_label) take_back_within(hull(word(at).span(), word(last).span()));
  return last;
}

}  // namespace isocnc::syntax
