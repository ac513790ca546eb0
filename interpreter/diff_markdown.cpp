#include "interpreter/diff_markdown.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"

namespace isocnc::interpreter {

/// The longest text that is shown at once, in lines.
static constexpr std::ptrdiff_t kUnfoldedLines = 25;

/// More backquotes than there are in the text, side by side; at least `fewest`.
static std::string fence_for(std::string_view text, std::size_t fewest) {
  std::size_t longest = 0;
  std::size_t length = 0;
  for (const char c : text) {
    length = c == '`' ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  std::string fence(std::max(fewest, longest + 1), '`');
  return fence;
}

/// A text as code within a line.
static std::string code_span(std::string_view text) {
  const std::string shown = text::printable(text);
  const std::string fence = fence_for(shown, 1);
  // A blank at each end is not shown, and keeps backquotes apart.
  const bool has_quote = shown.starts_with('`') || shown.ends_with('`');
  return has_quote ? fmt::format("{0} {1} {0}", fence, shown) : fence + shown + fence;
}

std::string diff_markdown(std::string_view heading, std::string_view text) {
  const std::string fence = fence_for(text, 3);
  const std::string block = fmt::format("{0}text\n{1}{0}\n", fence, text);
  const std::string title = fmt::format("### {}\n\n", code_span(heading));
  if (std::count(text.begin(), text.end(), '\n') <= kUnfoldedLines) return title + block;
  std::string_view last = text.substr(0, text.size() - 1);
  last.remove_prefix(last.rfind('\n') + 1);
  return fmt::format("{}<details><summary>{}</summary>\n\n{}\n</details>\n", title, last, block);
}

}  // namespace isocnc::interpreter
