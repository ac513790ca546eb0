#include <algorithm>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

const char* LineParser::parse() {
  const char* const end = lex();
  line_.length = column(end);
  structure();
  if (needs_check_) check();
  if (other_numbers_ == 1) find_two_blocks();
  if (has_prose_) drop_block_end();
  line_.words = word_count();
  line_.instructions = static_cast<std::uint16_t>(instruction_count());
  line_.comments = static_cast<std::uint32_t>(store_.comments_.size() - line_.first_comment);
  line_.findings = static_cast<std::uint32_t>(store_.findings_.size() - line_.first_finding);
  if (line_.findings > 1)
    std::stable_sort(own_findings(), store_.findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.span.begin < b.span.begin; });
  store_.lines_.push_back(line_);
  return end;
}

void LineParser::report(dialect::Cause cause, Span span, std::initializer_list<double> values, Span related) {
  const bool is_reported = store_.findings_.size() > line_.first_finding && store_.findings_.back().id == cause.id &&
                           store_.findings_.back().span == span;
  if (is_reported) return;  // Two checks may find the same error (IF IF).
  store_.findings_.push_back(finding_of(cause, span, values, related));
}

/// Removes a finding, where one mistake has been reported twice.
void LineParser::take_back(dialect::DiagnosticId id, Span span) {
  auto& findings = store_.findings_;
  findings.erase(std::remove_if(own_findings(), findings.end(),
                                [&](const Finding& finding) { return finding.id == id && finding.span == span; }),
                 findings.end());
}

void LineParser::take_back_within(Span span) {
  auto& findings = store_.findings_;
  const auto is_within = [&](const Finding& it) { return it.span.begin >= span.begin && it.span.end <= span.end; };
  findings.erase(std::remove_if(own_findings(), findings.end(), is_within), findings.end());
}

/// Reports a missing word, unless a comment is not closed: the word may be in it, and the comment has been reported.
void LineParser::report_missing(dialect::Cause cause, const Instruction& lacking, Span related) {
  if ((line_.flags & LineTree::kUnclosed) == 0) report(cause, word(lacking.command).span(), {}, related);
}

void LineParser::structure() {
  const bool is_statement = (has_prose_ || starts_with_unknown_g()) && take_statement();
  if (has_prose_ && !is_statement) join_prose();
  for (std::uint16_t i = 0; i < word_count(); ++i) i = add(i);
}

/// Adds a word to the instructions. Returns the last word that has been added with it.
std::uint16_t LineParser::add(std::uint16_t index) {
  const char letter = word(index).letter;
  if (contains(dialect::kDimensionLetters, letter)) {
    add_dimension(index);
    after_motion_ = true;
    return index;
  }
  switch (letter) {
    case 'F':
      add_feed(index);  // The motion's speed does not break the series (D17).
      return index;
    case 'G':
      // GG01: the first G has been reported, because it has no number.
      if (index + 1 < word_count() && word(index + 1u).letter == 'G' && word(index).has(Word::kMissing)) return index;
      add_g(index);
      return index;
    case kAssign:
      return add_equals(index);
    case kVgpl:
      if (!precedes_if(index)) report("unknown-word/outside-if"_cause, word(index).span());
      return index;
    case kError:
      if (is_taken_by_unknown_g(index) || is_taken_by_call(index)) take_back("unknown-word"_diag, word(index).span());
      return index;
    default:
      return add_between_series(index);
  }
}

/// Adds a word that belongs to no argument series, and so breaks the one before it (D12, D17). A word that has been
/// reported does not: X25S Y5.
std::uint16_t LineParser::add_between_series(std::uint16_t index) {
  const char letter = word(index).letter;
  const bool is_letter_alone = word(index).has(Word::kMissing);
  bool is_taken = false;
  std::uint16_t last = index;
  switch (letter) {
    case 'N':
      if (!add_line_number(index)) return index;
      break;
    case 'S':
      add_spindle_speed(index);
      break;
    case 'M':
      add_m(index);
      break;
    case 'T':
      if (is_in_series(index)) {
        check_tool_number(word(index));
        return index;
      }
      is_taken = word(index).owner != Word::kNoOwner && !follows_letter_of(index, 'M');
      add_tool(index);
      if (is_taken) return index;  // M06 G00 T101001 X1: reported at the M06.
      break;
    case 'V':
      if (stands_for_number(index)) return index;
      last = add_assignment(index);
      break;
    case kIf:
      last = end_jump(add_jump(index));
      break;
    case kGoto:
      last = add_lone_goto(index);
      break;
    default:
      return index;
  }
  if (letter != 'N' && letter != kGoto) after_motion_ &= is_letter_alone;
  if (is_letter_alone) return last;
  contiguous_ = false;
  if (letter != 'M') function_open_ = false;
  return last;
}

/// N10 G00 X5 N20 G01 X9: two blocks whose line break is lost. The line has no finding but that at the second number,
/// if each block has none by itself (D68).
void LineParser::find_two_blocks() {
  const Span second = word(static_cast<std::size_t>(second_number_)).span();
  const auto is_block = [&](Span span) {
    const ParsedLine parsed(text_of(span));
    return parsed.tree().findings.empty() && !parsed.tree().is_empty();
  };
  if (!is_block({0, second.begin}) || !is_block({second.begin, line_.length})) return;
  take_back_within({0, line_.length});
  report("invalid-line-number/second"_cause, second);
  line_.flags = LineTree::kHasLabel | LineTree::kTwoBlocks;
}

/// Whether the word before is this letter, without a number.
bool LineParser::follows_letter(std::uint16_t index, char letter) const {
  return index > 0 && word(index - 1u).letter == letter && word(index - 1u).has(Word::kMissing);
}

/// Whether the word before has this letter.
bool LineParser::follows_letter_of(std::uint16_t index, char letter) const {
  return index > 0 && word(index - 1u).letter == letter;
}

/// Whether unknown text belongs to the unknown G before it, which has been reported (G43 H1). Text inside the number of
/// that G does not (G5O).
bool LineParser::is_taken_by_unknown_g(std::uint16_t index) const {
  if (taker_ == kNone || !contiguous_) return false;
  const bool is_in_number = taker().command + 1 == index && word(taker().command).has(Word::kMalformed);
  return taker().is_unknown_g() && !is_in_number;
}

/// Whether an IF follows the word: VGPL IF = 1. The IF is reported.
bool LineParser::precedes_if(std::uint16_t index) const {
  return index + 1 < word_count() && word(index + 1u).letter == kIf;
}

/// Whether unknown text is the count of a call of other controls (M98 P1000 L2), which has been reported at the P.
bool LineParser::is_taken_by_call(std::uint16_t index) const {
  return function_open_ && index > 0 && word(index - 1u).letter == 'P' && text::upper(begin_[word(index).begin]) == 'L';
}

/// Whether a `=` follows the word.
bool LineParser::is_assigned(std::uint16_t index) const {
  return index + 1 < word_count() && word(index + 1u).letter == kAssign;
}

/// Whether a register is in the place of a number (X V1), which has been reported at the X.
bool LineParser::stands_for_number(std::uint16_t index) const {
  return index > 0 && word(index - 1u).has(Word::kMissing) && !is_assigned(index) &&
         contains(dialect::kDimensionLetters | dialect::letters("FS"), word(index - 1u).letter);
}

Instruction& LineParser::add_instruction(InstructionKind kind, std::uint16_t command) {
  const auto number = static_cast<std::uint16_t>(instruction_count());
  Instruction& added = store_.instructions_.push_back(Instruction{});
  added.kind = kind;
  added.number = number;
  added.command = command;
  added.begin = command;
  added.end = static_cast<std::uint16_t>(command + 1);
  const auto is_silent = [](const Word& before) {
    return before.letter == 'N' || before.letter == kError || before.letter == kNumber;
  };
  std::uint16_t first = 0;
  while (first < command && is_silent(word(first))) ++first;
  if (first == command) added.flags = Instruction::kFirst;
  word(command).owner = number;
  needs_check_ |= number > 0;
  return added;
}

void LineParser::own(Instruction& owner, std::uint16_t index) {
  word(index).owner = owner.number;
  owner.begin = std::min(owner.begin, index);
  owner.end = std::max<std::uint16_t>(owner.end, static_cast<std::uint16_t>(index + 1));
}

}  // namespace isocnc::syntax
