#include "interpreter/dialect/near_codes.h"

#include <algorithm>
#include <string>

namespace isocnc::dialect {

/// Codes of other controls that are often left in programs.
static constexpr int kForeign[] = {10, 20, 21, 30, 31, 43, 44, 52, 53, 54, 55, 56, 57,
                                   63, 64, 66, 67, 68, 69, 80, 95, 96, 97, 98, 99};
/// Cycles, which take arguments, but neither angles nor centers.
static constexpr int kCycles[] = {33, 65, 73, 74, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89};

template <std::size_t count>
static bool is_among(const int (&numbers)[count], int number) {
  return std::find(std::begin(numbers), std::end(numbers), number) != std::end(numbers);
}

/// The digits at the start, with an O read as a zero. Blanks mean nothing (D6).
static std::string digits_of(std::string_view number) {
  std::string digits;
  for (const char c : number) {
    if (c >= '0' && c <= '9') {
      digits += c;
    } else if (c == 'O' || c == 'o') {
      digits += '0';
    } else if (c != ' ' && c != '\t') {
      break;
    }
  }
  return digits;
}

/// Whether `longer` is `shorter` with one more character.
static bool has_one_more(std::string_view longer, std::string_view shorter) {
  if (longer.size() != shorter.size() + 1) return false;
  const auto [there, here] = std::mismatch(shorter.begin(), shorter.end(), longer.begin());
  return std::equal(there, shorter.end(), here + 1);
}

static bool is_one_slip(std::string_view written, std::string_view meant) {
  if (written.size() != meant.size()) return has_one_more(written, meant) || has_one_more(meant, written);
  const auto [here, there] = std::mismatch(written.begin(), written.end(), meant.begin());
  if (here == written.end()) return true;
  if (std::equal(here + 1, written.end(), there + 1)) return true;
  return here + 1 != written.end() && here[0] == there[1] && here[1] == there[0] &&
         std::equal(here + 2, written.end(), there + 2);
}

const GCode* code_written(std::string_view number) {
  const std::string digits = digits_of(number);
  return digits.empty() || digits.size() > 3 ? nullptr : g_code(static_cast<std::size_t>(std::stoi(digits)));
}

const GCode* code_in_front(std::string_view number) {
  const std::string digits = digits_of(number);
  return digits.size() < 3 ? nullptr : g_code(static_cast<std::size_t>(std::stoi(digits.substr(0, 2))));
}

bool is_of_other_controls(std::string_view number, LetterSet arguments) {
  const std::string digits = digits_of(number);
  if (digits.empty() || digits.size() > 3 || (arguments & letters("ABCIJK")) != 0) return false;
  const int value = std::stoi(digits);
  return is_among(kForeign, value) || (arguments != 0 && is_among(kCycles, value));
}

GCodeSet codes_near(std::string_view number) {
  const std::string digits = digits_of(number);
  if (digits.empty()) return 0;
  GCodeSet near = 0;
  for (std::size_t row = 0; row < std::size(kGCodes); ++row) {
    const std::string meant = std::to_string(kGCodes[row].number);
    const std::string padded = meant.size() == 1 ? "0" + meant : meant;
    if (is_one_slip(digits, padded) || is_one_slip(digits, meant)) near |= GCodeSet{1} << row;
  }
  return near;
}

}  // namespace isocnc::dialect
