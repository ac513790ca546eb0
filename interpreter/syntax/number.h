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
  const char* end = nullptr;                                ///< Behind its last character.
  std::uint32_t digits = 0;
  bool is_signed = false;
  bool has_point = false;
  bool malformed = false;
};

namespace detail {
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// Any number: blanks and comments inside, any length, malformed ones.
Number scan_any_number(const char* p, const char* end);
/// Whether the number before the comment at `p` goes on behind it (D7).
bool goes_on_behind_comment(const char* p, const char* end);
}  // namespace detail

/// Bytes that must be readable where scan_short_number() starts.
inline constexpr std::ptrdiff_t kShortNumberBytes = 9;

/// Reads a number of at most seven characters behind its sign, without anything inside; false when it is another. Does
/// not look at what follows. Eight bytes are taken at once, and nothing branches on how many of them are digits, which
/// no processor can guess.
[[gnu::always_inline]] inline bool scan_short_number(const char* p, Number& number) {
  static_assert(std::endian::native == std::endian::little);
  // + is 0x2B and - is 0x2D. A comparison would branch.
  const auto from_plus = static_cast<std::uint32_t>(static_cast<unsigned char>(*p - '+'));
  const std::uint64_t is_signed = ((from_plus & ~2u) - 1u) >> 31;
  const std::uint64_t negative = is_signed & (from_plus >> 1);
  p += is_signed;
  std::uint64_t bytes;
  std::memcpy(&bytes, p, 8);
  bytes ^= 0x3030303030303030ULL;  // A digit becomes its value, anything else more than 9.
  const std::uint64_t others = ((bytes + 0x7676767676767676ULL) | bytes) & 0x8080808080808080ULL;
  if (others == 0) return false;
  auto length = static_cast<std::uint32_t>(std::countr_zero(others)) / 8;
  std::uint32_t digits = length;
  std::uint32_t decimals = 0;
  number.has_point = p[length] == '.';
  if (number.has_point) {
    const std::uint64_t behind_point = others & (others - 1);
    if (behind_point == 0) return false;
    const std::uint64_t whole = (std::uint64_t{1} << (8 * length)) - 1;
    bytes = (bytes & whole) | ((bytes >> 8) & ~whole);  // The point goes; its digits close up.
    length = static_cast<std::uint32_t>(std::countr_zero(behind_point)) / 8;
    decimals = length - digits - 1;
    digits = length - 1;
  }
  if (digits == 0) return false;
  bytes <<= 64 - 8 * digits;
  bytes = bytes * 10 + (bytes >> 8);  // Eight digits to four pairs, to two fours, to one number.
  const std::uint64_t mantissa = (((bytes & 0x000000FF000000FFULL) * 0x000F424000000064ULL) +
                                  (((bytes >> 16) & 0x000000FF000000FFULL) * 0x0000271000000001ULL)) >>
                                 32;
  const auto signed_mantissa = static_cast<std::int64_t>((mantissa ^ (0 - negative)) + negative);
  number.value = static_cast<double>(signed_mantissa) / detail::kPowersOfTen[decimals];
  number.is_signed = is_signed != 0;
  number.digits = digits;
  number.end = p + length;
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
  number.value = negative ? 0.0 - magnitude : magnitude;  // -0 is 0.
  return number;
}

}  // namespace isocnc::syntax
