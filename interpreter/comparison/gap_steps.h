#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/comparison/alignment.h"

namespace isocnc::comparison {

/// What becomes of the next actions of a gap: one takes the place of the other, or the first or the second program
/// alone has it.
enum class GapStep : std::uint8_t { Pair, OnlyInA, OnlyInB };

/// Whether a gap of so many actions of both runs is too large to look into.
bool is_too_large(std::size_t a_count, std::size_t b_count);

/// The steps through a gap that change the least. `shift` is the one before the gap, `gap.shift` the one after it. None
/// for a gap that is too large, or if the budget is used up.
std::optional<std::vector<GapStep>> gap_steps(const RunPair& runs, const AlignedPiece& gap,
                                              const geometry::Vec3& shift);

}  // namespace isocnc::comparison
