#pragma once

#include <string_view>

/// Comparison of words regardless of case, for names typed by users.
namespace isocnc::dialect {

bool same_letter(char a, char b);
bool equal_words(std::string_view a, std::string_view b);
bool begins_with(std::string_view text, std::string_view prefix);
bool ends_with(std::string_view text, std::string_view ending);

}  // namespace isocnc::dialect
