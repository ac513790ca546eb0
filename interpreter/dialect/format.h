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

/// A number as programs and reports write it: without zeros at its end, never `-0`.
inline std::string written_number(double value, int max_decimals) {
  std::string text = fmt::format("{:.{}f}", value, max_decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

}  // namespace isocnc::dialect
