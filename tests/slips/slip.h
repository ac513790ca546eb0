#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "correct_programs.h"
#include "tests/support/random.h"

namespace isocnc::slips {

/// A slip at one place of a program: some of its lines are replaced by others.
struct Slip {
  std::size_t first = 0;    ///< The first line that is replaced.
  std::size_t removed = 0;  ///< The number of lines that are replaced.
  Lines inserted;           ///< The lines in their place.
};

/// A kind of slip.
struct SlipKind {
  std::string_view name;
  /// A slip of this kind at a random place; nothing where the program, or the place, has nothing for it.
  std::optional<Slip> (*make)(const Lines&, support::Random&);
};

std::span<const SlipKind> slip_kinds();

/// The program with a slip.
Lines slipped(const Lines& program, const Slip& slip);

}  // namespace isocnc::slips
