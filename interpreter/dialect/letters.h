#pragma once

#include <cstdint>
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

/// A letter that starts a word, and its meaning (Tav. 1; N: I.2.0, V: I.6).
struct LetterDef {
  char letter;
  Text meaning;
};

/// All letters that may start a word, in alphabetical order.
inline constexpr LetterDef kLetters[] = {
    {'A', {"first component of the face's i axis (G24)", "componente X del versore i della faccia (G24)"}},
    {'B',
     {"rotary axis about Y, degrees; second component of i (G24)",
      "asse rotante intorno a Y, gradi; componente Y di i (G24)"}},
    {'C',
     {"rotary axis about Z, degrees; third component of i (G24)",
      "asse rotante intorno a Z, gradi; componente Z di i (G24)"}},
    {'F', {"feed rate", "avanzamento"}},
    {'G', {"general function", "funzione generale"}},
    {'I',
     {"X of an arc's center; first component of the face's j axis",
      "X del centro dell'arco; componente X del versore j"}},
    {'J', {"Y of an arc's center; second component of j", "Y del centro dell'arco; componente Y del versore j"}},
    {'K', {"Z of an arc's center; third component of j", "Z del centro dell'arco; componente Z del versore j"}},
    {'M', {"miscellaneous function", "funzione miscelanea"}},
    {'N', {"line number", "numero di riga"}},
    {'P',
     {"first component of the face's k axis; dwell in seconds (G04); parameter of an M",
      "componente X del versore k; attesa in secondi (G04); parametro di una M"}},
    {'Q', {"second component of the face's k axis", "componente Y del versore k"}},
    {'R', {"radius of an arc; third component of k", "raggio dell'arco; componente Z del versore k"}},
    {'S', {"spindle speed, revolutions per minute", "velocità del mandrino, giri al minuto"}},
    {'T', {"tool: head, holder and tool in six digits", "utensile: testa, portautensile e utensile in sei cifre"}},
    {'V', {"register", "registro"}},
    {'X',
     {"linear axis X; X of a frame's origin; first component of i (G28)",
      "asse lineare X; X dell'origine; componente X di i (G28)"}},
    {'Y',
     {"linear axis Y; Y of a frame's origin; second component of i (G28)",
      "asse lineare Y; Y dell'origine; componente Y di i (G28)"}},
    {'Z',
     {"linear axis Z; Z of a frame's origin; third component of i (G28)",
      "asse lineare Z; Z dell'origine; componente Z di i (G28)"}},
};

inline constexpr LetterSet kWordLetters = [] {
  LetterSet set = 0;
  for (const LetterDef& def : kLetters) set |= letter_bit(def.letter);
  return set;
}();

/// The meaning of a letter; empty for a letter that starts no word.
Text meaning_of(char letter);

/// The letters of a coordinate, a center, a radius or a component, which a G can take as arguments (Tav. 1), in the
/// order in which programs write them.
inline constexpr std::string_view kArgumentOrder = "XYZABCIJKPQR";
inline constexpr LetterSet kDimensionLetters = letters(kArgumentOrder);

/// The axes that G00 to G03 can move, in the order of a pose, indexed by axis number (I.3.4). A is not one of them
/// (D16).
inline constexpr std::string_view kAxisLetters = "XYZBC";
inline constexpr LetterSet kCoordinateLetters = letters(kAxisLetters);
inline constexpr LetterSet kLinearLetters = letters("XYZ");
inline constexpr LetterSet kRotaryLetters = letters("BC");
inline constexpr LetterSet kCenterLetters = letters("IJK");
inline constexpr LetterSet kCircleLetters = letters("IJKR");
/// The words of a motion, its speed included.
inline constexpr LetterSet kMotionLetters = kCoordinateLetters | kCircleLetters | letters("F");
/// The components of the j and k axes of a face; those of i are A B C or X Y Z.
inline constexpr LetterSet kFaceVectorLetters = letters("IJKPQR");

}  // namespace isocnc::dialect
