#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/format.h"

namespace isocnc::translation {

/// A number of a translation: at most this many decimals.
inline std::string written_number(double value, int decimals = 6) { return dialect::written_number(value, decimals); }

/// Writes the translation, block after block of the original. A block may take several lines; its line number stands in
/// the first line with code. Its comments follow the code where that is one line, and stand above it otherwise.
class ProgramWriter {
 public:
  /// Each line gets this end.
  explicit ProgramWriter(std::string_view line_end) : line_end_(line_end) {}

  void begin_block(std::string_view label, const std::vector<std::string_view>& comments);
  void add_code(std::string code) { lines_.push_back({std::move(code), true}); }
  /// A line that is a comment as a whole; `text` has no line end.
  void add_remark(std::string_view text) { lines_.push_back({"; " + std::string(text), false}); }
  void end_block();

  std::string take() { return std::move(text_); }

 private:
  struct WrittenLine {
    std::string text;
    bool is_code = false;
  };

  void end_line(std::string_view line) { (text_ += line) += line_end_; }

  std::string_view line_end_;
  std::string label_;
  std::string comments_;
  std::vector<WrittenLine> lines_;
  std::string text_;
};

}  // namespace isocnc::translation
