#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace isocnc::syntax {

/// Gives the text of ever later lines, and columns in them.
class LineFinder {
 public:
  explicit LineFinder(std::string_view text) : rest_(text) {}
  /// The text of a line without its terminator; lines must be asked for in ascending order, repeats allowed.
  std::string_view line(std::uint64_t index);
  /// column_of() in the line asked for last. Asked for ever later bytes, it walks the line once.
  std::size_t column(std::size_t byte);

 private:
  std::string_view rest_;  // From the start of line `at_`.
  std::uint64_t at_ = 0;
  std::string_view line_;
  bool found_ = false;
  std::size_t walked_ = 0;  // Bytes of the line before `column_`.
  std::size_t column_ = 1;
};

}  // namespace isocnc::syntax
