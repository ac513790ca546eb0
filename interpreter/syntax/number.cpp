#include "interpreter/syntax/number.h"

#include <charconv>
#include <cmath>
#include <string>

namespace isocnc::syntax::detail {

/// Behind the comment at `p`, or null when it is not closed on this line.
static const char* behind_comment(const char* p, const char* end) {
  for (; p != end && !is_line_end(*p); ++p)
    if (*p == ')') return p + 1;
  return nullptr;
}

/// Behind all blanks and closed comments at `p`.
static const char* skip_space(const char* p, const char* end) {
  while (p != end) {
    if (is_blank(*p)) {
      ++p;
    } else if (const char* behind = *p == '(' ? behind_comment(p, end) : nullptr) {
      p = behind;
    } else {
      break;
    }
  }
  return p;
}

bool goes_on_behind_comment(const char* p, const char* end) {
  p = skip_space(p, end);
  return p != end && is_number_char(*p);
}

/// [+-]? digits [. digits?] | [+-]? . digits
static bool is_well_formed(const std::string& text, const Number& number) {
  std::size_t at = number.is_signed ? 1 : 0;
  bool point = false;
  for (; at < text.size(); ++at) {
    if (text[at] == '.' && !point) {
      point = true;
    } else if (!is_digit(text[at])) {
      return false;
    }
  }
  return number.digits > 0;
}

Number scan_any_number(const char* p, const char* end) {
  std::string text;
  Number number;
  while (p != end && is_number_char(*p)) {
    if (is_digit(*p)) ++number.digits;
    if (*p == '.') number.has_point = true;
    if (*p == '+' || *p == '-') number.is_signed = true;
    text.push_back(*p++);
    number.end = p;
    p = skip_space(p, end);
  }
  const bool sign_first = text[0] == '+' || text[0] == '-';
  number.malformed = (number.is_signed && !sign_first) || !is_well_formed(text, number);
  if (number.malformed) return number;
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  double value = 0;
  const auto [behind, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error == std::errc{}) {
    number.value = value + 0.0;  // -0 is 0.
  } else if (text.find_first_of("123456789") > text.find('.')) {
    number.value = 0;  // Too small for a double: an underflow, not an unknown.
  }
  return number;
}

}  // namespace isocnc::syntax::detail
