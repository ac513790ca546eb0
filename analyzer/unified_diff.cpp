#include "analyzer/unified_diff.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/syntax/characters.h"

namespace isocnc::analyzer {

/// The first line of `text` with its end.
static std::string_view first_line(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* const behind = syntax::skip_line_end(syntax::find_line_end(text.data(), end), end);
  return text.substr(0, static_cast<std::size_t>(behind - text.data()));
}

/// As diff and patch know lines: ended by LF. A CR alone, which ends a line for the control, ends it here as well, so
/// that the diff can be read, though not applied.
static void append(std::string& text, char mark, std::string_view line) {
  text += mark;
  text += line;
  if (line.ends_with('\n')) return;
  text += line.ends_with('\r') ? "\n" : "\n\\ No newline at end of file\n";
}

void UnifiedDiff::add(std::string_view before, std::string_view after) {
  while (!before.empty()) {
    const std::string_view old_line = first_line(before);
    const std::string_view new_line = first_line(after);
    before.remove_prefix(old_line.size());
    after.remove_prefix(new_line.size());
    add_line(old_line, new_line);
    ++line_;
  }
}

void UnifiedDiff::add_line(std::string_view before, std::string_view after) {
  if (before != after) {
    if (removed_.empty()) {
      if (hunk_lines_ == 0) hunk_first_ = line_ - context_.size();
      for (const std::string& line : context_) append(hunk_, ' ', line);
      hunk_lines_ += context_.size();
      context_.clear();
    }
    append(removed_, '-', before);
    append(added_, '+', after);
    ++hunk_lines_;
    has_changes_ = true;
    return;
  }
  hunk_ += removed_;
  hunk_ += added_;
  removed_.clear();
  added_.clear();
  context_.emplace_back(before);
  // Two hunks that would touch are one.
  if (hunk_lines_ > 0 && context_.size() > 2 * kContext) write_hunk();
  if (hunk_lines_ == 0 && context_.size() > kContext) context_.erase(context_.begin());
}

/// With the first lines behind it; what is left may stand before the next one.
void UnifiedDiff::write_hunk() {
  const std::size_t behind = std::min(kContext, context_.size());
  for (std::size_t i = 0; i < behind; ++i) append(hunk_, ' ', context_[i]);
  hunk_lines_ += behind;
  const std::size_t gone = std::max(behind, context_.size() - std::min(kContext, context_.size()));
  context_.erase(context_.begin(), context_.begin() + static_cast<std::ptrdiff_t>(gone));
  if (!name_.empty()) write_(fmt::format("--- {0}\n+++ {0}\n", name_));
  name_.clear();
  const std::string range =
      hunk_lines_ == 1 ? fmt::format("{}", hunk_first_ + 1) : fmt::format("{},{}", hunk_first_ + 1, hunk_lines_);
  write_(fmt::format("@@ -{0} +{0} @@\n", range));
  write_(hunk_);
  hunk_.clear();
  hunk_lines_ = 0;
}

void UnifiedDiff::finish() {
  hunk_ += removed_;
  hunk_ += added_;
  if (hunk_lines_ > 0) write_hunk();
}

}  // namespace isocnc::analyzer
