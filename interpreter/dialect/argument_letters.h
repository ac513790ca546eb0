#pragma once

#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// The letters of the arguments of a G, in the order in which programs write them.
inline constexpr std::string_view kArgumentOrder = "XYZABCIJKPQR";

/// What a letter stands for (`LetterDef`); empty where it starts no word.
Text meaning_of(char letter);

}  // namespace isocnc::dialect
