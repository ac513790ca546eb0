#include <algorithm>
#include <limits>
#include <utility>

#include "interpreter/syntax/line_parser.h"
#include "interpreter/text/characters.h"

namespace isocnc::syntax {

using namespace dialect::literals;
using dialect::contains;

/// V25 = 78.99 (I.6). Returns the last word that belongs to it.
std::uint16_t LineParser::add_assignment(std::uint16_t index) {
  Instruction& added = add_instruction(InstructionKind::Assignment, index);
  const Word& name = word(index);
  const bool has_value = is_assigned(index);
  const auto is_error = [&](std::size_t at) { return at < word_count() && word(at).letter == kError; };
  // V1 := 5, V1 = O, = 5 V1, V1 IF > 5: another word is reported.
  const bool is_garbled = is_error(index + 1u) ||
                          (has_value && word(index + 1u).has(Word::kMissing) && is_error(index + 2u)) ||
                          follows_lone_equals(index) || precedes_if(index);
  if (!name.has(Word::kMissing | Word::kReported) && !is_garbled) {
    if (!name.is_plain_integer()) {
      report("invalid-register-number"_diag, name.span());
    } else if (!dialect::is_register(name.value)) {
      report("register-out-of-range"_diag, name.span(), {name.value});
    } else if (!has_value || word(index + 1u).has(Word::kMissing)) {
      const bool has_word = has_value && lacks_value(static_cast<std::uint16_t>(index + 1));
      report_missing(has_word ? "register-not-assigned/no-number"_cause : "register-not-assigned"_diag, added,
                     has_word ? word(index + 2u).span() : Span{});
    }
  }
  if (!has_value) return index;
  auto last = static_cast<std::uint16_t>(index + 1);
  own(added, last);
  if (lacks_value(last)) own_in_place_of_value(added, ++last);
  return last;
}

/// Whether the word before is a `=` of no register or parameter: = 10 V5.
bool LineParser::follows_lone_equals(std::uint16_t index) const {
  return index > 0 && word(index - 1u).letter == kAssign && word(index - 1u).owner == Word::kNoOwner;
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

/// Whether a V or a parameter before a `=` has none of its own, which has been reported.
bool LineParser::lacks_equals_before(std::uint16_t equals) const {
  for (std::uint16_t i = 0; i < equals; ++i)
    if (contains(dialect::letters("VP"), word(i).letter) && word(i).owner != Word::kNoOwner && !is_assigned(i))
      return true;
  return false;
}

/// Whether the error of a `=` has been reported at the words before it.
bool LineParser::is_equals_reported_before(std::uint16_t index) const {
  const Word& before = word(index - 1u);
  if (before.letter == kError || before.letter == kVgpl) return true;       // #1=5
  if (before.letter == kAssign && lacks_equals_before(index)) return true;  // V1 V2 = 0 = 3.5
  if (before.letter == 'M' && !before.known() && !before.has(Word::kMissing))
    return true;                                                       // M101 1=2: reported at the M.
  if (before.letter == kNumber) return true;                           // 2=1: a V has lost its letter.
  if (before.letter == 'P' && word(0).letter == kNumber) return true;  // 100 P1=2
  if (before.letter == 'P' && line_.jump >= 0) return true;            // IF ... GOTO N9 P1=2: IF must be alone.
  const bool follows_letter = index > 1 && word(index - 2u).has(Word::kMissing);  // CR=5, VI=5: reported at the C or V.
  return follows_letter && index - 2 > stray_value_;
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

/// Whether a `=` belongs to the instruction of the word before it: to a parameter of an M, or to an argument of an
/// unknown G, which has been reported (G54 P1=2).
bool LineParser::own_equals(std::uint16_t index, std::uint16_t last) {
  const Word& before = word(index - 1u);
  if (before.owner == Word::kNoOwner) return false;
  Instruction& owner = instruction(before.owner);
  if (owner.kind == InstructionKind::Function && before.letter == 'P') {
    own(owner, index);
    if (last > index) own_in_place_of_value(owner, last);
    return true;
  }
  const bool is_reported = index - 1 != owner.command || !before.has(Word::kMissing);  // G=5 has not been reported.
  return owner.is_unknown_g() && is_reported;
}

/// Handles P20 M100=5: the P before the M is part of the same mistake.
void LineParser::take_parameter_before_function(std::uint16_t equals) {
  if (equals < 2 || word(equals - 1u).letter != 'M' || word(equals - 2u).letter != 'P') return;
  Word& parameter = word(equals - 2u);
  if (parameter.owner == Word::kNoOwner || instruction(parameter.owner).begin != equals - 2) return;
  instruction(parameter.owner).flags |= Instruction::kReportedElsewhere;
  parameter.letter = kError;
  parameter.flags |= Word::kReported;
  needs_check_ = true;
}

/// X=20 is X20; in R1=10 either number may be meant (D61).
void LineParser::make_word_before_unknown(std::uint16_t index) {
  Word& before = word(index - 1u);
  if (before.has(Word::kMissing)) {
    before.value = word(index).value;
    before.flags = word(index).flags;
  } else if (!word(index).has(Word::kMissing)) {
    before.value = std::numeric_limits<double>::quiet_NaN();
  }
  before.flags |= Word::kReported;
}

/// Reports a `=` whose place is wrong. The cause is what stands before it.
void LineParser::report_equals(std::uint16_t index) {
  const Span equals{word(index).begin, word(index).begin + 1};
  const Word* const before = index > 0 ? &word(index - 1u) : nullptr;
  if (!before || before->letter < 'A' || before->letter > 'Z')
    return report("assignment-without-register"_diag, equals);
  const dialect::Cause cause = before->has(Word::kMissing) ? "assignment-without-register/letter"_cause
                               : before->letter == 'P' && before->owner == Word::kNoOwner
                                   ? "assignment-without-register/parameter"_cause
                                   : "assignment-without-register/word"_cause;
  report(cause, equals, {}, before->span());
}

/// The last word of the value after a `=`: X=IC(5), X=R1, R1=R2+5, T="NAME".
std::uint16_t LineParser::end_of_value(std::uint16_t index) const {
  auto last = static_cast<std::uint16_t>(index + (lacks_value(index) && !is_between_coordinates(index) ? 1 : 0));
  const auto goes_on = [&](std::uint16_t next) {
    const bool is_text = word(next).has(Word::kMissing) || word(next).letter == kError;
    return is_text && word(next).letter != kAssign && !is_assigned(next);
  };
  while (word(index).has(Word::kMissing) && last + 1 < word_count() && goes_on(static_cast<std::uint16_t>(last + 1)))
    ++last;
  return last;
}

/// Whether another `=` with a value that is no number, or after the S or M of another spindle, has been reported on the
/// line: X=R1 Y=R2 and S1=500 M1=3 are one habit each. `last` is the last word of the value.
bool LineParser::repeats_equals(std::uint16_t index, std::uint16_t last) {
  if (index == 0) return false;
  const Word& before = word(index - 1u);
  const bool is_text = before.has(Word::kMissing) && word(index).has(Word::kMissing);
  const bool is_habit = is_text || contains(dialect::letters("MS"), before.letter);
  return is_habit && std::exchange(stray_value_, last) != kNone;
}

/// Reports a `=` that follows neither a V nor an M's P (ISO058). Returns the last word that belongs to it.
std::uint16_t LineParser::add_equals(std::uint16_t index) {
  const std::uint16_t last = end_of_value(index);
  if (index > 0) {
    if (word(index - 1u).letter == kError)  // #1 = #2 + 1, #1 = #2 * #3: all of it is one mistake.
      for (std::uint16_t i = index; i < std::max<int>(last, index + 1) && i + 1 < word_count(); ++i)
        take_back("unknown-word"_diag, word(i + 1u).span());
    if (is_equals_reported_before(index) || own_equals(index, last)) return last;
    take_parameter_before_function(index);
    const char letter = word(index - 1u).letter;
    const bool is_stray_parameter = letter == 'Q' || (letter == 'P' && word(index - 1u).owner == Word::kNoOwner);
    if (is_stray_parameter && std::exchange(stray_parameter_, true)) return last;
  }
  const bool is_repeated = repeats_equals(index, last);
  if (last > index) take_back_within(hull(word(index + 1u).span(), word(last).span()));
  const Word& equals = word(index);
  const bool is_sum = equals.has(Word::kMalformed) && text_of(equals.span()).find(',') == std::string_view::npos;
  if (is_sum) take_back_within(equals.span());  // X=10+5
  if (!is_repeated) report_equals(index);
  if (index > 0) make_word_before_unknown(index);
  return last;
}

}  // namespace isocnc::syntax
