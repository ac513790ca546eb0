#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "interpreter/syntax/characters.h"

namespace isocnc::syntax {

/// What stands where a number should be (I.2.1, D9).
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN when malformed or beyond what a double can hold.
  const char* end = nullptr;                                 ///< Behind its last character.
  std::uint32_t digits = 0;
  bool is_signed = false;
  bool has_point = false;
  bool malformed = false;
};

namespace detail {
inline constexpr double kPowersOfTen[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Any number: blanks and comments inside, any length, malformed ones.
Number scan_any_number(const char* p, const char* end);
/// Whether the number before the comment at `p` goes on behind it (D7).
bool goes_on_behind_comment(const char* p, const char* end);
}  // namespace detail

namespace detail {

/// The digits that start the eight bytes at `p`: how many there are (8: perhaps more), and what they say. Without a branch
/// on the digits, whose number no processor can guess.
inline std::uint32_t leading_digits(const char* p, std::uint64_t& value) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t bytes;
  std::memcpy(&bytes, p, 8);
  bytes ^= 0x3030303030303030ULL;  // A digit becomes its value, anything else more than 9.
  const std::uint64_t others = ((bytes + 0x7676767676767676ULL) | bytes) & 0x8080808080808080ULL;
  const auto count = static_cast<std::uint32_t>(std::countr_zero(others)) / 8;
  bytes = count == 0 ? 0 : bytes << (64 - 8 * count);
  bytes = bytes * 10 + (bytes >> 8);
  value = (((bytes & 0x000000FF000000FFULL) * 0x000F424000000064ULL) +
           (((bytes >> 16) & 0x000000FF000000FFULL) * 0x0000271000000001ULL)) >> 32;
  return count;
}

inline constexpr std::uint64_t kWholePowersOfTen[] = {1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000};

}  // namespace detail

/// Reads a number of at most seven digits before and behind its point, without anything inside; false when it is another,
/// or when there is too little text behind it to tell. Does not look at what follows.
inline bool scan_short_number(const char* p, const char* end, Number& number) {
  if (end - p < 20) return false;
  const bool negative = *p == '-';
  number.is_signed = negative || *p == '+';
  p += number.is_signed ? 1 : 0;
  std::uint64_t mantissa;
  const std::uint32_t digits = detail::leading_digits(p, mantissa);
  p += digits;
  std::uint32_t decimals = 0;
  number.has_point = *p == '.';
  if (number.has_point) {
    std::uint64_t fraction;
    decimals = detail::leading_digits(++p, fraction);
    if (decimals == 8) return false;
    p += decimals;
    mantissa = mantissa * detail::kWholePowersOfTen[decimals] + fraction;
  }
  number.digits = digits + decimals;
  if (digits == 8 || number.digits == 0) return false;
  const double magnitude = static_cast<double>(mantissa) / detail::kPowersOfTen[decimals];
  number.value = negative ? -magnitude : magnitude;
  number.end = p;
  return true;
}

/// Reads the number at `p`, which is a number's character. The digits are gathered in an integer and scaled once: below
/// 2^53 and 10^22 both are exact, so that the quotient is the correctly rounded decimal.
inline Number scan_number(const char* p, const char* end) {
  const char* const begin = p;
  Number number;
  bool negative = false;
  if (*p == '-' || *p == '+') {
    negative = *p == '-';
    number.is_signed = true;
    ++p;
  }
  std::uint64_t mantissa = 0;
  const char* const digits_begin = p;
  while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
  number.digits = static_cast<std::uint32_t>(p - digits_begin);
  std::uint32_t decimals = 0;
  if (p != end && *p == '.') {
    const char* const decimals_begin = ++p;
    while (p != end && is_digit(*p)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
    decimals = static_cast<std::uint32_t>(p - decimals_begin);
    number.digits += decimals;
    number.has_point = true;
  }
  number.end = p;
  while (p != end && is_blank(*p)) ++p;
  if (number.digits == 0 || number.digits > 18 || mantissa >= (std::uint64_t{1} << 53) ||
      (p != end && (is_number_char(*p) || (*p == '(' && detail::goes_on_behind_comment(p, end)))))
    return detail::scan_any_number(begin, end);
  const double magnitude = static_cast<double>(mantissa) / detail::kPowersOfTen[decimals];
  number.value = negative ? -magnitude : magnitude;
  return number;
}

}  // namespace isocnc::syntax
