#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "interpreter/text/characters.h"

namespace isocnc::syntax {

/// The text in the place of a number, valid or not (I.2.1, D9).
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN when malformed or beyond what a double can hold.
  const char* end = nullptr;                                ///< One past the last character.
  std::uint32_t digits = 0;
  bool is_signed = false;
  bool has_point = false;
  bool malformed = false;

  /// Whether blanks or comments stand among its characters, from `begin` on.
  bool has_more_inside(const char* begin) const {
    return static_cast<std::size_t>(end - begin) != std::size_t{digits} + (is_signed ? 1 : 0) + (has_point ? 1 : 0);
  }
};

namespace detail {
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
}  // namespace detail

/// Bytes that must be readable where scan_short_number() starts.
inline constexpr std::ptrdiff_t kShortNumberBytes = 17;
/// Maximum number of digits that scan_short_number() reads.
inline constexpr std::uint32_t kShortNumberDigits = 7;

/// Reads a number of few digits, without blanks or comments inside; returns false for any other number. Does not check
/// the text after it. Processes all characters at once, without branches on the number of digits or on the sign, which
/// no processor can predict. Computes the end of the number first, because parsing of the following word depends on it.
[[gnu::always_inline]] inline bool scan_short_number(const char* p, Number& number) {
  static_assert(std::endian::native == std::endian::little);
  // + is 0x2B and - is 0x2D. A comparison would branch.
  const auto from_plus = static_cast<std::uint32_t>(static_cast<unsigned char>(*p - '+'));
  const std::uint32_t is_signed = ((from_plus & ~2u) - 1u) >> 31;
  std::uint32_t others = text::non_digits(p) & ~is_signed;
  if (others == 0) return false;
  const auto whole = static_cast<std::uint32_t>(std::countr_zero(others));
  std::uint32_t length = whole;
  std::uint32_t decimals = 0;
  std::uint64_t bytes;
  std::memcpy(&bytes, p + is_signed, 8);
  bytes ^= 0x3030303030303030ULL;  // A digit becomes its value.
  number.has_point = p[whole] == '.';
  if (number.has_point) {
    others &= others - 1;
    if (others == 0) return false;
    length = static_cast<std::uint32_t>(std::countr_zero(others));
    decimals = length - whole - 1;
    const std::uint64_t in_front = (std::uint64_t{1} << (8 * (whole - is_signed) & 63)) - 1;
    bytes = (((bytes >> 8) ^ bytes) & in_front) ^ (bytes >> 8);  // Removes the point between the digits.
  }
  number.digits = length - is_signed - (number.has_point ? 1 : 0);
  if (number.digits - 1 >= kShortNumberDigits) return false;
  bytes <<= 64 - 8 * number.digits;
  bytes = bytes * 10 + (bytes >> 8);  // Combines eight digits to four pairs, then to two fours, then to one number.
  const std::uint64_t mantissa = (((bytes & 0x000000FF000000FFULL) * 0x000F424000000064ULL) +
                                  (((bytes >> 16) & 0x000000FF000000FFULL) * 0x0000271000000001ULL)) >>
                                 32;
  const std::uint64_t negative = is_signed & (from_plus >> 1);
  const auto signed_mantissa = static_cast<std::int64_t>((mantissa ^ (0 - negative)) + negative);
  number.value = static_cast<double>(signed_mantissa) / detail::kPowersOfTen[decimals];
  number.is_signed = is_signed != 0;
  number.end = p + length;
  return true;
}

/// Reads the number at `p`, where is_number_char() must hold.
Number scan_number(const char* p, const char* end);

}  // namespace isocnc::syntax
