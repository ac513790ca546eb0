#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::debuggee {

/// The program that is debugged, as it was when it was launched: later changes of the file have no effect here. Lines
/// count from 0.
class ProgramText {
 public:
  /// Why a file cannot be read, for people.
  struct ReadError {
    std::string message;
  };

  explicit ProgramText(std::string text);
  static std::variant<ProgramText, ReadError> read(const std::filesystem::path& file, dialect::Language language);

  std::string_view text() const { return text_; }
  std::size_t line_count() const { return line_count_; }
  /// The text of a line without its terminator; empty after the last line.
  std::string_view line(std::size_t number) const;

  /// The first line from there on with a block that does something (D13); none after the last one.
  std::optional<std::size_t> executable_line(std::size_t from) const;

 private:
  /// The offset of every 64th line is known; the lines between are counted.
  static constexpr std::size_t kStride = 64;

  std::size_t offset_of(std::size_t line) const;

  std::string text_;
  std::vector<std::size_t> offsets_;  ///< Starts of every kStride-th line.
  std::size_t line_count_ = 0;
};

}  // namespace isocnc::debuggee
