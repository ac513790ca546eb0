#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::formats {

/// Escapes the characters that end a value in a workflow command; in properties more of them do than in messages.
static std::string escaped(std::string_view text, bool is_property) {
  std::string result;
  for (const char c : text) {
    const bool ends = c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','));
    if (ends) {
      fmt::format_to(std::back_inserter(result), "%{:02X}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result;
}

/// Workflow commands, which GitHub shows as annotations of the lines: `::error file=...,line=...::message`.
class GithubRenderer final : public Renderer {
 public:
  explicit GithubRenderer(const ReportStyle& style) : style_(style) {}

  void file(const CheckedProgram& program, Output& output) override {
    static constexpr std::string_view kCommands[] = {"error", "warning", "notice"};
    const std::string file = escaped(printable(plain_path(program.name)), true);
    syntax::LineFinder lines(program.text);
    const StepTexts steps(program.text, program.report, style_.language);
    for (const check::LocatedFinding& located : program.report.findings) {
      const ShownFinding shown = show(located, program.report, lines, style_);
      fmt::format_to(std::back_inserter(output.buffer()),
                     "::{} file={},line={},endLine={},col={},endColumn={},title={} {}::{}{}\n",
                     kCommands[static_cast<std::size_t>(shown.severity)], file, shown.line, shown.line, shown.column,
                     shown.end_column, shown.def.code, shown.def.name, escaped(printable(shown.message), false),
                     escaped(steps.note(located, program.report), false));
      output.drain();
    }
  }

 private:
  ReportStyle style_;
};

std::unique_ptr<Renderer> make_github_renderer(const ReportStyle& style) {
  return std::make_unique<GithubRenderer>(style);
}

}  // namespace isocnc::formats
