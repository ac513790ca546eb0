#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/line_parser.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

const char* LineParser::parse() {
  const char* const end = lex();
  line_.length = column(end);
  structure();
  if (needs_check_) check();
  line_.words = word_count();
  line_.instructions = static_cast<std::uint16_t>(instruction_count());
  line_.comments = static_cast<std::uint32_t>(store_.comments_.size() - line_.first_comment);
  line_.findings = static_cast<std::uint32_t>(store_.findings_.size() - line_.first_finding);
  if (line_.findings > 1)
    std::stable_sort(store_.findings_.end() - line_.findings, store_.findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.span.begin < b.span.begin; });
  store_.lines_.push_back(line_);
  return end;
}

void LineParser::report(dialect::DiagnosticId id, Span span, std::initializer_list<double> values, Span related) {
  const bool is_reported = store_.findings_.size() > line_.first_finding && store_.findings_.back().id == id &&
                           store_.findings_.back().span == span;
  if (is_reported) return;  // Two checks may find the same error (IF IF).
  Finding& finding = store_.findings_.emplace_back();
  finding.id = id;
  finding.span = span;
  finding.related = related;
  std::copy(values.begin(), values.end(), finding.values.begin());
}

/// Removes a finding, where one mistake has been reported twice.
void LineParser::take_back(dialect::DiagnosticId id, Span span) {
  auto& findings = store_.findings_;
  const auto first = findings.begin() + line_.first_finding;
  findings.erase(std::remove_if(first, findings.end(),
                                [&](const Finding& finding) { return finding.id == id && finding.span == span; }),
                 findings.end());
}

void LineParser::take_back_within(Span span) {
  auto& findings = store_.findings_;
  const auto is_within = [&](const Finding& it) { return it.span.begin >= span.begin && it.span.end <= span.end; };
  findings.erase(std::remove_if(findings.begin() + line_.first_finding, findings.end(), is_within), findings.end());
}

static bool is_no_word(const Word& word) { return word.letter == kError || word.has(Word::kMissing); }

/// Reports a missing word, unless a comment is not closed: the word may be in it, and the comment has been reported.
void LineParser::report_missing(dialect::DiagnosticId id, const Instruction& lacking) {
  if ((line_.flags & LineTree::kUnclosed) == 0) report(id, word(lacking.command).span());
}

/// Whether unknown characters are a letter of another control with its number (H2, D3): a word, not plain text.
bool LineParser::is_foreign_word(const Word& unknown) const {
  const std::string_view text(begin_ + unknown.begin, unknown.end - unknown.begin);
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

void LineParser::structure() {
  if (has_prose_) join_prose();
  const std::uint16_t count = word_count();
  for (std::uint16_t i = 0; i < count; ++i) {
    const char letter = word(i).letter;
    const bool is_letter_alone = word(i).has(Word::kMissing);
    if (contains(dialect::kDimensionLetters, letter)) {
      add_dimension(i);
      after_motion_ = true;
      continue;
    }
    switch (letter) {
      case 'F':
        add_feed(i);
        continue;  // The motion's speed does not break the series (D17).
      case 'N':
        if (!add_line_number(i)) continue;
        break;
      case 'S':
        add_spindle_speed(i);
        after_motion_ &= is_letter_alone;
        break;
      case 'G':
        if (word(i).has(Word::kMissing) && i + 1 < count && word(i + 1u).letter == 'G') continue;  // GG01
        add_g(i);
        continue;
      case 'M':
        add_m(i);
        after_motion_ &= is_letter_alone;
        break;
      case 'T':
        add_tool(i);
        after_motion_ &= is_letter_alone;
        break;
      case 'V':
        if (stands_for_number(i)) continue;
        i = add_assignment(i);
        after_motion_ &= is_letter_alone;
        break;
      case kAssign:
        i = add_equals(i);
        continue;
      case kIf:
        i = end_jump(add_jump(i));
        after_motion_ = false;
        break;
      case kGoto:
        i = add_lone_goto(i);
        break;
      case kVgpl:
        report("unknown-word"_diag, word(i).span());
        continue;
      case kError:
        if (is_taken_by_unknown_g(i)) take_back("unknown-word"_diag, word(i).span());
        continue;
      default:
        continue;  // An error that has been reported does not break the series.
    }
    if (is_letter_alone) continue;  // X25S Y5: a reported letter does not break the series.
    contiguous_ = false;
    if (letter != 'M') function_open_ = false;
  }
}

/// Whether unknown text belongs to the unknown G before it, which has been reported (G43 H1). Text inside the number of
/// that G does not (G5O).
bool LineParser::is_taken_by_unknown_g(std::uint16_t index) const {
  if (taker_ == kNone || !contiguous_) return false;
  const Instruction& taker = instruction(static_cast<std::size_t>(taker_));
  const bool spoils_number = taker.command + 1 == index && word(taker.command).has(Word::kMalformed);
  return taker.kind == InstructionKind::G && !taker.g() && !spoils_number;
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

void LineParser::add_dimension(std::uint16_t index) {
  const bool names_register =
      index > 0 && word(index - 1u).letter == 'V' && word(index - 1u).has(Word::kMissing) && is_assigned(index);
  if (names_register) return;  // VI=5: reported at the V.
  const char letter = word(index).letter;
  const bool is_parameter = letter == 'P' && function_ != kNone && (function_open_ || is_assigned(index));
  if (is_parameter) {
    own(instruction(static_cast<std::size_t>(function_)), index);
    needs_check_ = true;
    return;
  }
  // P1=1 P2=4.5 without an M: parameters that belong to no instruction are reported once, together.
  if (letter == 'P' && taker_ == kNone && line_.jump < 0 && is_assigned(index)) return;
  function_open_ = false;
  if (taker_ != kNone && !contiguous_ && instruction(static_cast<std::size_t>(taker_)).row == dialect::kUnknownGCode &&
      instruction(static_cast<std::size_t>(taker_)).kind == InstructionKind::G)
    taker_ = kNone;  // The arguments of an unknown G end with its series.
  if (taker_ == kNone) {
    after_unknown_ = index > 0 && word(index - 1u).letter == kError;
    add_instruction(InstructionKind::Continuation, index);
    taker_ = static_cast<int>(instruction_count()) - 1;
    taken_ = 0;
    contiguous_ = true;
    dimensions_seen_ = true;
  }
  Instruction& taker = instruction(static_cast<std::size_t>(taker_));
  if (!contiguous_) {
    word(index).flags |= Word::kBreak;
    needs_check_ = true;
  }
  // L X10 R0: arguments of another control's motion.
  const bool is_of_unknown =
      after_unknown_ && taker.kind == InstructionKind::Continuation && !contains(dialect::kCoordinateLetters, letter);
  if (is_of_unknown) word(index).flags |= Word::kReported;
  const dialect::LetterSet bit = dialect::letter_bit(letter);
  // XX10: the first X has been reported, because it has no number.
  const bool is_typed_twice = index > 0 && word(index - 1u).letter == letter && word(index - 1u).has(Word::kMissing);
  if ((taken_ & bit) != 0 && !is_typed_twice) {
    // It is unclear which of the two was meant: the axis becomes unknown, so that no second finding follows.
    Span first;
    for (std::uint16_t i = taker.begin; i < index; ++i) {
      if (word(i).owner != taker.number || word(i).letter != letter) continue;
      if (first.empty()) first = word(i).span();
      word(i).value = std::numeric_limits<double>::quiet_NaN();
    }
    // In R1=1 R2=2 the number has been reported, so the repetition is not.
    const bool is_reported = is_assigned(index) || word(index).has(Word::kMissing | Word::kMalformed);
    word(index).value = std::numeric_limits<double>::quiet_NaN();
    word(index).flags |= Word::kReported;
    if (!is_reported) report("repeated-argument"_diag, word(index).span(), {}, first);
  }
  taken_ |= bit;
  own(taker, index);
}

/// The number meant by a misspelled but clear word, such as G1.0, M+6 or G-1; otherwise NaN.
static double meant_number(double value, double minimum) {
  const double number = std::abs(value);
  const bool is_plain = number >= minimum && number <= 999 && number == std::floor(number);
  return is_plain ? number : std::numeric_limits<double>::quiet_NaN();
}

void LineParser::add_g(std::uint16_t index) {
  const Word& written = word(index);
  std::uint8_t row = dialect::kUnknownGCode;
  const bool spelled_right = written.is_plain_integer() && written.value <= 999;
  const double meant = meant_number(written.value, 0);
  if (!std::isnan(meant)) row = dialect::kGCodeRows[static_cast<std::size_t>(meant)];
  if (!spelled_right) {
    if (!written.has(Word::kMissing | Word::kReported)) report("invalid-g-number"_diag, written.span());
    word(index).flags |= Word::kReported;
  } else if (row == dialect::kUnknownGCode) {
    report("unsupported-g"_diag, written.span());
  }
  Instruction& added = add_instruction(InstructionKind::G, index);
  added.row = row;
  if (after_motion_) added.flags |= Instruction::kFollowsMotion;
  after_motion_ = false;
  function_open_ = false;
  contiguous_ = false;
  needs_check_ = true;
  const dialect::GCode* const code = added.g();
  if (!code) {
    taker_ = added.number;
    taken_ = 0;
    contiguous_ = true;
    return;
  }
  if (code->is_motion()) {
    after_motion_ = true;
    if (++motions_ == 1) {
      first_motion_ = written.span();
    } else {
      report("second-motion"_diag, written.span(), {}, first_motion_);
    }
  }
  if (code->misplaced != dialect::kNoDiagnostic && dimensions_seen_ && misplaced_count_ < 4)
    misplaced_[misplaced_count_++] = index;
  if (!code->takes_arguments()) return;
  const bool has_dimensions = code->alone != "g04-not-alone"_diag;
  if (has_dimensions && taker_ != kNone &&
      instruction(static_cast<std::size_t>(taker_)).kind == InstructionKind::Continuation) {
    take_earlier_words(added);
  } else {
    taken_ = 0;
  }
  taker_ = added.number;
  contiguous_ = true;
  dimensions_seen_ |= has_dimensions;
}

/// Handles `X10 G1`: arguments must follow their G (D16). One finding; the words count as arguments of the G.
void LineParser::take_earlier_words(Instruction& g) {
  Instruction& earlier = instruction(static_cast<std::size_t>(taker_));
  bool reported = false;
  for (std::uint16_t i = earlier.begin; i < earlier.end; ++i) {
    if (word(i).owner != earlier.number) continue;
    if (!reported && !word(i).has(Word::kMissing))
      report("stray-argument"_diag, word(i).span(), {}, word(g.command).span());
    reported = true;
    word(i).flags = static_cast<std::uint8_t>((word(i).flags & ~Word::kBreak) | Word::kReported);
    own(g, i);
  }
  earlier.flags |= Instruction::kReportedElsewhere;
}

/// Whether a word is a tool change without its T, so that the tool's number continues the M's number: M06 101001 (D59).
/// `text` is the text of the word.
static bool swallows_tool(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t0", 1), text.size()));
  if (!text.starts_with('6')) return false;
  text.remove_prefix(1);
  const auto digits = std::count_if(text.begin(), text.end(), is_digit);
  const auto blanks = std::count_if(text.begin(), text.end(), is_blank);
  if (static_cast<std::size_t>(digits + blanks) != text.size()) return false;
  return digits == 6 || (digits > 0 && is_blank(text.front()));
}

void LineParser::add_m(std::uint16_t index) {
  Word& written = word(index);
  function_open_ = false;
  const double meant = meant_number(written.value, 1);
  const bool is_function = !std::isnan(meant);
  if ((!written.is_plain_integer() || !is_function) && !written.has(Word::kMissing | Word::kReported))
    report("invalid-m-number"_diag, written.span());
  if (is_function) written.value = meant;
  // An M without a legible number before a T is probably a tool change.
  std::size_t next = index + 1u;
  while (next < word_count() && word(next).letter == kError) ++next;
  const bool before_tool = next < word_count() && word(next).letter == 'T';
  if (meant == dialect::kToolChange || (!is_function && before_tool)) return add_tool_change(index);
  if (!is_function && swallows_tool({begin_ + written.begin, written.end - written.begin})) {
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
  while (next < count && word(next).letter == kError) ++next;
  if (next < count && word(next).letter == 'T') return own(added, next);
  // The T may be before the M06 (and has been reported) or further on; in both cases there is one finding, not two.
  for (std::size_t i = 0; i + 1 < instruction_count(); ++i)
    if (instruction(i).kind == InstructionKind::StrayTool) return void(added.flags |= Instruction::kReportedElsewhere);
  report_missing("tool-change-without-tool"_diag, added);
  for (auto i = static_cast<std::uint16_t>(index + 1); i < count; ++i) {
    if (word(i).letter == 'M' && std::abs(word(i).value) == dialect::kToolChange) return;
    if (word(i).letter == 'T') return void(word(i).owner = added.number);
  }
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
static std::uint64_t label_of(const Word& number, std::string_view text) {
  if (number.digits <= 15) return static_cast<std::uint64_t>(number.value);
  std::uint64_t hash = 14695981039346656037ULL;
  bool leading = true;
  bool in_comment = false;
  for (const char c : text) {
    if (c == '(') in_comment = true;
    if (c == ')') in_comment = false;
    if (in_comment || !is_digit(c) || (leading && c == '0')) continue;
    leading = false;
    hash = (hash ^ static_cast<std::uint64_t>(c)) * 1099511628211ULL;
  }
  return leading ? 0 : hash | (std::uint64_t{1} << 63);
}

/// Adds a line number. Returns false if it is not valid; it has been reported and does not break a series.
bool LineParser::add_line_number(std::uint16_t index) {
  const Word& written = word(index);
  if (written.has(Word::kMissing)) return false;
  // IF VGPL = 1 THEN N10: the target of the jump, not the number of the line.
  if (line_.jump >= 0 && !store_.jumps_[static_cast<std::size_t>(line_.jump)].has_target) return false;
  if (!written.is_plain_integer() || (line_.flags & LineTree::kHasLabel) != 0) {
    if (!written.has(Word::kReported)) report("invalid-line-number"_diag, written.span());
    return false;
  }
  line_.flags |= LineTree::kHasLabel;
  line_.label = label_of(written, {begin_ + written.begin, written.end - written.begin});
  return true;
}

void LineParser::add_feed(std::uint16_t index) {
  const Word& written = word(index);
  if (written.value <= 0) report("feed-not-positive"_diag, written.span(), {written.value});
  if (line_.feed < 0) {
    line_.feed = index;
  } else if (word(static_cast<std::size_t>(line_.feed)).has(Word::kMissing)) {
    line_.feed = index;  // FF900: reported at the first F.
  } else if (!written.has(Word::kMissing | Word::kMalformed)) {
    report("repeated-feed"_diag, written.span(), {}, word(static_cast<std::size_t>(line_.feed)).span());
  }
}

void LineParser::add_spindle_speed(std::uint16_t index) {
  const Word& written = word(index);
  if (written.value <= 0) report("spindle-speed-not-positive"_diag, written.span(), {written.value});
  if (line_.spindle < 0) {
    line_.spindle = index;
  } else if (word(static_cast<std::size_t>(line_.spindle)).has(Word::kMissing)) {
    line_.spindle = index;
  } else if (!written.has(Word::kMissing | Word::kMalformed)) {
    report("repeated-spindle-speed"_diag, written.span(), {}, word(static_cast<std::size_t>(line_.spindle)).span());
  }
  needs_check_ |= instruction_count() > 0;
}

/// V25 = 78.99 (I.6). Returns the last word that belongs to it.
std::uint16_t LineParser::add_assignment(std::uint16_t index) {
  Instruction& added = add_instruction(InstructionKind::Assignment, index);
  const Word& name = word(index);
  const bool has_value = is_assigned(index);
  const bool is_garbled = index + 1 < word_count() && word(index + 1u).letter == kError;  // V1 := 5
  if (!name.has(Word::kMissing | Word::kReported) && !is_garbled) {
    if (!name.is_plain_integer()) {
      report("invalid-register-number"_diag, name.span());
    } else if (!dialect::is_register(name.value)) {
      report("register-out-of-range"_diag, name.span(), {name.value});
    } else if (!has_value || word(index + 1u).has(Word::kMissing)) {
      report_missing("register-not-assigned"_diag, added);
    }
  }
  if (!has_value) return index;
  auto last = static_cast<std::uint16_t>(index + 1);
  own(added, last);
  if (lacks_value(last)) own_in_place_of_value(added, ++last);
  return last;
}

/// Handles V5=X: the word in the place of the value lacks a number as well, but the value is reported.
void LineParser::own_in_place_of_value(Instruction& owner, std::uint16_t index) {
  take_back("word-without-number"_diag, word(index).span());
  own(owner, index);
}

/// Whether a `=` has no legible number but another word in its place, which belongs to the same mistake: V1=V2, V1=X5,
/// V1==2, V1=-V2.
bool LineParser::lacks_value(std::uint16_t assign) const {
  static constexpr dialect::LetterSet kInPlace = dialect::kDimensionLetters | dialect::letters("FSV");
  if (!word(assign).has(Word::kMissing) && !(word(assign).has(Word::kMalformed) && word(assign).digits == 0))
    return false;
  if (assign + 1 >= word_count()) return false;
  const char letter = word(assign + 1u).letter;
  return letter == kAssign || contains(kInPlace, letter);
}

/// Whether the error of a `=` has been reported at the words before it.
bool LineParser::is_equals_reported_before(std::uint16_t index) const {
  const Word& before = word(index - 1u);
  if (before.letter == kError || before.letter == kVgpl) return true;  // #1=5
  if (before.letter == 'P' && line_.jump >= 0) return true;            // IF ... GOTO N9 P1=2: IF must be alone.
  return index > 1 && word(index - 2u).has(Word::kMissing);            // CR=5, VI=5: reported at the C or V.
}

/// Whether both letters around a `=` have numbers, so that the second is not the value of the first: G92 Y20= Z146
/// (D61).
bool LineParser::is_between_coordinates(std::uint16_t assign) const {
  const auto is_complete = [](const Word& it) {
    return contains(dialect::kCoordinateLetters, it.letter) && !it.has(Word::kMissing);
  };
  return assign > 0 && assign + 1 < word_count() && word(assign).has(Word::kMissing) &&
         is_complete(word(assign - 1u)) && is_complete(word(assign + 1u));
}

/// Reports a `=` that follows neither a V nor an M's P (ISO058). Returns the last word that belongs to it.
std::uint16_t LineParser::add_equals(std::uint16_t index) {
  auto last = static_cast<std::uint16_t>(index + (lacks_value(index) && !is_between_coordinates(index) ? 1 : 0));
  if (index > 0) {
    Word& before = word(index - 1u);
    if (is_equals_reported_before(index)) return last;
    if (before.owner != Word::kNoOwner) {
      Instruction& owner = instruction(before.owner);
      if (owner.kind == InstructionKind::Function && before.letter == 'P') {
        own(owner, index);
        if (last > index) own_in_place_of_value(owner, last);
        return last;
      }
      // G54 P1=2: an argument of an unknown G.
      const bool is_reported = index - 1 != owner.command || !before.has(Word::kMissing);  // G=5 has not been reported.
      if (owner.kind == InstructionKind::G && owner.row == dialect::kUnknownGCode && is_reported) return last;
    }
    const bool is_parameter = before.letter == 'P' && before.owner == Word::kNoOwner;
    if (is_parameter && std::exchange(stray_parameter_, true)) return last;
    if (before.has(Word::kMissing)) {
      before.value = word(index).value;
      before.flags = word(index).flags;
    } else if (!word(index).has(Word::kMissing)) {
      before.value = std::numeric_limits<double>::quiet_NaN();  // R1=10: either number may be meant (D61).
    }
    before.flags |= Word::kReported;
  }
  while (last > index && last + 1 < word_count() && word(last + 1u).has(Word::kMissing)) ++last;  // X=IC(5)
  for (auto i = static_cast<std::uint16_t>(index + 1); i <= last; ++i)
    take_back("word-without-number"_diag, word(i).span());
  const Word& equals = word(index);
  report("assignment-without-register"_diag, {equals.begin, equals.begin + 1});
  return last;
}

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

/// Handles text after the label that is not a word: a malformed part of the jump, up to the end of the line (GOTO N10
/// ELSE N20). Returns the last word that belongs to the jump.
std::uint16_t LineParser::end_jump(std::uint16_t last) {
  const auto next = static_cast<std::uint16_t>(last + 1);
  if (next >= word_count() || !store_.jumps_[static_cast<std::size_t>(line_.jump)].has_target) return last;
  if (!is_no_word(word(next))) return last;
  const Span rest = hull(word(next).span(), word(word_count() - 1u).span());
  auto& findings = store_.findings_;
  findings.erase(std::remove_if(findings.begin() + line_.first_finding, findings.end(),
                                [&](const Finding& finding) { return finding.span.begin >= rest.begin; }),
                 findings.end());
  report("if-malformed"_diag, rest);
  return static_cast<std::uint16_t>(word_count() - 1);
}

/// Reads the words from IF to the label, both included. One finding for a malformed condition, one for a malformed
/// label. Returns the last word that belongs to the jump.
std::uint16_t LineParser::read_condition(Jump& jump, std::uint16_t index) {
  const std::uint16_t count = word_count();
  std::uint16_t goto_at = index;
  while (goto_at < count && word(goto_at).letter != kGoto) ++goto_at;
  auto at = static_cast<std::uint16_t>(index + 1);
  // Reports the words in the place of the required part, up to the part after it; without such words, an incomplete IF.
  const auto fail = [&](std::uint16_t where, std::string_view next_letters) {
    auto last = where;
    while (last < goto_at && next_letters.find(word(last).letter) == std::string_view::npos) ++last;
    if (last == where) return report_half_jump(where, goto_at);
    report("if-malformed"_diag, hull(word(where).span(), word(last - 1u).span()));
  };
  bool good = false;
  const bool has_operator = at + 1 < goto_at && word(at + 1u).letter == kOperator;
  if (at >= goto_at || !read_variable(jump, word(at), has_operator)) {
    fail(at, {&kOperator, 1});
  } else if (++at >= goto_at || word(at).letter != kOperator ||
             static_cast<Comparison>(word(at).digits) == Comparison::Invalid) {
    fail(at, {&kNumber, 1});
  } else if (jump.comparison = static_cast<Comparison>(word(at).digits);
             ++at >= goto_at || word(at).letter != kNumber || word(at).has(Word::kMalformed)) {
    fail(at, {});
  } else if (jump.value = word(at).value; goto_at >= count) {
    report_half_jump(static_cast<std::uint16_t>(at + 1), count);
  } else if (++at < goto_at) {
    fail(at, {});
  } else {
    good = true;
  }
  if (!good) jump.variable = Jump::kUnknownVariable;
  if (goto_at < count) return read_target(jump, goto_at);
  // Without a GOTO, the condition ends at the first word that belongs to another instruction.
  auto last = index;
  while (last + 1 < count) {
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
    const std::string_view text(begin_ + comment.begin, comment.end - comment.begin);
    if (comment.begin >= begin && comment.end <= end && text.find_first_of("=<>") != std::string_view::npos)
      return comment;
  }
  return std::nullopt;
}

/// Reports an IF that lacks a part before the word at `where`, which may be the word at `end`. Marks the text in place
/// of the missing part (THEN, a condition in parentheses), else the word after which it is missing.
void LineParser::report_half_jump(std::uint16_t where, std::uint16_t end) {
  half_jump_ = true;
  const std::uint32_t behind = where < word_count() ? word(where).begin : line_.length;
  if (const std::optional<Span> comment = comparison_in_comment(word(where - 1u).end, behind))
    return report("if-malformed"_diag, *comment);
  if (where == end) return report("if-malformed"_diag, word(where - 1u).span());
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

/// Reads the label after the GOTO at `index`.
std::uint16_t LineParser::read_target(Jump& jump, std::uint16_t index) {
  const auto at = static_cast<std::uint16_t>(index + 1);
  if (at >= word_count() || word(at).letter == 'G' || word(at).letter == kIf) {
    half_jump_ = true;
    report("if-malformed"_diag, word(index).span());
    return index;
  }
  const Word& label = word(at);
  if (label.letter != 'N' || !label.is_plain_integer()) {
    if (!label.has(Word::kReported)) report("if-malformed"_diag, label.span());  // N1O: reported at the O.
    return at;
  }
  jump.has_target = true;
  jump.target = label_of(label, {begin_ + label.begin, label.end - label.begin});
  jump.target_span = label.span();
  return at;
}

/// Handles a GOTO without IF, or a second GOTO on the line, which is reported at the first: it must be alone.
std::uint16_t LineParser::add_lone_goto(std::uint16_t index) {
  if (line_.jump < 0) {
    for (std::uint16_t i = 0; i < index; ++i)  // V5 > 30 GOTO N340: the IF is missing.
      if (word(i).letter == kError && char_class(begin_[word(i).begin]) == CharClass::Compare)
        take_back("unknown-word"_diag, word(i).span());
    report("if-malformed"_diag, word(index).span());
  }
  const auto at = static_cast<std::uint16_t>(index + 1);
  if (at >= word_count()) return index;
  const char letter = word(at).letter;
  return letter == 'N' || letter == kNumber || letter == kError ? at : index;
}

}  // namespace isocnc::syntax
