#pragma once

#include <cstdint>
#include <string_view>

#include "interpreter/dialect/codes.h"

namespace isocnc::dialect {

/// A set of G codes, one bit for each row of kGCodes.
using GCodeSet = std::uint64_t;
static_assert(std::size(kGCodes) <= 64);

constexpr GCodeSet bit_of(const GCode& code) { return GCodeSet{1} << kGCodeRows[code.number]; }

/// The G codes that may have been meant by what is written after a G: those that one slip of the keyboard makes of its
/// digits (one lost, added or replaced, or swapped with the next).
GCodeSet codes_near(std::string_view number);

/// The G code of a number as it is written, an O read as a zero; null if there is none.
const GCode* code_written(std::string_view number);

/// The G code of the first two digits where more follow, those of the next word, whose letter is lost (G01 540); null
/// if there is none.
const GCode* code_in_front(std::string_view number);

/// Whether a number is that of a G of other controls, often left in programs (G54), and no slip for one of this
/// control. Their cycles take arguments.
bool is_of_other_controls(std::string_view number, LetterSet arguments);

/// Whether a number is that of a drilling cycle of other controls.
bool is_drilling_cycle(double number);

/// The letters that may have been meant by another, of a key beside theirs: F by D.
LetterSet letters_beside(char hit);

}  // namespace isocnc::dialect
