#include "interpreter/dialect/letters.h"

namespace isocnc::dialect {

Text meaning_of(char letter) {
  for (const LetterDef& def : kLetters)
    if (def.letter == letter) return def.meaning;
  return {};
}

}  // namespace isocnc::dialect
