#include "interpreter/syntax/number.h"

#include <cmath>
#include <string>

#include <fast_float/fast_float.h>

namespace isocnc::syntax {

/// Whether a number before `p` continues after the blanks and comments at `p` (D7).
static bool continues(const char* p, const char* end) {
  p = text::skip_space(p, end);
  return p != end && text::is_number_char(*p);
}

/// Whether the text matches [+-]? digits [. digits?] | [+-]? . digits
static bool is_well_formed(const std::string& text, const Number& number) {
  std::size_t at = number.has(Number::kSigned) ? 1 : 0;
  bool point = false;
  for (; at < text.size(); ++at) {
    if (text[at] == '.' && !point) {
      point = true;
    } else if (!text::is_digit(text[at])) {
      return false;
    }
  }
  return number.digits > 0;
}

/// Reads any number: with blanks or comments inside, of any length, or malformed.
static Number scan_any_number(const char* p, const char* end) {
  std::string text;
  Number number;
  while (p != end && text::is_number_char(*p)) {
    if (text::is_digit(*p)) ++number.digits;
    if (*p == '.') number.flags |= Number::kPoint;
    if (*p == '+' || *p == '-') number.flags |= Number::kSigned;
    text.push_back(*p++);
    number.end = p;
    p = text::skip_space(p, end);
  }
  const bool sign_first = text[0] == '+' || text[0] == '-';
  if ((number.has(Number::kSigned) && !sign_first) || !is_well_formed(text, number)) {
    number.flags |= Number::kMalformed;
    return number;
  }
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  double value = 0;
  fast_float::from_chars(first, text.data() + text.size(), value);
  if (!std::isinf(value)) number.value = value + 0.0;  // -0 is 0, and so is what is too small for a double.
  return number;
}

/// Reads any number that scan_short_number() does not, or that has more after it.
[[gnu::noinline]] static Number scan_rarer_number(const char* p, const char* end) {
  const char* const begin = p;
  Number number;
  bool negative = false;
  if (*p == '-' || *p == '+') {
    negative = *p == '-';
    number.flags |= Number::kSigned;
    ++p;
  }
  // The digits are collected in an integer and scaled once. Below 2^53 and 10^22 both are exact, so that the quotient
  // is the correctly rounded decimal.
  std::uint64_t mantissa = 0;
  const char* const digits_start = p;
  while (p != end && text::is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
  number.digits = static_cast<std::uint32_t>(p - digits_start);
  std::uint32_t decimals = 0;
  if (p != end && *p == '.') {
    const char* const decimals_start = ++p;
    while (p != end && text::is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
    decimals = static_cast<std::uint32_t>(p - decimals_start);
    number.digits += decimals;
    number.flags |= Number::kPoint;
  }
  number.end = p;
  if (number.digits == 0 || number.digits > 18 || mantissa >= (std::uint64_t{1} << 53) || continues(p, end))
    return scan_any_number(begin, end);
  const double magnitude = static_cast<double>(mantissa) / detail::kPowersOfTen[decimals];
  number.value = negative ? 0.0 - magnitude : magnitude;  // -0 is 0.
  return number;
}

Number scan_number(const char* p, const char* end) {
  Number number;
  if (end - p >= kShortNumberBytes && scan_short_number(p, number) && !continues(number.end, end)) return number;
  return scan_rarer_number(p, end);
}

}  // namespace isocnc::syntax
