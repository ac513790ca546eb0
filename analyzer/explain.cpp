#include "analyzer/explain.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/fixes/fix_table.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/configuration/show.h"
#include "interpreter/text/unicode.h"

namespace isocnc::analyzer {

using dialect::DiagnosticDef;
using dialect::DiagnosticId;
using dialect::Language;
using dialect::Text;

static constexpr Text kSection = {"specification", "specifica"};
static constexpr Text kWrong = {"Wrong:", "Sbagliato:"};
static constexpr Text kRight = {"Right:", "Giusto:"};

/// Such as `warning`; `info, off by default`; `warning, reported by isorun`.
static std::string severity_text(const DiagnosticDef& def, Language language) {
  static constexpr Text kOff = {", off by default", ", disattivata di norma"};
  static constexpr Text kRuns = {", reported by isorun", ", segnalato da isorun"};
  return fmt::format("{}{}{}", dialect::severity_name(def.severity, language), def.is_off ? kOff.in(language) : "",
                     def.is_reported_by_runs ? kRuns.in(language) : "");
}

MarkedProgram read_marked(std::string_view program) {
  MarkedProgram marked;
  std::size_t line = 0;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < program.size(); ++i) {
    const std::string_view rest = program.substr(i);
    if (rest.starts_with("[!")) {
      marked.has_mark = true;
      marked.line = line;
      marked.begin = marked.text.size() - line_start;
      ++i;
    } else if (rest.starts_with("!]")) {
      marked.end = marked.text.size() - line_start;
      ++i;
    } else {
      marked.text.push_back(program[i]);
      if (program[i] != '\n') continue;
      ++line;
      line_start = marked.text.size();
    }
  }
  return marked;
}

/// The text folded at 78 columns; a UTF-8 letter counts as one.
static std::string folded(std::string_view text) {
  std::string result;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const std::size_t width = text::column_of(word, word.size()) - 1;
    if (column > 0 && column + 1 + width > 78) {
      result += '\n';
      column = 0;
    }
    if (column > 0) {
      result += ' ';
      ++column;
    }
    result += word;
    column += width;
    at = end + 1;
  }
  return result + '\n';
}

/// The program, indented, with its mark below the line.
static std::string shown(std::string_view program) {
  const MarkedProgram marked = read_marked(program);
  std::string result;
  std::size_t line = 0;
  for (std::size_t at = 0; at < marked.text.size(); ++line) {
    const std::size_t end = std::min(marked.text.find('\n', at), marked.text.size());
    result += fmt::format("    {}\n", marked.text.substr(at, end - at));
    if (marked.has_mark && line == marked.line)
      result += fmt::format("    {}{}\n", std::string(marked.begin, ' '),
                            std::string(std::max<std::size_t>(1, marked.end - marked.begin), '^'));
    at = end + 1;
  }
  return result;
}

/// The fix of the wrong program in the table, if it has one.
static std::optional<fixes::Fix> fix_of_wrong_program(DiagnosticId id) {
  const std::string wrong = read_marked(dialect::definition(id).wrong).text;
  const rules::CheckSetup setup;
  const check::Report report = selection::suppress(check::check_text(wrong, setup), wrong, {});
  fixing::FindingFixes fixes(wrong, report, setup);
  for (const check::LocatedFinding& located : report.findings)
    if (located.finding.id == id) return fixes.offered(located);
  return std::nullopt;
}

/// The effects of a code's fixes, in the wrong program or with `...` for what differs elsewhere; or why there is none.
static std::vector<std::string> fixes_of(DiagnosticId id, Language language) {
  static constexpr Text kKinds[] = {
      {"No fix", "Nessuna correzione"}, {"Safe fix", "Correzione sicura"}, {"Unsafe fix", "Correzione non sicura"}};
  const std::optional<fixes::Fix> example = fix_of_wrong_program(id);
  std::vector<std::string> lines;
  for (const fixes::FixDef& def : fixes::kFixes) {
    if (def.diagnostic != id) continue;
    const bool is_shown = example && example->title.en == def.title.en;
    const fixes::Fix any{.title = def.title, .marked = "...", .what = "..."};
    lines.push_back(fmt::format("{}: {}", kKinds[static_cast<std::size_t>(def.safety)].in(language),
                                (is_shown ? *example : any).title_in(language)));
  }
  if (lines.empty())
    lines.push_back(fmt::format("{}: {}", kKinds[0].in(language), fixes::kMeaningUnknown.in(language)));
  return lines;
}

/// Such as `lint.options.longestDwell, else 120 s`: the keys of isocnc.json that affect a code.
static std::vector<std::string> keys_of(std::string_view code, Language language,
                                        const std::function<std::string(std::string_view path)>& named) {
  static constexpr Text kElse = {", else ", ", altrimenti "};
  std::vector<std::string> lines;
  for (const configuration::CodeOption& option : configuration::options_of(code))
    lines.push_back(named(option.path) +
                    (option.fallback.empty() ? "" : std::string(kElse.in(language)) + option.fallback));
  return lines;
}

std::string explain(dialect::DiagnosticId id, Language language) {
  const DiagnosticDef& def = dialect::definition(id);
  std::string result = fmt::format("{} {} ({}, {} {})\n{}\n\n", def.code, def.name, severity_text(def, language),
                                   kSection.in(language), def.section, def.title.in(language));
  result += folded(def.explanation.in(language));
  if (!def.wrong.empty()) result += fmt::format("\n{}\n{}", kWrong.in(language), shown(def.wrong));
  if (!def.right.empty()) result += fmt::format("\n{}\n{}", kRight.in(language), shown(def.right));
  result += '\n';
  for (const std::string& fix : fixes_of(id, language)) result += fix + '\n';
  static constexpr Text kOption = {"Option in isocnc.json: ", "Opzione in isocnc.json: "};
  const auto named = [&](std::string_view path) { return fmt::format("{}{}", kOption.in(language), path); };
  for (const std::string& key : keys_of(def.code, language, named)) result += key + '\n';
  return result;
}

std::string list_rules(Language language) {
  std::string result;
  for (const DiagnosticDef& def : dialect::kDiagnostics)
    result += fmt::format("{:7} {:8} {:32} {}\n", def.code,
                          def.is_off ? "off" : dialect::severity_name(def.severity, language), def.name,
                          def.title.in(language));
  return result;
}

std::string rules_page() {
  std::string page =
      "# Codes\n\n"
      "What `isolint` reports, and `isorun` where it says so, in English and Italian. `isolint --explain CODE` shows "
      "the "
      "same in the terminal.\n"
      "This page is made from the table in `interpreter/dialect/diagnostic_table.cpp` (`isolint --rules-page`).\n";
  for (const DiagnosticDef& def : dialect::kDiagnostics) {
    page += fmt::format("\n## {} {}\n\n", def.code, def.name);
    page += fmt::format("**{}** · {} · specification {}\n\n", def.title.en, severity_text(def, Language::English),
                        def.section);
    page += fmt::format("{}\n\n> **{}.** {}\n", def.explanation.en, def.title.it, def.explanation.it);
    if (!def.wrong.empty()) page += fmt::format("\nWrong:\n\n{}", shown(def.wrong));
    if (!def.right.empty()) page += fmt::format("\nRight:\n\n{}", shown(def.right));
    page += '\n';
    const auto row = static_cast<std::uint8_t>(&def - dialect::kDiagnostics);
    for (const std::string& fix : fixes_of(DiagnosticId{row}, Language::English)) page += fmt::format("- {}\n", fix);
    const auto linked = [](std::string_view path) {
      return fmt::format("[`{}`]({})", path, path.starts_with("machine.") ? "machine.md" : "configuration.md#keys");
    };
    for (const std::string& key : keys_of(def.code, Language::English, linked))
      page += fmt::format("- Option: {}\n", key);
  }
  return page;
}

}  // namespace isocnc::analyzer
