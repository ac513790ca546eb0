#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace isocnc::restart {

inline std::size_t line_count(std::string_view text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// The text from a line on, from 0.
inline std::string rest_of(std::string_view text, std::uint64_t line) {
  std::size_t offset = 0;
  for (; line > 0; --line) offset = text.find('\n', offset) + 1;
  return std::string(text.substr(offset));
}

}  // namespace isocnc::restart
