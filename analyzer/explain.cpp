#include "analyzer/explain.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "analyzer/examples.h"
#include "interpreter/configuration/show.h"
#include "interpreter/text/unicode.h"

namespace isocnc::analyzer {

using dialect::Cause;
using dialect::DiagnosticDef;
using dialect::DiagnosticId;
using dialect::Language;
using dialect::Text;

static constexpr Text kSection = {"specification", "specifica"};
static constexpr Text kWrong = {"Wrong:", "Sbagliato:"};
static constexpr Text kRight = {"Right:", "Giusto:"};

/// Such as `warning`; `info, off by default`; `warning, reported by isolint --verify and isorun --verify`.
static std::string severity_text(const DiagnosticDef& def, Language language) {
  static constexpr Text kOff = {", off by default", ", disattivata di norma"};
  static constexpr Text kRuns = {", reported by isolint --verify and isorun --verify",
                                 ", segnalato da isolint --verify e isorun --verify"};
  return fmt::format("{}{}{}", dialect::severity_name(def.severity, language), def.is_off ? kOff.in(language) : "",
                     def.is_reported_by_runs() ? kRuns.in(language) : "");
}

/// The text folded at 78 columns, its first line after `first_indent`, the others after `indent`; a UTF-8 letter counts
/// as one.
static std::string folded(std::string_view text, std::string_view first_indent = {}, std::string_view indent = {}) {
  std::string result(first_indent);
  std::size_t column = first_indent.size();
  bool is_start = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    const std::size_t width = text::column_of(word, word.size()) - 1;
    if (!is_start && column + 1 + width > 78) {
      result += fmt::format("\n{}", indent);
      column = indent.size();
      is_start = true;
    }
    if (!is_start) {
      result += ' ';
      ++column;
    }
    result += word;
    column += width;
    is_start = false;
    at = end + 1;
  }
  return result + '\n';
}

static constexpr std::string_view kIndent = "    ";
static constexpr std::string_view kMessageIndent = "      ";

/// The program, indented; below the marked line its mark and `message`.
static std::string shown(std::string_view program, std::string_view message = {}) {
  const MarkedProgram marked = read_marked(program);
  std::string result;
  std::size_t line = 0;
  for (std::size_t at = 0; at < marked.text.size(); ++line) {
    const std::size_t end = std::min(marked.text.find('\n', at), marked.text.size());
    result += fmt::format("{}{}\n", kIndent, marked.text.substr(at, end - at));
    if (marked.has_mark && line == marked.line) {
      result += fmt::format("{}{}{}\n", kIndent, std::string(marked.begin, ' '),
                            std::string(std::max<std::size_t>(1, marked.end - marked.begin), '^'));
      if (!message.empty()) result += folded(fmt::format("= {}", message), kIndent, kMessageIndent);
    }
    at = end + 1;
  }
  return result;
}

/// The wrong programs of a code, one for each cause, with the messages that they give.
static std::string shown_wrong(DiagnosticId id, Language language) {
  std::string result;
  for (std::uint8_t number = 0; number < dialect::cause_count(dialect::definition(id)); ++number) {
    const Cause cause{id, number};
    const std::optional<Example> example = example_of(cause);
    if (!result.empty()) result += '\n';
    result += shown(wrong_program(cause), example ? example->message(language) : "");
  }
  return result;
}

/// What the fixes of a code do; or why there is none.
static std::vector<std::string> fixes_of(DiagnosticId id, Language language) {
  static constexpr Text kKinds[] = {
      {"No fix", "Nessuna correzione"}, {"Safe fix", "Correzione sicura"}, {"Unsafe fix", "Correzione non sicura"}};
  std::vector<std::string> lines;
  for (const fixes::Fix& fix : example_fixes(id))
    lines.push_back(
        fmt::format("{}: {}", kKinds[static_cast<std::size_t>(fix.safety)].in(language), fix.title_in(language)));
  return lines;
}

/// Such as `lint.options.longestDwell, else 120 s`: the keys of isocnc.json that affect a code.
static std::vector<std::string> keys_of(std::string_view code, Language language,
                                        const std::function<std::string(std::string_view path)>& named) {
  static constexpr Text kElse = {", else ", ", altrimenti "};
  std::vector<std::string> lines;
  for (const configuration::CodeOption& option : configuration::options_of(code, language))
    lines.push_back(named(option.path) +
                    (option.fallback.empty() ? "" : std::string(kElse.in(language)) + option.fallback));
  return lines;
}

std::string explain(dialect::DiagnosticId id, Language language) {
  const DiagnosticDef& def = dialect::definition(id);
  std::string result = fmt::format("{} {} ({}, {} {})\n{}\n\n", def.code, def.name, severity_text(def, language),
                                   kSection.in(language), def.section, def.title.in(language));
  result += folded(def.explanation.in(language));
  if (!def.wrong.empty()) result += fmt::format("\n{}\n{}", kWrong.in(language), shown_wrong(id, language));
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

/// A code's section of the page. The English one quotes the Italian text, since findings in both languages lead there.
static std::string rules_section(const DiagnosticDef& def, Language language) {
  static constexpr Text kMachinePage = {"machine.md", "macchina.md"};
  static constexpr Text kConfigurationPage = {"configuration.md#keys", "configurazione.md#chiavi"};
  static constexpr Text kOption = {"Option", "Opzione"};
  std::string section = fmt::format("\n## {} {}\n\n", def.code, def.name);
  section += fmt::format("**{}** · {} · {} {}\n\n{}\n", def.title.in(language), severity_text(def, language),
                         kSection.in(language), def.section, def.explanation.in(language));
  if (language == Language::English) section += fmt::format("\n> **{}.** {}\n", def.title.it, def.explanation.it);
  const DiagnosticId id{static_cast<std::uint8_t>(&def - dialect::kDiagnostics)};
  if (!def.wrong.empty()) section += fmt::format("\n{}\n\n{}", kWrong.in(language), shown_wrong(id, language));
  if (!def.right.empty()) section += fmt::format("\n{}\n\n{}", kRight.in(language), shown(def.right));
  section += '\n';
  for (const std::string& fix : fixes_of(id, language)) section += fmt::format("- {}\n", fix);
  const auto linked = [language](std::string_view path) {
    return fmt::format("[`{}`]({})", path,
                       (path.starts_with("machine.") ? kMachinePage : kConfigurationPage).in(language));
  };
  for (const std::string& key : keys_of(def.code, language, linked))
    section += fmt::format("- {}: {}\n", kOption.in(language), key);
  return section;
}

std::string rules_page(Language language) {
  static constexpr Text kIntroduction = {
      "# Codes\n\n"
      "What `isolint` reports, and `isorun` where it says so, in English and Italian ([in italiano](it/codici.md)). "
      "`isolint --explain CODE` shows the same in the terminal.\n"
      "This page is made from the table in `interpreter/dialect/diagnostic_table.cpp` (`isolint --rules-page`).\n",
      "# Codici\n\n"
      "Che cosa segnala `isolint`, e `isorun` dove è scritto ([in English](../rules.md)). "
      "`isolint --lang it --explain CODICE` mostra lo stesso nel terminale.\n"
      "Questa pagina nasce dalla tabella in `interpreter/dialect/diagnostic_table.cpp` (`isolint --lang it "
      "--rules-page`).\n"};
  std::string page(kIntroduction.in(language));
  for (const DiagnosticDef& def : dialect::kDiagnostics) page += rules_section(def, language);
  return page;
}

}  // namespace isocnc::analyzer
