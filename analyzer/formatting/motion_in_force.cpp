#include "analyzer/formatting/motion_in_force.h"

namespace isocnc::formatting {

using syntax::Instruction;
using syntax::InstructionKind;

/// What the author of a line with a finding meant is for the author to say.
void MotionInForce::Motion::pass(const syntax::LineTree& line) {
  for (const Instruction& instruction : line.instructions)
    if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && instruction.g()->is_motion())
      number = static_cast<std::uint8_t>(instruction.g()->number);
  if (!line.findings.empty()) number = kUnknown;
}

void MotionInForce::leave(const syntax::LineTree& line) {
  if (paths_.live.empty()) return;
  paths_.pass(line, [&](Motion& motion) { motion.pass(line); });
  if (!line.findings.empty()) paths_.live.number = kUnknown;  // Nor need an M02 be meant as the end.
}

}  // namespace isocnc::formatting
