#include "analyzer/formats/rendering.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/system/paths.h"
#include "interpreter/text/characters.h"

namespace isocnc::formats {

/// `(and 68 more lines, to line 91)`.
static std::string note_on_repetitions(std::span<const check::Repetition> repetitions, dialect::Language language) {
  static constexpr dialect::Text kOne = {"(and 1 more line, line {})", "(e un'altra linea, la {})"};
  static constexpr dialect::Text kMore = {"(and {1} more lines, to line {0})", "(e altre {1} linee, fino alla {0})"};
  return dialect::format(repetitions.size() == 1 ? kOne : kMore, language, repetitions.back().line + 1,
                         repetitions.size());
}

std::string message_of(const check::LocatedFinding& located, const check::Report& report, std::string_view line,
                       dialect::Language language) {
  std::string message = syntax::message(located.finding, line, language);
  const std::span<const check::Repetition> repetitions = report.repetitions_of(located);
  if (!repetitions.empty()) message += ' ' + note_on_repetitions(repetitions, language);
  return message;
}

ShownFinding show(const check::LocatedFinding& located, const check::Report& report, syntax::LineFinder& lines,
                  const ReportStyle& style) {
  const syntax::Finding& finding = located.finding;
  const std::string_view line = lines.line(located.line);
  const std::string_view marked = line.substr(finding.span.begin, finding.span.end - finding.span.begin);
  const std::size_t column = lines.column(finding.span.begin);
  return {.def = dialect::definition(finding.id),
          .severity = located.severity(),
          .line_text = line,
          .line = located.line + 1,
          .column = column,
          .end_column = column + column_of(marked, marked.size()) - 1,
          .message = message_of(located, report, line, style.language)};
}

StepTexts::StepTexts(std::string_view text, const check::Report& report, dialect::Language language)
    : language_(language) {
  for (const check::LocatedFinding& located : report.findings)  // Paths of findings that are not shown need no text.
    if (located.path >= 0)
      for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
        texts_[{step.line, step.taken}];
  if (texts_.empty()) return;
  syntax::LineFinder lines(text);
  for (auto& [step, words] : texts_) words = describe_step({step.first, step.second}, lines.line(step.first), language);
}

std::string StepTexts::note(const check::LocatedFinding& located, const check::Report& report) const {
  if (located.path < 0) return {};
  std::string note = fmt::format("\n{}", kReachedThrough.in(language_));
  for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
    fmt::format_to(std::back_inserter(note), "\n{}: {}", step.line + 1, of(step));
  return note;
}

std::string plain_path(std::string_view name) {
  return system::generic_name(system::normal(std::filesystem::path(name)));
}

std::string in_uri(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 0x80 && (std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos);
    if (plain) {
      escaped += c;
    } else {
      fmt::format_to(std::back_inserter(escaped), "%{:02X}", byte);
    }
  }
  return escaped;
}

std::string uri_of(std::string_view name) {
  const std::string path = plain_path(name);
  // On Windows: //server/share/part.iso, c:/part.iso.
  const std::string_view start = path.starts_with("//") ? "file:" : path.starts_with('/') ? "file://" : "file:///";
  return (system::is_absolute(std::filesystem::path(path)) ? std::string(start) : std::string()) + in_uri(path);
}

std::string rule_url(dialect::DiagnosticId id) {
  const dialect::DiagnosticDef& def = dialect::definition(id);
  std::string code(def.code);
  std::transform(code.begin(), code.end(), code.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return fmt::format("{}#{}-{}", ISOCNC_DOCS_URL, code, def.name);
}

std::string describe_step(const check::PathStep& step, std::string_view line_text, dialect::Language language) {
  syntax::ParsedLine parsed(line_text);
  const syntax::LineTree tree = parsed.tree();
  std::string condition = "IF";
  if (tree.jump && tree.jump->has_target)
    condition = printable(tree.text_of({tree.jump->if_span.begin, tree.jump->target_span.end}));
  static constexpr dialect::Text kJumps = {"jumps", "salta"};
  static constexpr dialect::Text kGoesOn = {"does not jump", "non salta"};
  return fmt::format("{}: {}", condition, (step.taken ? kJumps : kGoesOn).in(language));
}

}  // namespace isocnc::formats
