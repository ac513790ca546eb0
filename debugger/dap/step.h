#pragma once

#include <cstdint>

namespace isocnc::dap {

/// How far a step goes: to the end of the block, or of its instruction that the machine is at.
enum class Step : std::uint8_t { Block, Instruction };

}  // namespace isocnc::dap
