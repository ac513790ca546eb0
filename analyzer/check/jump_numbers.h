#pragma once

#include <cstdint>

#include "analyzer/check/frontier.h"
#include "analyzer/check/outcome.h"

namespace isocnc::check {

/// The numbers that jumps, counted from the top of the program, get by an edit: those from `first` to `end` are
/// replaced by others, and all later ones move by `shift`.
struct JumpNumbers {
  /// The number of a jump that has been replaced: no jump has it.
  static constexpr std::uint32_t kReplaced = static_cast<std::uint32_t>(-1);

  std::uint32_t first = 0;
  std::uint32_t end = 0;
  std::uint32_t shift = 0;  ///< Modulo 2^32, so that jumps can move up, too.

  std::uint32_t of(std::uint32_t jump) const { return jump < first ? jump : jump >= end ? jump + shift : kReplaced; }
  /// Renumbers what is kept of a check below the edit.
  void apply(Frontier& frontier) const;
  void apply(Outcome& outcome) const;
};

}  // namespace isocnc::check
