#include "analyzer/formatting/motion_in_force.h"

namespace isocnc::formatting {

using syntax::Instruction;
using syntax::InstructionKind;

static std::uint8_t met(std::uint8_t a, std::uint8_t b) {
  if (a == MotionInForce::kNotReached) return b;
  if (b == MotionInForce::kNotReached) return a;
  return a == b ? a : MotionInForce::kNotKnown;
}

void MotionInForce::enter(const syntax::LineTree& line) {
  if (!line.has_label() || waiting_.empty()) return;
  const auto arrived = waiting_.find(line.label);
  if (arrived == waiting_.end()) return;
  in_force_ = met(in_force_, arrived->second);
  waiting_.erase(arrived);
}

void MotionInForce::leave(const syntax::LineTree& line) {
  if (in_force_ == kNotReached) return;
  for (const Instruction& instruction : line.instructions) {
    if (instruction.kind == InstructionKind::G && instruction.g() != nullptr && instruction.g()->is_motion())
      in_force_ = static_cast<std::uint8_t>(instruction.g()->number);
    if (line.ends_program(instruction)) in_force_ = kNotReached;
  }
  if (!line.findings.empty()) in_force_ = kNotKnown;  // What the author meant is for the author to say.
  if (line.jump == nullptr || !line.jump->has_target) return;
  const auto [waiting, is_first] = waiting_.try_emplace(line.jump->target, in_force_);
  if (!is_first) waiting->second = met(waiting->second, in_force_);
}

}  // namespace isocnc::formatting
