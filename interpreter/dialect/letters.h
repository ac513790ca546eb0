#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// A set of letters, one bit each.
using LetterSet = std::uint32_t;

constexpr LetterSet letter_bit(char letter) { return LetterSet{1} << (letter - 'A'); }

constexpr LetterSet letters(std::string_view text) {
  LetterSet set = 0;
  for (const char letter : text) set |= letter_bit(letter);
  return set;
}

constexpr bool contains(LetterSet set, char letter) {
  return letter >= 'A' && letter <= 'Z' && (set & letter_bit(letter)) != 0;
}

/// The letters that name a coordinate, a center, a radius or a component: what a G can take as an argument (Tav. 1).
inline constexpr LetterSet kDimensionLetters = letters("ABCIJKPQRXYZ");
/// What G00 to G03 can move (I.3.4; A is no axis of theirs, D16).
inline constexpr LetterSet kCoordinateLetters = letters("XYZBC");
inline constexpr LetterSet kLinearLetters = letters("XYZ");
inline constexpr LetterSet kRotaryLetters = letters("BC");
inline constexpr LetterSet kCenterLetters = letters("IJK");

/// A letter that starts a word, and what it stands for (Tav. 1; N: I.2.0, V: I.6).
struct LetterDef {
  char letter;
  Text meaning;
};

/// All letters that may start a word, in alphabetical order.
std::span<const LetterDef> all_letters();

inline constexpr LetterSet kWordLetters = letters("ABCFGIJKMNPQRSTVXYZ");

}  // namespace isocnc::dialect
