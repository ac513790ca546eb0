#include "analyzer/translation/program_writer.h"

#include <algorithm>

namespace isocnc::translation {

/// A comment of the original. One without its closing parenthesis would be an error here.
static std::string written_comment(std::string_view comment) {
  const bool is_open = comment.front() == '(' && comment.back() != ')';
  return is_open ? ";" + std::string(comment.substr(1)) : std::string(comment);
}

void ProgramWriter::begin_block(std::string_view label, const std::vector<std::string_view>& comments) {
  label_ = label;
  comments_.clear();
  for (const std::string_view comment : comments)
    (comments_ += comments_.empty() ? "" : " ") += written_comment(comment);
}

void ProgramWriter::end_block() {
  const auto is_code = [](const WrittenLine& line) { return line.is_code; };
  const auto code_lines = std::count_if(lines_.begin(), lines_.end(), is_code);
  const bool holds_whole_line =
      std::any_of(lines_.begin(), lines_.end(), [](const WrittenLine& l) { return !l.is_code; });
  if (code_lines != 1 && !comments_.empty() && !(code_lines == 0 && holds_whole_line)) {
    const bool takes_label = code_lines == 0 && !label_.empty();
    end_line(takes_label ? label_ + " " + comments_ : comments_);
  }
  for (const WrittenLine& line : lines_) {
    std::string text = line.text;
    if (line.is_code) {
      if (!label_.empty()) text.insert(0, label_ + " ");
      label_.clear();
      if (code_lines == 1 && !comments_.empty()) text += " " + comments_;
    }
    end_line(text);
  }
  lines_.clear();
}

}  // namespace isocnc::translation
