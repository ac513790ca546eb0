#include "interpreter/dialect/near_names.h"

#include <algorithm>
#include <vector>

#include "interpreter/dialect/any_case.h"
#include "interpreter/dialect/format.h"

namespace isocnc::dialect {

/// The number of letters to insert, delete, change or swap with their neighbor that turns one name into the other.
static std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({change, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && same_letter(a[i - 1], b[j - 2]) && same_letter(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last.back();
}

std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names) {
  constexpr std::size_t kLongest = 64;  // Maximum length of a mistyped name.
  if (typed.size() > kLongest) return std::nullopt;
  const std::size_t limit = std::max<std::size_t>(1, (typed.size() + 2) / 4);
  std::optional<std::string> nearest;
  std::size_t minimum = limit + 1;
  for (const std::string& name : names) {
    const std::size_t steps = distance(typed, name);
    if (steps == minimum) nearest.reset();
    if (steps < minimum) {
      minimum = steps;
      nearest = name;
    }
  }
  if (minimum > limit)  // The typed word is far from all names, but perhaps a prefix of one.
    for (const std::string& name : names)
      if (typed.size() >= 3 && begins_with(name, typed)) return name;
  return nearest;
}

std::string did_you_mean(const std::optional<std::string>& name, Language language) {
  static constexpr Text kQuestion = {"; did you mean {}?", "; forse {}?"};
  return name ? dialect::format(kQuestion, language, *name) : "";
}

}  // namespace isocnc::dialect
