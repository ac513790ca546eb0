#include "interpreter/dialect/any_case.h"

#include <algorithm>
#include <cctype>

namespace isocnc::dialect {

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool equal_words(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_letter);
}

bool begins_with(std::string_view text, std::string_view prefix) {
  return equal_words(text.substr(0, prefix.size()), prefix);
}

bool ends_with(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() && equal_words(text.substr(text.size() - ending.size()), ending);
}

}  // namespace isocnc::dialect
