#include <algorithm>
#include <limits>
#include <string_view>

#include "interpreter/dialect/near_codes.h"
#include "interpreter/execution/executor.h"

namespace isocnc::execution {

using namespace dialect::literals;
using dialect::GCode;
using dialect::GRole;
using dialect::ModalGroup;
using syntax::Word;

/// Whether a code may be followed by these arguments and no others.
static bool takes(const GCode& code, dialect::LetterSet arguments) {
  return (arguments & ~code.arguments) == 0 && (arguments != 0 || !code.takes_arguments());
}

/// Leaves open whether a code has been meant. Its group is doubtful if the code would change anything.
void Executor::doubt(const GCode& code) {
  if (code.group == ModalGroup::None || code.group == ModalGroup::Motion) return;  // See may_be_motion().
  if (!would_change(code)) return;
  if (code.group == ModalGroup::Workpiece) state_.workpiece_unknown = kLinearAxes;
  doubt(code.group);
}

/// Whether a modal code would change what is in force.
bool Executor::would_change(const GCode& code) const {
  if (code.group == ModalGroup::Workpiece) return true;
  if (code.group == ModalGroup::Face) return code.mounts_face() || state_.face_mounted;
  return state_.mode(code.group) != code.number;
}

/// Leaves open which code of a group is in force. Whatever depends on it is unknown.
void Executor::doubt(ModalGroup group) {
  state_.in_doubt |= State::bit(group);
  state_.written &= static_cast<std::uint16_t>(~State::bit(group));
  if (group == ModalGroup::Distance) state_.unknown = kAllAxes;
  if (group == ModalGroup::Face || group == ModalGroup::Workpiece || group == ModalGroup::Units) blur_linear_axes();
}

/// A G of the group has been written: it is known again what is in force.
void Executor::end_doubt(ModalGroup group) {
  if (!state_.is_in_doubt(group)) return;
  state_.in_doubt &= static_cast<std::uint16_t>(~State::bit(group));
  if (group == ModalGroup::Face || group == ModalGroup::Workpiece) blur_linear_axes();
}

void Executor::make_motion_illegible() {
  state_.set_mode(dialect::ModalGroup::Motion, dialect::kNoMotion);
  state_.motion_illegible = true;
}

void Executor::blur_axes_not_named() {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const char letter = letter_of(static_cast<Axis>(axis));
    const auto names_it = [&](const Word& word) { return word.letter == letter; };
    if (std::none_of(line_.words.begin(), line_.words.end(), names_it))
      state_.unknown |= axis_bit(static_cast<Axis>(axis));
  }
}

/// Handles G70, G71, G90 or G91 after the coordinates, which may have been meant under the old or the new mode (D60).
void Executor::blur_axes_of_late_mode() {
  std::uint32_t mode = 0;
  for (const syntax::Finding& finding : line_.findings)
    if (finding.id == "units-after-dimensions"_diag || finding.id == "distance-mode-after-dimensions"_diag)
      mode = finding.span.begin;
  for (const Word& word : line_.words)
    for (int axis = 0; axis < kAxisCount; ++axis)
      if (word.letter == letter_of(static_cast<Axis>(axis)) && word.begin < mode)
        state_.unknown |= axis_bit(static_cast<Axis>(axis));
}

/// Leaves open which of some codes has been meant by a number with these arguments.
void Executor::doubt(dialect::GCodeSet codes, dialect::LetterSet arguments) {
  for (std::size_t row = 0; row < std::size(dialect::kGCodes); ++row)
    if ((codes >> row & 1) != 0 && takes(dialect::kGCodes[row], arguments)) doubt(dialect::kGCodes[row]);
}

/// What is written after a G, also where its number could not be read (G4O).
static std::string_view number_of(const Word& g, std::string_view line) {
  std::string_view number = line.substr(g.begin + 1);
  number.remove_prefix(std::min(number.find_first_not_of(" \t"), number.size()));
  return number;
}

/// Handles a G that the dialect does not have, or that cannot be read: a code near it may have been meant (G277, G4O),
/// or one whose digits go on with those of the next word (G29 90). Returns whether it is surely no motion.
bool Executor::doubt_unknown_g(const Word& g, const Arguments& arguments) {
  const bool is_together = line_.text_of(g.span()).find_first_of(" \t") == std::string_view::npos;  // Not G28 0.5.
  if (is_together && !g.has(Word::kMalformed) && g.known() && !g.whole()) return false;  // G91.1: of other controls.
  const std::string_view number = number_of(g, line_.text);
  const GCode* const written = dialect::code_written(number);
  const bool is_foreign = !written && dialect::is_of_other_controls(number, arguments.present());
  const GCode* const in_front = written || is_foreign ? nullptr : dialect::code_in_front(number);  // Not G290.
  if (const GCode* const meant = written ? written : in_front) {
    doubt(*meant);
    return !meant->is_motion();
  }
  const dialect::GCodeSet near = dialect::codes_near(number);
  if (!is_foreign) {
    doubt(near, arguments.present());
  } else if (state_.face_mounted && arguments.empty()) {  // G57 for G27.
    doubt(near & dialect::bit_of(dialect::g_code(GRole::DismountFace)), 0);
  }
  return false;
}

/// Whether the digits of a motion G go on with those of the next word, whose letter is lost: G01 540, G01 -20.
bool Executor::takes_number(const Word& g) const {
  if (g.has(Word::kMalformed)) return true;
  const GCode* const in_front = dialect::code_in_front(number_of(g, line_.text));
  return in_front && in_front->is_motion();
}

/// Whether a code near the G of a face, which is neither for a face nor a motion, takes such arguments.
bool Executor::fits_near_code(const syntax::Instruction& g, const Arguments& arguments) const {
  const dialect::GCodeSet near = dialect::codes_near(number_of(line_.command(g), line_.text));
  for (std::size_t row = 0; row < std::size(dialect::kGCodes); ++row) {
    const GCode& code = dialect::kGCodes[row];
    const bool is_near = (near >> row & 1) != 0 && !code.mounts_face() && !code.is_motion();
    if (is_near && takes(code, arguments.present())) return true;
  }
  return false;
}

/// Handles a G with arguments that it does not take: a code near it that takes them may have been meant.
void Executor::doubt_near_g(const syntax::Instruction& g, const Arguments& arguments) {
  doubt(dialect::codes_near(number_of(line_.command(g), line_.text)), arguments.present());
}

/// Handles a G without the arguments that it needs: a code near it that needs none may have been meant (G2 for G27).
/// Units and dimensions are such codes only where the line has other words.
void Executor::doubt_lone_g(const syntax::Instruction& g) {
  if (repetition_is_reported(*g.g())) return;  // G29 G29 X0
  const bool is_alone = !line_.has(syntax::LineTree::kAloneViolated);
  const dialect::GCodeSet near = dialect::codes_near(number_of(line_.command(g), line_.text));
  for (std::size_t row = 0; row < std::size(dialect::kGCodes); ++row) {
    const GCode& code = dialect::kGCodes[row];
    const bool is_near = (near >> row & 1) != 0 && !code.takes_arguments();
    if (is_near && !(is_alone && code.misplaced != dialect::kNoDiagnostic)) doubt(code);
  }
}

/// The G directly before some words, which takes none; null if there is no such G.
const syntax::Instruction* Executor::g_before(const Arguments& arguments) const {
  const auto first = static_cast<std::size_t>(&arguments.first() - line_.words.data());
  const auto is_before = [&](const syntax::Instruction& it) {
    return it.g() && !it.g()->takes_arguments() && it.command + 1u == first;
  };
  const auto g = std::find_if(line_.instructions.begin(), line_.instructions.end(), is_before);
  return g == line_.instructions.end() ? nullptr : &*g;
}

/// Whether words follow a G that has a finding of its own: G40 P2 for G04.
bool Executor::follows_reported_g(const Arguments& arguments) const {
  const syntax::Instruction* const g = g_before(arguments);
  if (!g) return false;
  const syntax::Span place = line_.command(*g).span();
  const auto is_here = [&](const syntax::Finding& finding) { return finding.span == place; };
  return last_reported_ == place || std::any_of(line_.findings.begin(), line_.findings.end(), is_here);
}

/// Handles words that the G before them does not take (G93 X10): a code near it may have been meant. Units and
/// dimensions often stand before coordinates.
void Executor::doubt_code_before(const Arguments& arguments) {
  const syntax::Instruction* const g = g_before(arguments);
  if (!g || g->g()->misplaced != dialect::kNoDiagnostic) return;
  doubt_near_g(*g, arguments);
  if (g->g()->group != ModalGroup::None) doubt(g->g()->group);
}

/// The G whose letter a number may have lost; null if there is none.
static const GCode* lost_g(int number) {
  return number >= 0 && number <= 999 ? dialect::g_code(static_cast<std::size_t>(number)) : nullptr;
}

/// Handles a number whose letter is lost (D58). It may have been a motion (01), a tool change (06), a mode (49), else
/// the coordinate of some axis, a feed, a speed or a register. Everything that depends on it becomes unknown, so that
/// no second finding follows.
void Executor::allow_for_lost_letter() {
  const Word* const number = line_.number_without_letter();
  if (!number) return;
  sink_.step(BlockStep::LostLetter, state_);
  state_.spindle = Spindle::Unknown;
  state_.speed_given = true;
  const int value = number->is_plain_integer() ? number->whole().value_or(-1) : -1;
  const bool is_assigned = line_.words.size() > 1 && line_.words[1].letter == syntax::kAssign;
  if (is_assigned && dialect::is_register(value)) return sink_.assign(value, std::numeric_limits<double>::quiet_NaN());
  if (dialect::is_motion_number(value)) return make_motion_illegible();
  const GCode* const code = lost_g(value);
  if (value == dialect::kToolChange) {
    state_.tool_selected = true;
  } else if (code && code->group == ModalGroup::Interpolation) {
    allow_for_lost_g(*code);
  } else {
    if (number->letter == syntax::kNumber) {  // Not in H27, where the G of a G27 was hit wrong.
      blur_axes_not_named();
      state_.feed_reported = true;
      state_.feed_on_rapid = false;
    }
    if (code && code->group != ModalGroup::None) allow_for_lost_g(*code);
  }
}

/// Handles a number that may be a modal G without its letter. The G takes effect as far as that is harmless if it was
/// none, and what is in force is not known until the next G of its group.
void Executor::allow_for_lost_g(const GCode& code) {
  if (!would_change(code)) return;
  doubt(code.group);
  if (code.is_frame()) {
    frame_is_lost_ = true;
    leave_face();
    state_.unknown = kAllAxes;
    if (code.group == ModalGroup::Workpiece) state_.workpiece_unknown = kLinearAxes;
  } else if (code.group == ModalGroup::Units || code.group == ModalGroup::Distance) {
    state_.unknown = kAllAxes;
    state_.set_mode(code);
  } else if (code.group != ModalGroup::CutterCompensation || code.role == GRole::CompensationOff) {
    state_.set_mode(code);
  }
}

/// Handles a statement of another control that may move the tool there, or call lines that do: where it is, the motion
/// in force, the spindle and the tool are then unknown.
void Executor::allow_for_call() {
  sink_.step(BlockStep::LostLetter, state_);
  make_motion_illegible();
  blur_axes_not_named();
  state_.spindle = Spindle::Unknown;
  state_.speed_given = true;
  state_.feed_reported = true;
  state_.tool_selected = true;
}

/// A second N may be an M that was hit wrong (N10 N06 T101001).
void Executor::allow_for_wrong_line_number() {
  const auto is_number = [](const syntax::Finding& finding) { return finding.id == "invalid-line-number"_diag; };
  if (std::none_of(line_.findings.begin(), line_.findings.end(), is_number)) return;
  sink_.step(BlockStep::IllegibleFunction, state_);
  state_.spindle = Spindle::Unknown;
}

/// Handles a `=` that may have been that of a register (= 1, B1 = 1): any register may have been assigned.
void Executor::allow_for_lost_register() {
  const auto is_stray = [](const syntax::Finding& finding) { return finding.id == "assignment-without-register"_diag; };
  const auto finding = std::find_if(line_.findings.begin(), line_.findings.end(), is_stray);
  if (finding == line_.findings.end()) return;
  const auto is_before = [&](const Word& word) { return word.end <= finding->span.begin; };
  const auto after = std::find_if_not(line_.words.begin(), line_.words.end(), is_before);
  const bool names_other =
      after != line_.words.begin() && dialect::contains(dialect::letters("XYZIJKRPQS"), (after - 1)->letter);
  for (int reg = 1; !names_other && reg <= dialect::kRegisterCount; ++reg)
    sink_.assign(reg, std::numeric_limits<double>::quiet_NaN());
}

/// Allows for what the findings of the line leave open.
void Executor::allow_for_findings() {
  allow_for_lost_letter();
  allow_for_wrong_line_number();
  allow_for_lost_register();
  garbled_ = garbled_letters();
}

/// Whether the digits from a place on, up to the next character that is neither digit nor blank, are a number of at
/// least 100.
static bool is_high_from(std::string_view text, std::size_t at) {
  double value = 0;
  for (; at < text.size() && ((text[at] >= '0' && text[at] <= '9') || text[at] == ' ' || text[at] == '\t'); ++at)
    if (text[at] >= '0' && text[at] <= '9') value = 10 * value + (text[at] - '0');
  return value >= 100;
}

/// The letters that a number may have lost which goes on with that of the word before it, so that neither can be read:
/// C8.4 447.38, X10 -20. An F has a high number. Nothing where a point was hit twice.
static dialect::LetterSet letters_lost_inside(const Word& word, std::string_view line) {
  if (!word.has(Word::kMalformed) || word.letter < 'A') return 0;
  const std::string_view number = line.substr(word.begin + 1, word.end - word.begin - 1);
  char before = word.letter;
  bool has_digit = false;
  std::size_t point = std::string_view::npos;
  std::size_t after_blank = 0;
  for (std::size_t at = 0; at < number.size(); ++at) {
    const char c = number[at];
    if (c == ' ' || c == '\t') {
      after_blank = at + 1;
      continue;
    }
    const bool has_sign = (c == '-' || c == '+') && has_digit;
    const bool has_second_point = c == '.' && point != std::string_view::npos && before != '.';
    if (has_sign || has_second_point) {
      const std::size_t start = has_second_point && after_blank > point ? after_blank : at + 1;
      return is_high_from(number, start) ? dialect::kMotionLetters : dialect::kMotionLetters & ~dialect::letters("F");
    }
    has_digit |= c >= '0' && c <= '9';
    if (c == '.') point = at;
    before = c;
  }
  return 0;
}

/// Whether a word may be another whose letter was hit wrong: it has been reported, and it is neither the T of a tool
/// change nor a G of other controls.
bool Executor::may_be_garbled(const Word& word) const {
  const auto is_reported_as = [&](auto is_wanted) {
    return std::any_of(line_.findings.begin(), line_.findings.end(), [&](const syntax::Finding& finding) {
      return finding.span.begin == word.begin && is_wanted(finding.id);
    });
  };
  const auto is_any = [](dialect::DiagnosticId) { return true; };
  const auto is_of_g = [](dialect::DiagnosticId id) {
    return id == "unsupported-g"_diag || id == "invalid-g-number"_diag;
  };
  const auto changes_tool = [&](const syntax::Instruction& it) {
    return it.kind == syntax::InstructionKind::ToolChange && it.number == word.owner;
  };
  switch (word.letter) {
    case 'T':
      return !word.is_tool() && is_reported_as(is_any) &&
             std::none_of(line_.instructions.begin(), line_.instructions.end(), changes_tool);
    case 'G':
      return word.value >= 100 && is_reported_as(is_of_g) &&
             !dialect::is_of_other_controls(number_of(word, line_.text), 0);
    case 'N':
    case 'V':
      return is_reported_as(is_any);
    default:
      return word.letter == syntax::kError && syntax::is_foreign_word(line_.text_of(word.span())) &&
             is_reported_as(is_any);
  }
}

/// The letters that may have been meant by a word: those of the keys beside its own, or that of a number inside it.
dialect::LetterSet Executor::letters_meant_by(const Word& word) const {
  const dialect::LetterSet lost = letters_lost_inside(word, line_.text);
  return may_be_garbled(word) ? lost | dialect::letters_beside(line_.text[word.begin]) : lost;
}

/// The letters that the line may have, in place of others: D1000 may be F1000 (D F), T30 in a motion R30 or Y30.
dialect::LetterSet Executor::garbled_letters() const {
  dialect::LetterSet meant = 0;
  dialect::LetterSet present = 0;
  for (const Word& word : line_.words) {
    if (word.letter >= 'A' && word.letter <= 'Z') present |= dialect::letter_bit(word.letter);
    meant |= letters_meant_by(word);
  }
  return meant & ~present;
}

/// The axes that a garbled word may have named are unknown, and alone it may have been the F of the motions below.
void Executor::blur_garbled_axes() {
  if (feed_move_ || rapid_move_) {
    state_.unknown |= axes_of(garbled_);
    return;
  }
  const auto may_be_feed = [&](const Word& word) {
    return dialect::contains(word.value >= 100 ? letters_meant_by(word) : letters_lost_inside(word, line_.text), 'F');
  };
  if (may_have(dialect::letters("F")) && std::any_of(line_.words.begin(), line_.words.end(), may_be_feed))
    state_.feed_reported = true;
}

/// Handles a line that holds no word that can be read: D1000, for an F1000.
void Executor::allow_for_unreadable_line() {
  allow_for_findings();
  blur_garbled_axes();
}

}  // namespace isocnc::execution
