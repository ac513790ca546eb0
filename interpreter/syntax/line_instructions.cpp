#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "interpreter/dialect/near_codes.h"
#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/hash.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

void LineParser::add_dimension(std::uint16_t index) {
  if (follows_letter(index, 'V') && is_assigned(index)) return;  // VI=5: reported at the V.
  if (is_parameter(index) || is_foreign_parameter(index)) {
    own(instruction(static_cast<std::size_t>(function_)), index);
    needs_check_ = true;
    return;
  }
  // P1=1 P2=4.5 without an M: parameters that belong to no instruction are reported once, together.
  if (word(index).letter == 'P' && taker_ == kNone && line_.jump < 0 && is_assigned(index)) return;
  function_open_ = false;
  // The arguments of an unknown G end with its series.
  if (taker_ != kNone && !contiguous_ && taker().is_unknown_g()) taker_ = kNone;
  if (taker_ == kNone) start_continuation(index);
  if (!contiguous_) {
    word(index).flags |= Word::kBreak;
    needs_check_ = true;
  }
  take_argument(index);
}

/// Whether a word is a parameter of the last M: M100 P1=2.5.
bool LineParser::is_parameter(std::uint16_t index) const {
  return word(index).letter == 'P' && function_ != kNone && (function_open_ || is_assigned(index));
}

/// Whether a Q follows a parameter without value, as other controls write both: M101 P1 Q2. Reported at the P.
bool LineParser::is_foreign_parameter(std::uint16_t index) const {
  if (word(index).letter != 'Q' || !function_open_) return false;
  std::uint16_t before = index;
  while (before > 0 && word(before - 1u).letter == kError) --before;
  return before > 0 && word(before - 1u).letter == 'P' && word(before - 1u).owner != Word::kNoOwner;
}

void LineParser::start_continuation(std::uint16_t index) {
  after_unknown_ = index > 0 && word(index - 1u).letter == kError;
  taker_ = add_instruction(InstructionKind::Continuation, index).number;
  taken_ = 0;
  contiguous_ = true;
  dimensions_seen_ = true;
}

/// Gives a word to the instruction that takes the next argument.
void LineParser::take_argument(std::uint16_t index) {
  const char letter = word(index).letter;
  // L X10 R0: arguments of another control's motion.
  const bool is_of_unknown =
      after_unknown_ && taker().kind == InstructionKind::Continuation && !contains(dialect::kCoordinateLetters, letter);
  if (is_of_unknown) word(index).flags |= Word::kReported;
  if (contains(taken_, letter) && !follows_letter(index, letter)) make_repeated_unknown(taker(), index);
  taken_ |= dialect::letter_bit(letter);
  own(taker(), index);
}

/// Handles a letter that the instruction has already. It is unclear which of the two was meant: the axis becomes
/// unknown, so that no second finding follows.
void LineParser::make_repeated_unknown(const Instruction& owner, std::uint16_t index) {
  Word& repeated = word(index);
  Span first;
  bool is_earlier = false;  // The first one is before the instruction's G.
  for (std::uint16_t i = owner.begin; i < index; ++i) {
    if (word(i).owner != owner.number || word(i).letter != repeated.letter) continue;
    if (first.empty()) first = word(i).span();
    is_earlier |= i < owner.command;
    word(i).value = std::numeric_limits<double>::quiet_NaN();
  }
  // In R1=1 R2=2 the number has been reported, in Z5 G01 Z-2 the first Z; so the repetition is not.
  const bool is_reported = is_assigned(index) || is_earlier || repeated.has(Word::kMissing | Word::kMalformed) ||
                           !starts_second_block(index);
  repeated.value = std::numeric_limits<double>::quiet_NaN();
  repeated.flags |= Word::kReported;
  if (!is_reported) report("repeated-argument"_diag, repeated.span(), {}, first);
}

/// Whether a word that the line has already is the first such word, so that it is reported. Those after it are the rest
/// of the block that it starts, after a lost line break (G00 X1 Y2X3 Y4), unless this block has them twice as well.
bool LineParser::starts_second_block(std::uint16_t index) {
  if (second_block_ == kNone) {
    second_block_ = index;
    return true;
  }
  for (auto i = static_cast<std::size_t>(second_block_); i < index; ++i)
    if (word(i).letter == word(index).letter && (word(i).letter != 'G' || is_motion_g(word(i)))) return true;
  return false;
}

bool LineParser::is_motion_g(const Word& g) const {
  return g.owner != Word::kNoOwner && instruction(g.owner).is_motion();
}

/// The number meant by a misspelled but clear word, such as G1.0, M+6 or G-1; otherwise NaN.
static double meant_number(double value, double minimum) {
  const double number = std::abs(value);
  const bool is_plain = number >= minimum && number <= 999 && number == std::floor(number);
  return is_plain ? number : std::numeric_limits<double>::quiet_NaN();
}

void LineParser::add_g(std::uint16_t index) {
  const std::uint8_t row = row_of_g(index);
  Instruction& added = add_instruction(InstructionKind::G, index);
  added.row = row;
  if (after_motion_) added.flags |= Instruction::kFollowsMotion;
  after_motion_ = false;
  function_open_ = false;
  contiguous_ = false;
  needs_check_ = true;
  const dialect::GCode* const code = added.g();
  if (code) note_g(*code, index);
  if (code && !code->takes_arguments()) return;
  const bool has_dimensions = code && code->role != dialect::GRole::Dwell;
  if (has_dimensions && taker_ != kNone && taker().kind == InstructionKind::Continuation) {
    take_earlier_words(added);
  } else {
    taken_ = 0;
  }
  taker_ = added.number;
  contiguous_ = true;
  dimensions_seen_ |= has_dimensions;
}

/// Whether a G98 or G99 belongs to a drilling cycle of the line, where all of it is reported.
bool LineParser::belongs_to_cycle(std::uint16_t index) const {
  const auto is_cycle = [](const Word& it) { return it.letter == 'G' && dialect::is_drilling_cycle(it.value); };
  if (word(index).value != 98 && word(index).value != 99) return false;
  for (std::uint16_t i = 0; i < word_count(); ++i)
    if (is_cycle(word(i))) return true;
  return false;
}

/// The row of a G, also of one that is misspelled but clear. Reports what is wrong with its number.
std::uint8_t LineParser::row_of_g(std::uint16_t index) {
  Word& written = word(index);
  const double meant = meant_number(written.value, 0);
  const std::uint8_t row =
      std::isnan(meant) ? dialect::kUnknownGCode : dialect::kGCodeRows[static_cast<std::size_t>(meant)];
  if (written.is_plain_integer() && written.value <= 999) {
    if (row == dialect::kUnknownGCode && !belongs_to_cycle(index)) report("unsupported-g"_diag, written.span());
    return row;
  }
  if (!written.has(Word::kMissing | Word::kReported)) report("invalid-g-number"_diag, written.span());
  written.flags |= Word::kReported;
  return row;
}

/// Notes what later words and checks must know of a G: a motion, or a mode after dimensions (D15).
void LineParser::note_g(const dialect::GCode& code, std::uint16_t index) {
  if (code.is_motion()) {
    after_motion_ = true;
    if (++motions_ == 1) {
      first_motion_ = word(index).span();
    } else if (starts_second_block(index)) {
      report("second-motion"_diag, word(index).span(), {}, first_motion_);
      misplaced_count_ = 0;  // G00 X5 G91 G01 X9: the mode is before the second motion.
    }
  }
  if (code.misplaced != dialect::kNoDiagnostic && dimensions_seen_ && misplaced_count_ < std::size(misplaced_))
    misplaced_[misplaced_count_++] = index;
}

/// Handles `X10 G1`: arguments must follow their G (D16). One finding; the words count as arguments of the G.
void LineParser::take_earlier_words(Instruction& g) {
  Instruction& earlier = taker();
  bool reported = false;
  for (std::uint16_t i = earlier.begin; i < earlier.end; ++i) {
    if (word(i).owner != earlier.number || word(i).letter == kError) continue;  // P1 M3=13 G01 X10
    if (!reported && !word(i).has(Word::kMissing | Word::kReported))
      report("stray-argument/before-its-g"_cause, word(i).span(), {}, word(g.command).span());
    reported = true;
    word(i).flags = static_cast<std::uint8_t>((word(i).flags & ~Word::kBreak) | Word::kReported);
    // B440 G01 X5: more probably the N of the line.
    if (contains(dialect::kRotaryLetters, word(i).letter)) word(i).value = std::numeric_limits<double>::quiet_NaN();
    own(g, i);
  }
  earlier.flags |= Instruction::kReportedElsewhere;
  misplaced_count_ = 0;  // X5 G91 G00 Y5: the mode is before the G, only the X5 is not after it.
}

/// Whether a word is a tool change without its T, so that the tool's number continues the M's number: M06 101001 (D59).
/// `text` is the text of the word.
static bool swallows_tool(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t0", 1), text.size()));
  if (!text.starts_with('6')) return false;
  text.remove_prefix(1);
  const auto digits = std::count_if(text.begin(), text.end(), text::is_digit);
  const auto blanks = std::count_if(text.begin(), text.end(), text::is_blank);
  if (static_cast<std::size_t>(digits + blanks) != text.size()) return false;
  return digits == 6 || (digits > 0 && text::is_blank(text.front()));
}

void LineParser::add_m(std::uint16_t index) {
  Word& written = word(index);
  function_open_ = false;
  const double meant = meant_number(written.value, 1);
  const bool is_function = !std::isnan(meant);
  if ((!written.is_plain_integer() || !is_function) && !written.has(Word::kMissing | Word::kReported))
    report(swallows_tool(text_of(written.span())) ? "invalid-m-number/tool"_cause : "invalid-m-number"_diag,
           written.span());
  if (is_function) written.value = meant;
  // An M without a legible number before a T is probably a tool change.
  std::size_t next = index + 1u;
  while (next < word_count() && word(next).letter == kError) ++next;
  const bool before_tool = next < word_count() && word(next).letter == 'T';
  if (meant == dialect::kToolChange || (!is_function && before_tool)) return add_tool_change(index);
  if (!is_function && swallows_tool(text_of(written.span()))) {
    add_instruction(InstructionKind::ToolChange, index).flags |= Instruction::kReportedElsewhere;
    return;
  }
  Instruction& added = add_instruction(InstructionKind::Function, index);
  if (!is_function) {  // It keeps its parameters, so that they get no finding.
    added.flags |= Instruction::kReportedElsewhere;
    word(index).value = std::numeric_limits<double>::quiet_NaN();
  }
  function_ = added.number;
  function_open_ = true;
  needs_check_ |= written.value == dialect::kProgramEnd;
}

void LineParser::add_tool_change(std::uint16_t index) {
  Instruction& added = add_instruction(InstructionKind::ToolChange, index);
  const std::uint16_t count = word_count();
  auto next = static_cast<std::uint16_t>(index + 1);
  const auto is_doubled = [&](std::size_t at) {  // TT101001
    return word(at).letter == 'T' && word(at).has(Word::kMissing) && at + 1 < count && word(at + 1).letter == 'T';
  };
  while (next < count && (word(next).letter == kError || is_doubled(next))) ++next;
  if (next < count && word(next).letter == 'T') return own(added, next);
  if (next < count && word(next).is_plain_integer() && word(next).digits == 6) {  // R101001: another letter for T.
    report_missing("tool-change-without-tool"_diag, added);
    word(next).letter = kError;
    return;
  }
  // The T may be before the M06 (and has been reported) or further on; in both cases there is one finding, not two.
  for (std::size_t i = 0; i + 1 < instruction_count(); ++i)
    if (instruction(i).kind == InstructionKind::StrayTool) return void(added.flags |= Instruction::kReportedElsewhere);
  for (; next < count; ++next) {
    if (word(next).letter == 'M' && std::abs(word(next).value) == dialect::kToolChange) break;
    if (word(next).letter != 'T') continue;
    word(next).owner = added.number;
    return report_missing("tool-change-without-tool/tool-elsewhere"_cause, added, word(next).span());
  }
  report_missing("tool-change-without-tool"_diag, added);
}

/// Whether an M06 is followed by a tool.
bool LineParser::has_tool(std::size_t change) const {
  return change + 1 < word_count() && word(change + 1).letter == 'T' && word(change + 1).digits == 6;
}

/// Whether a T without its six digits is in an argument series: a letter that was hit wrong, as R30 or Y30.
bool LineParser::is_in_series(std::uint16_t index) const {
  if (taker_ == kNone || !contiguous_ || word(index).is_tool() || word(index).owner != Word::kNoOwner) return false;
  for (std::uint16_t i = 0; i < word_count(); ++i)
    if (word(i).letter == 'M' && word(i).value == dialect::kToolChange && !has_tool(i)) return false;
  return taker().command + 1 == index || word(index - 1u).owner == taker().number;
}

void LineParser::add_tool(std::uint16_t index) {
  check_tool_number(word(index));
  if (word(index).owner == Word::kNoOwner) {
    add_instruction(InstructionKind::StrayTool, index);
  } else {
    own(instruction(word(index).owner), index);
  }
}

/// The value of a label, which may have any number of digits; above 15 digits, a hash of them.
std::uint64_t LineParser::label_of(const Word& number) const {
  if (number.digits <= 15) return static_cast<std::uint64_t>(number.value);
  std::uint64_t hash = text::kHashStart;
  bool leading = true;
  bool in_comment = false;
  for (const char c : text_of(number.span())) {
    if (c == '(') in_comment = true;
    if (c == ')') in_comment = false;
    if (in_comment || !text::is_digit(c) || (leading && c == '0')) continue;
    leading = false;
    hash = text::hash_on(hash, c);
  }
  return leading ? 0 : hash | (std::uint64_t{1} << 63);
}

/// Adds a line number. Returns false if it is not valid; it has been reported and does not break a series.
bool LineParser::add_line_number(std::uint16_t index) {
  const Word& written = word(index);
  if (written.has(Word::kMissing)) return false;
  // IF VGPL = 1 THEN N10: the target of the jump, not the number of the line.
  if (line_.jump >= 0 && !store_.jumps_[static_cast<std::size_t>(line_.jump)].has_target) return false;
  const bool is_second = (line_.flags & LineTree::kHasLabel) != 0;
  if (!written.is_plain_integer() || is_second) {
    if (!written.has(Word::kReported))
      report(is_second ? "invalid-line-number/second"_cause : "invalid-line-number"_diag, written.span());
    if (written.is_plain_integer() && label_of(written) != line_.label) {
      ++other_numbers_;
      second_number_ = index;
    }
    return false;
  }
  line_.flags |= LineTree::kHasLabel;
  line_.label = label_of(written);
  return true;
}

void LineParser::add_feed(std::uint16_t index) {
  const Word& written = word(index);
  if (written.value <= 0 && !written.has(Word::kReported))
    report("feed-not-positive"_diag, written.span(), {written.value});
  if (line_.feed < 0) {
    line_.feed = index;
  } else if (word(static_cast<std::size_t>(line_.feed)).has(Word::kMissing)) {
    line_.feed = index;  // FF900: reported at the first F.
  } else if (!written.has(Word::kMissing | Word::kMalformed) && starts_second_block(index)) {
    report("repeated-feed"_diag, written.span(), {}, word(static_cast<std::size_t>(line_.feed)).span());
  }
}

void LineParser::add_spindle_speed(std::uint16_t index) {
  const Word& written = word(index);
  if (written.value <= 0 && !written.has(Word::kReported))
    report("spindle-speed-not-positive"_diag, written.span(), {written.value});
  if (line_.spindle < 0) {
    line_.spindle = index;
  } else if (word(static_cast<std::size_t>(line_.spindle)).has(Word::kMissing)) {
    line_.spindle = index;
  } else if (!written.has(Word::kMissing | Word::kMalformed) && starts_second_block(index)) {
    report("repeated-spindle-speed"_diag, written.span(), {}, word(static_cast<std::size_t>(line_.spindle)).span());
  }
  needs_check_ |= instruction_count() > 0;
}

}  // namespace isocnc::syntax
