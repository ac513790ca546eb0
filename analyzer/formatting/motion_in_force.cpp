#include "analyzer/formatting/motion_in_force.h"

namespace isocnc::formatting {

using syntax::Instruction;
using syntax::InstructionKind;

/// After a line with a finding the motion is unknown, because the line may not be meant as written.
void MotionInForce::MotionWords::pass(const syntax::LineTree& line) {
  for (const Instruction& instruction : line.instructions)
    if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && instruction.g()->is_motion())
      number = static_cast<std::uint8_t>(instruction.g()->number);
  if (!line.findings.empty()) number = kUnknown;
}

void MotionInForce::leave(const syntax::LineTree& line) {
  if (paths_.live.empty()) return;
  paths_.pass(line, [&](MotionWords& motion) { motion.pass(line); });
  if (!line.findings.empty()) paths_.live.number = kUnknown;  // Even an M02 may not be meant as the end.
}

}  // namespace isocnc::formatting
