#include <algorithm>
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

/// Handles a G that the dialect does not have, or that cannot be read: a code near it may have been meant (G277, G4O).
/// Returns whether its number is that of a code that is no motion.
bool Executor::doubt_unknown_g(const Word& g, const Arguments& arguments) {
  const std::string_view number = number_of(g, line_.text);
  const GCode* const written = dialect::code_written(number);
  if (written) {
    if (takes(*written, arguments.present())) doubt(*written);
  } else if (!dialect::is_of_other_controls(number, !arguments.empty())) {
    doubt(dialect::codes_near(number), arguments.present());
  }
  return written && !written->is_motion();
}

/// Handles words that the G before them does not take (G93 X10): a code near it may have been meant. Units and
/// dimensions often stand before coordinates.
void Executor::doubt_code_before(const Arguments& arguments) {
  const auto first = static_cast<std::size_t>(&arguments.first() - line_.words.data());
  const auto is_before = [&](const syntax::Instruction& it) {
    return it.g() && !it.g()->takes_arguments() && it.command + 1u == first;
  };
  const auto g = std::find_if(line_.instructions.begin(), line_.instructions.end(), is_before);
  if (g == line_.instructions.end() || g->g()->misplaced != dialect::kNoDiagnostic) return;
  doubt(dialect::codes_near(number_of(line_.command(*g), line_.text)), arguments.present());
  if (g->g()->group != ModalGroup::None) doubt(g->g()->group);
}

/// A second N may be an M that was hit wrong (N10 N06 T101001).
void Executor::allow_for_wrong_line_number() {
  const auto is_number = [](const syntax::Finding& finding) { return finding.id == "invalid-line-number"_diag; };
  if (std::none_of(line_.findings.begin(), line_.findings.end(), is_number)) return;
  sink_.step(BlockStep::IllegibleFunction, state_);
  state_.spindle = Spindle::Unknown;
}

/// The letters in whose place another was hit, the key beside it: D1000 may be F1000 (D F), T30 in a motion R30 or Y30.
dialect::LetterSet Executor::garbled_letters() const {
  struct Neighbors {
    char letter;
    std::string_view meant;
  };
  static constexpr Neighbors kNeighbors[] = {{'D', "FSX"}, {'E', "R"},  {'G', "FYB"}, {'H', "GJ"},
                                             {'L', "K"},   {'N', "B"},  {'O', "IP"},  {'T', "RYF"},
                                             {'U', "YIX"}, {'V', "CB"}, {'W', "QZ"}};
  const auto is_garbled = [&](const Word& word) {
    if (word.letter == 'T') return word.digits != 6;
    if (word.letter == syntax::kError) return word.digits > 0;
    return word.letter == 'G' || word.letter == 'N' || word.letter == 'V';
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
    if (!is_garbled(word) || !is_reported(word)) continue;
    const char letter = static_cast<char>(line_.text[word.begin] & ~0x20);
    for (const auto& [hit, meant] : kNeighbors)
      if (hit == letter) letters |= dialect::letters(meant);
  }
  return letters & ~present;
}

/// The axes that a garbled word may have named are unknown.
void Executor::blur_garbled_axes() {
  if (feed_move_ || rapid_move_) state_.unknown |= axes_of(garbled_);
}

}  // namespace isocnc::execution
