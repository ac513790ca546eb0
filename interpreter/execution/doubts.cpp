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
  switch (code.group) {
    case ModalGroup::None:
    case ModalGroup::Motion:  // See may_be_motion().
      return;
    case ModalGroup::Workpiece:
      state_.workpiece_unknown = kLinearAxes;
      break;
    case ModalGroup::Face:
      if (!code.mounts_face() && !state_.face_mounted) return;
      break;
    default:
      if (state_.mode(code.group) == code.number) return;
      break;
  }
  doubt(code.group);
}

/// Leaves open which code of a group is in force. Whatever depends on it is unknown.
void Executor::doubt(ModalGroup group) {
  state_.in_doubt |= State::bit(group);
  state_.written &= static_cast<std::uint16_t>(~State::bit(group));
  if (group == ModalGroup::Distance) state_.unknown = kAllAxes;
  if (group == ModalGroup::Face || group == ModalGroup::Workpiece || group == ModalGroup::Units) blur_linear_axes();
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
  const std::string_view number = number_of(g, line_.text);
  const GCode* const written = dialect::code_written(number);
  const GCode* const in_front = written ? nullptr : dialect::code_in_front(number);
  if (const GCode* const meant = written ? written : in_front) {
    doubt(*meant);
    return !meant->is_motion();
  }
  const dialect::GCodeSet near = dialect::codes_near(number);
  if (!dialect::is_of_other_controls(number, arguments.present())) {
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

/// A second N may be an M that was hit wrong (N10 N06 T101001).
void Executor::allow_for_wrong_line_number() {
  const auto is_number = [](const syntax::Finding& finding) { return finding.id == "invalid-line-number"_diag; };
  if (std::none_of(line_.findings.begin(), line_.findings.end(), is_number)) return;
  sink_.step(BlockStep::IllegibleFunction, state_);
  state_.spindle = Spindle::Unknown;
}

/// Whether a number cannot be read because it goes on with that of the next word, whose letter is lost: C8.4 447.38,
/// X10 -20. A point that was hit twice is none.
static bool has_lost_letter_inside(const Word& word, std::string_view line) {
  if (!word.has(Word::kMalformed) || word.letter < 'A') return false;
  char before = word.letter;
  bool has_digit = false;
  bool has_point = false;
  for (const char c : line.substr(word.begin + 1, word.end - word.begin - 1)) {
    if (c == ' ' || c == '\t') continue;
    const bool starts_again = (c == '.' && has_point && before != '.') || ((c == '-' || c == '+') && has_digit);
    if (starts_again) return true;
    has_digit |= c >= '0' && c <= '9';
    has_point |= c == '.';
    before = c;
  }
  return false;
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

/// The letters in whose place another was hit, the key beside it: D1000 may be F1000 (D F), T30 in a motion R30 or Y30.
dialect::LetterSet Executor::garbled_letters() const {
  constexpr dialect::LetterSet kOfMotion = dialect::letters("XYZBCIJKRF");
  struct Neighbors {
    char letter;
    std::string_view meant;
  };
  static constexpr Neighbors kNeighbors[] = {{'D', "FSX"}, {'E', "R"},  {'G', "FYB"}, {'H', "GJ"},
                                             {'L', "K"},   {'N', "B"},  {'O', "IP"},  {'T', "RYF"},
                                             {'U', "YIX"}, {'V', "CB"}, {'W', "QZ"}};
  const auto is_garbled = [&](const Word& word) {
    if (word.letter == 'T') return word.digits != 6 || !word.is_plain_integer();
    if (word.letter == 'G') return !(word.value < 100);
    if (word.letter == syntax::kError) return word.digits > 0;
    return word.letter == 'N' || word.letter == 'V';
  };
  const auto is_reported = [&](const Word& word) {
    const auto is_here = [&](const syntax::Finding& finding) {
      const bool is_of_g = finding.id == "unsupported-g"_diag || finding.id == "invalid-g-number"_diag;
      return finding.span.begin == word.begin && (word.letter != 'G' || is_of_g);
    };
    return std::any_of(line_.findings.begin(), line_.findings.end(), is_here);
  };
  dialect::LetterSet letters = 0;
  dialect::LetterSet present = 0;
  for (const Word& word : line_.words) {
    if (word.letter >= 'A' && word.letter <= 'Z') present |= dialect::letter_bit(word.letter);
    if (has_lost_letter_inside(word, line_.text)) letters |= kOfMotion;
    if (!is_garbled(word) || !is_reported(word)) continue;
    const char letter = static_cast<char>(line_.text[word.begin] & ~0x20);
    for (const auto& [hit, meant] : kNeighbors)
      if (hit == letter) letters |= dialect::letters(meant);
  }
  return letters & ~present;
}

/// The axes that a garbled word may have named are unknown, and alone it may have been the F of the motions below.
void Executor::blur_garbled_axes() {
  const bool is_alone = !feed_move_ && !rapid_move_;
  const auto is_high = [](const Word& word) { return !(word.value < 100); };
  if (is_alone && may_have(dialect::letters("F")) && std::any_of(line_.words.begin(), line_.words.end(), is_high))
    state_.feed_reported = true;
  if (feed_move_ || rapid_move_) state_.unknown |= axes_of(garbled_);
}

void Executor::pass_unreadable() {
  allow_for_wrong_line_number();
  garbled_ = garbled_letters();
  blur_garbled_axes();
}

}  // namespace isocnc::execution
