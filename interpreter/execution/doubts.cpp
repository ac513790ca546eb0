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

}  // namespace isocnc::execution
