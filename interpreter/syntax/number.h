#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "interpreter/text/characters.h"

namespace isocnc::syntax {

/// Maximum number of digits of a number that has a shape.
inline constexpr std::uint32_t kShapedDigits = 7;

/// All that follows from where the sign, the digits and the point of a short number stand, whatever digits they are. It
/// is looked up by the bytes that are not digits, so that no number costs the steps that find it out. Its size is a
/// power of two, for the sake of the index.
struct alignas(32) NumberShape {
  double divisor = 1;             ///< The power of ten that makes the number of its digits; negative after a minus.
  std::uint64_t whole_bytes = 0;  ///< The bytes of the digits before the point; without a point all bytes.
  std::uint8_t digits = 0;        ///< 0 where there is no such number.
  std::uint8_t flags = 0;         ///< As Number::flags.
  std::uint8_t sign_length = 0;
  std::uint8_t length = 0;  ///< Of the text, with sign and point.
  std::uint8_t free = 0;    ///< The bits of eight bytes that the digits leave free.
};

namespace shapes {

inline constexpr std::uint8_t kSigned = 1;
inline constexpr std::uint8_t kPoint = 2;

/// What a number starts with.
enum class Start : std::uint8_t { Digit, Minus, Plus, Point, Other };
inline constexpr std::size_t kStarts = 5;

/// The number of bytes in which a shape shows: a sign, a point, the digits, and the byte after them.
inline constexpr std::uint32_t kBytes = kShapedDigits + 3;
inline constexpr std::uint32_t kMasks = 1u << kBytes;

constexpr double power_of_ten(std::uint32_t exponent) {
  double power = 1;
  for (; exponent > 0; --exponent) power *= 10;
  return power;
}

constexpr std::uint32_t sign_length(Start start) { return start == Start::Minus || start == Start::Plus ? 1 : 0; }

constexpr NumberShape shape_of(Start start, std::uint32_t whole, bool has_point, std::uint32_t decimals) {
  const std::uint32_t digits = whole + decimals;
  const std::uint32_t sign = sign_length(start);
  return {.divisor = start == Start::Minus ? -power_of_ten(decimals) : power_of_ten(decimals),
          .whole_bytes = has_point ? (std::uint64_t{1} << (8 * whole)) - 1 : ~std::uint64_t{0},
          .digits = static_cast<std::uint8_t>(digits),
          .flags = static_cast<std::uint8_t>((sign != 0 ? kSigned : 0) | (has_point ? kPoint : 0)),
          .sign_length = static_cast<std::uint8_t>(sign),
          .length = static_cast<std::uint8_t>(sign + digits + (has_point ? 1 : 0)),
          .free = static_cast<std::uint8_t>(64 - 8 * digits)};
}

/// No number.
inline constexpr std::uint8_t kNone = 0;
/// What starts with a point, and is no number: looks for the point of its number at the second place, and has no length
/// if there is one.
inline constexpr std::uint8_t kPointAlone = 1;

/// The number of places that kTable.without_point knows.
inline constexpr std::size_t kPlaces = 16;

/// All shapes, and how they are found; together, so that one address is enough.
struct NumberShapes {
  std::array<std::uint16_t, 256> starts{};                  ///< Of the first byte: its Start, times kMasks.
  std::array<std::uint8_t, kStarts * kMasks> with_point{};  ///< Indexes of `shapes`, by the start and the non-digits.
  std::array<std::uint8_t, 128> points{};                   ///< Of each shape, the place where its point must be.
  /// Indexes of `shapes`, by the start and the place of the first byte after the sign that is no digit.
  std::array<std::array<std::uint8_t, kPlaces>, kStarts> without_point{};
  std::array<NumberShape, 128> shapes{};
};
inline constexpr auto kTable = [] {
  NumberShapes table;
  const auto index = [](Start start) { return static_cast<std::uint32_t>(start) * kMasks; };
  const auto set = [&](char first, Start start) {
    table.starts[static_cast<unsigned char>(first)] = static_cast<std::uint16_t>(index(start));
  };
  table.starts.fill(static_cast<std::uint16_t>(index(Start::Other)));
  for (char digit = '0'; digit <= '9'; ++digit) set(digit, Start::Digit);
  set('-', Start::Minus);
  set('+', Start::Plus);
  set('.', Start::Point);
  table.points[kPointAlone] = 1;
  for (std::uint32_t bytes = 0; bytes < kMasks; ++bytes) table.with_point[index(Start::Point) + bytes] = kPointAlone;
  std::uint8_t size = kPointAlone + 1;
  for (const Start start : {Start::Digit, Start::Minus, Start::Plus, Start::Point}) {
    const std::uint32_t sign = sign_length(start);
    const std::uint32_t most = start == Start::Point ? 0 : kShapedDigits;
    for (std::uint32_t whole = start == Start::Digit ? 1 : 0; whole <= most; ++whole)
      for (std::uint32_t decimals = whole == 0 ? 1 : 0; whole + decimals <= kShapedDigits; ++decimals) {
        const NumberShape shape = shape_of(start, whole, true, decimals);
        const std::uint32_t point = sign + whole;
        // Whatever the bytes after its end are.
        for (std::uint32_t more = 0; more < kMasks; more += 2u << shape.length)
          table.with_point[index(start) + (sign | 1u << point | 1u << shape.length | more)] = size;
        table.points[size] = static_cast<std::uint8_t>(point);
        table.shapes[size++] = shape;
      }
    for (std::uint32_t whole = 1; whole <= most; ++whole) {
      table.without_point[static_cast<std::size_t>(start)][sign + whole] = size;
      table.shapes[size++] = shape_of(start, whole, false, 0);
    }
  }
  return table;
}();

}  // namespace shapes

/// The text in the place of a number, valid or not (I.2.1, D9).
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN when malformed or beyond what a double can hold.
  const char* end = nullptr;                                ///< One past the last character.
  std::uint32_t digits = 0;
  std::uint8_t flags = 0;

  static constexpr std::uint8_t kSigned = shapes::kSigned;  ///< Written with + or -.
  static constexpr std::uint8_t kPoint = shapes::kPoint;    ///< Written with a decimal point.
  static constexpr std::uint8_t kMalformed = 4;

  constexpr bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
  /// Whether blanks or comments stand among its characters, from `begin` on.
  bool has_more_inside(const char* begin) const {
    return static_cast<std::size_t>(end - begin) !=
           std::size_t{digits} + (has(kSigned) ? 1 : 0) + (has(kPoint) ? 1 : 0);
  }
};

namespace detail {
inline constexpr double kPowersOfTen[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                          1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
}  // namespace detail

/// Bytes that must be readable where scan_short_number() starts.
inline constexpr std::ptrdiff_t kShortNumberBytes = 17;

/// Reads a number of few digits, without blanks or comments inside; returns false for any other number. Does not check
/// the text after it, and takes `..` for a number that ends where it starts. Processes all characters at once, without
/// branches on the number of digits or on the sign, which no processor can predict.
[[gnu::always_inline]] inline bool scan_short_number(const char* p, Number& number) {
  static_assert(std::endian::native == std::endian::little);
  const shapes::NumberShapes& table = shapes::kTable;
  const std::uint32_t others = text::non_digits(p);
  const std::size_t start = table.starts[static_cast<unsigned char>(*p)];
  std::size_t index = table.with_point[start + others % shapes::kMasks];
  if (p[table.points[index]] != '.') {
    constexpr std::uint32_t kLast = 1u << (shapes::kPlaces - 1);
    const auto place = static_cast<std::size_t>(std::countr_zero((others & ~1u) | kLast));
    index = table.without_point[start / shapes::kMasks][place];
    if (index == shapes::kNone || p[place] == '.') return false;
  }
  const NumberShape& shape = table.shapes[index];
  std::uint64_t bytes;
  std::memcpy(&bytes, p + shape.sign_length, 8);
  bytes ^= 0x3030303030303030ULL;  // A digit becomes its value.
  const std::uint64_t later = bytes >> 8;
  bytes = ((bytes ^ later) & shape.whole_bytes) ^ later;  // Removes the point between the digits.
  bytes <<= shape.free;
  // Combines eight digits to four pairs, then to two fours, then to one number.
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00FF00FF00FF00FFULL;
  bytes = bytes * (1 + (100ULL << 16)) >> 16 & 0x0000FFFF0000FFFFULL;
  bytes = bytes * (1 + (10'000ULL << 32)) >> 32;
  number.value = static_cast<double>(static_cast<std::int32_t>(bytes)) / shape.divisor + 0.0;  // -0 is 0.
  number.end = p + shape.length;
  number.digits = shape.digits;
  number.flags = shape.flags;
  return true;
}

/// Reads the number at `p`, where is_number_char() must hold.
Number scan_number(const char* p, const char* end);

}  // namespace isocnc::syntax
