#include "analyzer/fixing/unified_diff.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "interpreter/system/source_file.h"
#include "interpreter/text/characters.h"
#include "interpreter/text/unicode.h"

namespace isocnc::fixing {

/// The first line of `text` with its end.
static std::string_view first_line(std::string_view text) {
  const char* const end = text.data() + text.size();
  const char* const after = text::next_line(text.data(), end);
  return text.substr(0, static_cast<std::size_t>(after - text.data()));
}

static void append(std::string& text, char mark, std::string_view line) {
  text += mark;
  text += line;
  if (!line.ends_with('\n')) text += "\n\\ No newline at end of file\n";
}

/// Removes the first line of `text`, ended by LF as for diff and patch, and returns it.
static std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n') + 1);  // npos + 1 is 0.
  const std::string_view taken = line.empty() ? text : line;
  text.remove_prefix(taken.size());
  return taken;
}

void UnifiedDiff::add(std::string_view before, std::string_view after) {
  while (!before.empty()) {
    const std::string_view old_line = first_line(before);
    const std::string_view new_line = first_line(after);
    before.remove_prefix(old_line.size());
    after.remove_prefix(new_line.size());
    take(old_line, new_line);
  }
}

void UnifiedDiff::take(std::string_view before, std::string_view after) {
  const auto is_whole = [](std::string_view text) { return text.empty() || text.ends_with('\n'); };
  if (open_before_.empty() && open_after_.empty() && is_whole(before) && is_whole(after)) return compare(before, after);
  open_before_ += before;
  open_after_ += after;
  if (!is_whole(open_before_) || !is_whole(open_after_)) return;
  compare(open_before_, open_after_);
  open_before_.clear();
  open_after_.clear();
}

/// Compares lines that correspond to each other.
void UnifiedDiff::compare(std::string_view before, std::string_view after) {
  if (before == after) {
    while (!before.empty()) keep(take_line(before));
    return;
  }
  while (!before.empty()) take_away(take_line(before));
  while (!after.empty()) put_in(take_line(after));
}

std::string UnifiedDiff::marked(std::string_view line, bool is_first) const {
  return is_first && has_byte_order_mark_ ? fmt::format("{}{}", system::kByteOrderMark, line) : std::string(line);
}

void UnifiedDiff::take_away(std::string_view line) {
  begin_change();
  append(removed_, '-', marked(line, before_.line == 0));
  ++before_.line;
  ++before_.hunk_lines;
}

void UnifiedDiff::put_in(std::string_view line) {
  begin_change();
  append(added_, '+', marked(line, after_.line == 0));
  ++after_.line;
  ++after_.hunk_lines;
}

/// Starts a hunk, which includes the unchanged lines before the change.
void UnifiedDiff::begin_change() {
  has_changes_ = true;
  for (Side* const side : {&before_, &after_}) {
    if (!in_hunk_) side->hunk_first = side->line - context_.size();
    side->hunk_lines += context_.size();
  }
  in_hunk_ = true;
  for (const std::string& line : context_) append(hunk_, ' ', line);
  context_.clear();
}

void UnifiedDiff::keep(std::string_view line) {
  hunk_ += removed_;
  hunk_ += added_;
  removed_.clear();
  added_.clear();
  context_.push_back(marked(line, before_.line == 0));
  ++before_.line;
  ++after_.line;
  // Hunks that would touch are joined.
  if (in_hunk_ && context_.size() > 2 * kContext) write_hunk();
  if (!in_hunk_ && context_.size() > kContext) context_.erase(context_.begin());
}

/// Such as `12,7`. By diff's convention, an empty hunk counts from the line before it.
std::string UnifiedDiff::Side::range() const {
  if (hunk_lines == 1) return fmt::format("{}", hunk_first + 1);
  return fmt::format("{},{}", hunk_first + (hunk_lines == 0 ? 0 : 1), hunk_lines);
}

/// Writes the file names; a tab marks for patch the end of a name with blanks.
void UnifiedDiff::write_names() {
  const std::string name = text::printable(std::exchange(name_, {}));
  const std::string_view after = name.find(' ') == std::string::npos ? "" : "\t";
  write_(fmt::format("--- {0}{1}\n+++ {0}{1}\n", name, after));
}

/// Writes the hunk with the first unchanged lines after it; keeps those that may precede the next hunk.
void UnifiedDiff::write_hunk() {
  const std::size_t after = std::min(kContext, context_.size());
  for (std::size_t i = 0; i < after; ++i) append(hunk_, ' ', context_[i]);
  for (Side* const side : {&before_, &after_}) side->hunk_lines += after;
  const std::size_t removed_count = std::max(after, context_.size() - std::min(kContext, context_.size()));
  context_.erase(context_.begin(), context_.begin() + static_cast<std::ptrdiff_t>(removed_count));
  if (!name_.empty()) write_names();
  write_(fmt::format("@@ -{} +{} @@\n", before_.range(), after_.range()));
  write_(hunk_);
  hunk_.clear();
  in_hunk_ = false;
  before_.hunk_lines = after_.hunk_lines = 0;
}

void UnifiedDiff::finish() {
  compare(open_before_, open_after_);
  hunk_ += removed_;
  hunk_ += added_;
  removed_.clear();
  added_.clear();
  if (in_hunk_) write_hunk();
}

}  // namespace isocnc::fixing
