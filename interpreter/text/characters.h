#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "interpreter/dialect/letters.h"

namespace isocnc::text {

/// The class of a byte outside comments.
enum class CharClass : std::uint8_t {
  Letter,  ///< Starts a word; either case (D8).
  Digit,
  NumberSign,  ///< + - . and the comma, which is always wrong but belongs to the number around it (D9).
  Blank,       ///< Without meaning (D6).
  LineEnd,
  Open,
  Close,
  Semicolon,
  Equals,
  Compare,  ///< < and >
  Other,    ///< Starts no word (D10).
};

inline constexpr auto kCharClasses = [] {
  std::array<CharClass, 256> classes{};
  classes.fill(CharClass::Other);
  for (char letter = 'A'; letter <= 'Z'; ++letter)
    if (dialect::contains(dialect::kWordLetters, letter)) {
      classes[static_cast<unsigned char>(letter)] = CharClass::Letter;
      classes[static_cast<unsigned char>(letter + ('a' - 'A'))] = CharClass::Letter;
    }
  for (char digit = '0'; digit <= '9'; ++digit) classes[static_cast<unsigned char>(digit)] = CharClass::Digit;
  for (const char sign : {'+', '-', '.', ','}) classes[static_cast<unsigned char>(sign)] = CharClass::NumberSign;
  classes[' '] = classes['\t'] = CharClass::Blank;
  classes['\r'] = classes['\n'] = CharClass::LineEnd;
  classes['('] = CharClass::Open;
  classes[')'] = CharClass::Close;
  classes[';'] = CharClass::Semicolon;
  classes['='] = CharClass::Equals;
  classes['<'] = classes['>'] = CharClass::Compare;
  return classes;
}();

inline CharClass char_class(char c) { return kCharClasses[static_cast<unsigned char>(c)]; }
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }
constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
inline bool is_number_char(char c) {
  const CharClass cls = char_class(c);
  return cls == CharClass::Digit || cls == CharClass::NumberSign;
}
/// The text without blanks at both ends.
constexpr std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}
inline char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c; }

/// The bytes that are not digits among the sixteen from `p` on, one bit each.
inline std::uint32_t non_digits(const char* p) {
#ifdef __SSE2__
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  // Digits become 0 to 9. The highest bit, which movemask takes, is set once anything above 9 is moved up.
  const __m128i values = _mm_xor_si128(bytes, _mm_set1_epi8('0'));
  return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_adds_epu8(values, _mm_set1_epi8(0x7F - 9))));
#else
  std::uint32_t found = 0;
  for (int i = 0; i < 16; ++i) found |= std::uint32_t{!is_digit(p[i])} << i;
  return found;
#endif
}

/// The first CR or LF at or after `p`, or `end`. Checks eight bytes at a time, because comments are long.
inline const char* find_line_end(const char* p, const char* end) {
  constexpr std::uint64_t kOnes = 0x0101010101010101ULL;
  constexpr std::uint64_t kHighs = 0x8080808080808080ULL;
  const auto zero_bytes = [](std::uint64_t x) { return (x - kOnes) & ~x & kHighs; };
  for (; end - p >= 8; p += 8) {
    std::uint64_t chunk;
    std::memcpy(&chunk, p, 8);
    if ((zero_bytes(chunk ^ (kOnes * '\n')) | zero_bytes(chunk ^ (kOnes * '\r'))) != 0) break;
  }
  while (p != end && !is_line_end(*p)) ++p;
  return p;
}

/// The end of the comment that opens with the parenthesis at `p`, or null when it is not closed on this line.
inline const char* skip_closed_comment(const char* p, const char* end) {
  for (; p != end && !is_line_end(*p); ++p)
    if (*p == ')') return p + 1;
  return nullptr;
}

/// The first character after all blanks and closed comments at `p`.
inline const char* skip_space(const char* p, const char* end) {
  while (p != end) {
    if (is_blank(*p)) {
      ++p;
    } else if (const char* after = *p == '(' ? skip_closed_comment(p, end) : nullptr) {
      p = after;
    } else {
      break;
    }
  }
  return p;
}

/// The first character after the terminator at `p` (CR, LF or CRLF, D5), or `p` itself at the end of the text.
inline const char* skip_line_end(const char* p, const char* end) {
  if (p == end) return p;
  if (*p == '\r' && end - p > 1 && p[1] == '\n') return p + 2;
  return p + 1;
}

/// The start of the line after the one at `p`, or `end`.
inline const char* next_line(const char* p, const char* end) { return skip_line_end(find_line_end(p, end), end); }
/// Whole lines from the line start `p` on: at least so many bytes, or all up to `end`.
inline std::string_view whole_lines(const char* p, std::ptrdiff_t bytes, const char* end) {
  return {p, static_cast<std::size_t>(next_line(p + std::min(bytes, end - p), end) - p)};
}

}  // namespace isocnc::text
