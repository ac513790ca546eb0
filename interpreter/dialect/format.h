#pragma once

#include <string>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// A text in a language, with the values inserted at its fmt::format placeholders: `{}`, `{:.1f}`.
template <class... Values>
std::string format(const Text& text, Language language, const Values&... values) {
  return fmt::format(fmt::runtime(text.in(language)), values...);
}

}  // namespace isocnc::dialect
