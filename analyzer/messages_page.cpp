#include "analyzer/messages_page.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "analyzer/examples.h"
#include "interpreter/text/unicode.h"

namespace isocnc::analyzer {

using dialect::DiagnosticDef;
using dialect::DiagnosticId;
using dialect::Language;

/// A text in a cell of a table in Markdown.
static std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text::printable(text)) {
    if (c == '|' || c == '<' || c == '*') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// The line of an example with its mark in bold; long lines are cut.
static std::string example_cell(const Example& example) {
  constexpr std::size_t kMaxShown = 60;
  const auto code = [](std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = text.find_last_not_of(" \t") + 1;
    return begin < end ? fmt::format("`{}`", text::printable(text.substr(begin, end - begin))) : std::string();
  };
  if (example.line.size() > kMaxShown) return code(example.line.substr(0, 20)) + " ...";
  const auto [begin, end] = example.finding.span;
  const std::string marked = begin == end ? "" : code(example.line.substr(begin, end - begin));
  const std::string bold = marked.empty() ? "" : fmt::format("**{}**", marked);
  std::string cell;
  for (const std::string& part : {code(example.line.substr(0, begin)), bold, code(example.line.substr(end))})
    if (!part.empty()) cell += (cell.empty() ? "" : " ") + part;
  return cell;
}

/// The rows of a code: a message for each cause, then its fixes.
static std::string message_rows(DiagnosticId id) {
  static constexpr std::string_view kKinds[] = {"", "safe fix", "fix"};
  const DiagnosticDef& def = dialect::definition(id);
  std::string rows;
  for (std::uint8_t number = 0; number < dialect::cause_count(def); ++number) {
    const std::optional<Example> example = example_of({id, number});
    if (example)
      rows += fmt::format("|{}| {} | {} | {} |\n", number == 0 ? fmt::format(" {} ", def.code) : " ",
                          example_cell(*example), cell(example->message(Language::English)),
                          cell(example->message(Language::Italian)));
  }
  for (const fixes::Fix& fix : example_fixes(id)) {
    if (fix.safety == fixes::Safety::None) continue;
    rows += fmt::format("| | {} | {} | {} |\n", kKinds[static_cast<std::size_t>(fix.safety)],
                        cell(fix.title_in(Language::English)), cell(fix.title_in(Language::Italian)));
  }
  return rows;
}

std::string messages_page() {
  static constexpr std::string_view kHead = "| Code | Line | English | Italiano |\n|---|---|---|---|\n";
  std::string page =
      "# Messages\n\n"
      "Every message in English and Italian, with the program line that gives it and the mark in bold: one for each "
      "cause of each\n"
      "code. Below them the titles of the fixes, with `...` for what depends on the program. [Codes](rules.md) "
      "explains "
      "the codes.\n"
      "This page is made from the tables of messages and fixes (`isolint --messages-page`).\n";
  std::string_view group;
  for (const DiagnosticDef& def : dialect::kDiagnostics) {
    const std::string_view first = def.code.substr(0, def.code.find_first_of("0123456789"));
    if (first != std::exchange(group, first)) page += fmt::format("\n## {}\n\n{}", first, kHead);
    page += message_rows(DiagnosticId{static_cast<std::uint8_t>(&def - dialect::kDiagnostics)});
  }
  return page;
}

}  // namespace isocnc::analyzer
