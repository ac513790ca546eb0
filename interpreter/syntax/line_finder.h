#pragma once

#include <cstddef>
#include <string_view>

namespace isocnc::syntax {

/// Finds the text of lines in ascending order, and columns in them.
class LineFinder {
 public:
  explicit LineFinder(std::string_view text) : rest_(text) {}
  /// The text of a line without its terminator. Calls must be in ascending order; repeats are allowed.
  std::string_view line(std::size_t index);
  /// column_of() in the line of the last call of line(). Calls with ascending bytes scan the line only once.
  std::size_t column(std::size_t byte);

 private:
  std::string_view rest_;  // Text from the start of line `at_`.
  std::size_t at_ = 0;
  std::string_view line_;
  bool found_ = false;
  std::size_t walked_ = 0;  // Number of bytes of the line before `column_`.
  std::size_t column_ = 1;
};

}  // namespace isocnc::syntax
