#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace isocnc::expressions {

/// The number that the text is, in digits and nothing else; none for other texts.
template <class Number>
std::optional<Number> read_number(std::string_view digits) {
  Number number = 0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, number);
  if (digits.empty() || error != std::errc{} || rest != end) return std::nullopt;
  return number;
}

}  // namespace isocnc::expressions
