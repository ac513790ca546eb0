#include "analyzer/formatting/motion_in_force.h"

#include <algorithm>
#include <bit>

namespace isocnc::formatting {

using syntax::Instruction;
using syntax::InstructionKind;
using syntax::LineTree;

/// After a line with a finding the motion is unknown, because the line may not be meant as written.
void MotionInForce::MotionWords::pass(const syntax::LineTree& line) {
  for (const Instruction& instruction : line.instructions)
    if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && instruction.g()->is_motion())
      number = static_cast<std::uint8_t>(instruction.g()->number);
  if (!line.findings.empty()) number = kUnknown;
}

bool is_sound(const LineTree& line, const Instruction& motion, const dialect::GCode& code) {
  dialect::LetterSet given = 0;
  for (std::size_t i = motion.begin; i < motion.end; ++i)
    if (const syntax::Word& word = line.words[i]; word.owner == motion.number && word.letter != 'G')
      given |= dialect::letter_bit(word.letter);
  const bool has_center = std::popcount(given & dialect::kCenterLetters) >= 2;
  const bool has_circle = !code.is_arc() || has_center || dialect::contains(given, 'R');
  return (given & dialect::kCoordinateLetters) != 0 && (given & ~code.arguments) == 0 && has_circle;
}

bool MotionInForce::lacks_words(const LineTree& line) const {
  if (!line.findings.empty()) return true;
  return std::any_of(line.instructions.begin(), line.instructions.end(), [&](const Instruction& instruction) {
    if (!instruction.is_motion()) return false;
    if (instruction.kind == InstructionKind::G) return !is_sound(line, instruction, *instruction.g());
    return is_known() && !is_sound(line, instruction, *dialect::g_code(in_force()));
  });
}

bool MotionInForce::may_go_on(const LineTree& line) const {
  constexpr dialect::LetterSet kArguments = dialect::kMotionLetters | dialect::letters("PQTS");
  return follows_lack_ && !line.words.empty() && dialect::contains(kArguments, line.words.front().letter);
}

void MotionInForce::leave(const syntax::LineTree& line) {
  if (!line.words.empty()) follows_lack_ = lacks_words(line);
  if (paths_.live.empty()) return;
  paths_.pass(line, [&](MotionWords& motion) { motion.pass(line); });
  if (!line.findings.empty()) paths_.live.number = kUnknown;  // Even an M02 may not be meant as the end.
}

}  // namespace isocnc::formatting
