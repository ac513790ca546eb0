#include "interpreter/dialect/near_codes.h"

#include <algorithm>
#include <array>
#include <bitset>

#include "interpreter/dialect/foreign_form.h"

namespace isocnc::dialect {

namespace {

/// The digits of a G, or more than any G has.
class Digits {
 public:
  static constexpr std::size_t kMaxKept = 4;  ///< One more than the longest code.

  /// Those at the start of a text, with an O read as a zero. Blanks mean nothing (D6).
  explicit Digits(std::string_view number) {
    for (const char c : number) {
      if (c >= '0' && c <= '9') {
        add(c);
      } else if (c == 'O' || c == 'o') {
        add('0');
      } else if (c != ' ' && c != '\t') {
        break;
      }
    }
  }

  void add(char digit) {
    if (count_ < kMaxKept) kept_[count_] = digit;
    ++count_;
  }
  std::size_t count() const { return count_; }
  /// The number that the first digits are.
  int value_of(std::size_t digits) const {
    int value = 0;
    for (std::size_t i = 0; i < digits; ++i) value = 10 * value + (kept_[i] - '0');
    return value;
  }

 private:
  std::array<char, kMaxKept> kept_{};
  std::size_t count_ = 0;
};

/// The code whose number is written with these digits, with a leading zero or without; empty if there is none.
GCodeSet code_spelled(int number, std::size_t digits) {
  const bool is_spelling = digits == 1 || digits == 2 || (digits == 3 && number >= 100);
  const GCode* const code = is_spelling ? g_code(static_cast<std::size_t>(number)) : nullptr;
  return code ? bit_of(*code) : 0;
}

/// Codes of other controls that are more often a slip here: G50 for G40, G59 for G49.
constexpr int kSlips[] = {5, 7, 8, 11, 12, 13, 15, 16, 22, 23, 25, 26, 32, 45, 46, 47, 50, 51, 58, 59, 60, 62, 75, 79};

using GNumbers = std::bitset<1'000>;

/// Adds the numbers of a mark such as G54 or G5dd; other marks have none.
void add_numbers(std::string_view mark, GNumbers& numbers) {
  if (mark.size() < 2 || mark.size() > 4 || mark.front() != 'G') return;
  const std::string_view digits = mark.substr(1);
  const auto fits = [&](char part, int digit) { return part == 'd' || part == '0' + digit; };
  const int end = digits.size() == 1 ? 10 : digits.size() == 2 ? 100 : 1'000;
  for (int number = end == 10 ? 0 : end / 10; number < end; ++number) {
    int rest = number;
    const bool fits_all = std::all_of(digits.rbegin(), digits.rend(), [&](char part) {
      const int digit = rest % 10;
      rest /= 10;
      return fits(part, digit);
    });
    if (fits_all) numbers.set(static_cast<std::size_t>(number));
  }
}

GNumbers find_foreign_numbers() {
  GNumbers numbers;
  numbers.set(187);  // Smoothness on a Haas: no row of the table, which has no such control.
  for (const ForeignForm& form : foreign_forms()) {
    if (std::find(std::begin(form.diagnostics), std::end(form.diagnostics), "unsupported-g"_diag) ==
        std::end(form.diagnostics))
      continue;
    for (const std::string_view mark : alternatives(form.mark)) add_numbers(mark, numbers);
  }
  for (const int slip : kSlips) numbers.reset(static_cast<std::size_t>(slip));
  return numbers;
}

/// Whether a code of other controls takes arguments there, but neither angles nor centers: a cycle or a call.
bool needs_arguments(int number) { return is_drilling_cycle(number) || number == 33 || number == 65; }

/// The keys beside a letter that starts no word here, or whose word has another form.
struct Neighbors {
  char hit;
  LetterSet meant;
};

constexpr Neighbors kNeighbors[] = {{'D', letters("FSX")}, {'E', letters("R")},   {'G', letters("FYB")},
                                    {'H', letters("GJ")},  {'L', letters("K")},   {'N', letters("B")},
                                    {'O', letters("IP")},  {'T', letters("RYF")}, {'U', letters("YIX")},
                                    {'V', letters("CB")},  {'W', letters("QZ")}};

}  // namespace

const GCode* code_written(std::string_view number) {
  const Digits digits(number);
  const bool may_be_code = digits.count() > 0 && digits.count() <= 3;
  return may_be_code ? g_code(static_cast<std::size_t>(digits.value_of(digits.count()))) : nullptr;
}

const GCode* code_in_front(std::string_view number) {
  const Digits digits(number);
  return digits.count() < 3 ? nullptr : g_code(static_cast<std::size_t>(digits.value_of(2)));
}

bool is_drilling_cycle(double number) {
  return number == 73 || number == 74 || number == 76 || (number > 80 && number < 90);
}

bool is_of_other_controls(std::string_view number, LetterSet arguments) {
  static const GNumbers kNumbers = find_foreign_numbers();
  const Digits digits(number);
  if (digits.count() == 0 || digits.count() > 3 || (arguments & letters("ABCIJK")) != 0) return false;
  const int value = digits.value_of(digits.count());
  return kNumbers.test(static_cast<std::size_t>(value)) && (arguments != 0 || !needs_arguments(value));
}

GCodeSet codes_near(std::string_view number) {
  const Digits digits(number);
  std::size_t count = digits.count();
  if (count == 0 || count > Digits::kMaxKept) return 0;
  const int value = digits.value_of(count);
  if (count > 2 && value < 100) count = 2;  // G042 is what G42 is.
  GCodeSet near = code_spelled(value, count);
  int unit = 1;
  for (std::size_t place = 0; place <= count; ++place, unit *= 10) {
    const int above = value / unit;
    const int below = value % unit;
    for (int lost = 0; lost < 10; ++lost) near |= code_spelled((10 * above + lost) * unit + below, count + 1);
    if (place == count) break;
    const int digit = above % 10;
    const int rest = above / 10;
    near |= code_spelled(rest * unit + below, count - 1);
    for (int meant = 0; meant < 10; ++meant) near |= code_spelled((10 * rest + meant) * unit + below, count);
    const int swapped = 10 * (10 * (rest / 10) + digit) + rest % 10;
    if (place + 1 < count) near |= code_spelled(swapped * unit + below, count);
  }
  return near;
}

LetterSet letters_beside(char hit) {
  const char letter = static_cast<char>(hit & ~0x20);
  for (const Neighbors& each : kNeighbors)
    if (each.hit == letter) return each.meant;
  return 0;
}

}  // namespace isocnc::dialect
