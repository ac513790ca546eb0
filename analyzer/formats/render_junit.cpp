#include <algorithm>

#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/xml.h"

namespace isocnc::formats {

/// JUnit's XML: a suite for each program, a case for each finding. Errors are failures. Warnings and notes are passed
/// cases with output, as they do not affect the exit status either.
class JunitRenderer final : public Renderer {
 public:
  explicit JunitRenderer(const ReportStyle& style) : style_(style) {}

  void begin(std::string& output) override {
    output += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"isolint\">\n";
  }
  void end(std::string& output) override { output += "</testsuites>\n"; }

  void file(const CheckedProgram& program, Output& output) override {
    const auto failures =
        std::count_if(program.report.findings.begin(), program.report.findings.end(),
                      [&](const auto& located) { return located.severity() == dialect::Severity::Error; });
    const std::string file = text::xml_escaped(plain_path(program.name));
    fmt::format_to(std::back_inserter(output.buffer()), "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
                   file, std::max<std::size_t>(1, program.report.findings.size()), failures);
    // A suite without cases would count as not run.
    if (program.report.findings.empty())
      output.buffer() += fmt::format("    <testcase name=\"isolint\" classname=\"{}\"/>\n", file);
    syntax::LineFinder lines(program.text);
    const StepTexts steps(program.text, program.report, style_.language);
    for (const check::LocatedFinding& located : program.report.findings) {
      one(file, show(located, program.report, lines, style_), steps.note(located, program.report), output.buffer());
      output.drain();
    }
    output.buffer() += "  </testsuite>\n";
  }

 private:
  void one(std::string_view file, const ShownFinding& shown, std::string_view path, std::string& out) const {
    const auto to = std::back_inserter(out);
    const std::string message = text::xml_escaped(shown.message);
    const std::string body =
        fmt::format("{}:{}:{}: {}: {} [{}]", file, shown.line, shown.column,
                    dialect::severity_name(shown.severity, style_.language), message, shown.def.code);
    fmt::format_to(to, "    <testcase name=\"{} {} {}:{}\" classname=\"{}\" file=\"{}\" line=\"{}\">\n", shown.def.code,
                   shown.def.name, shown.line, shown.column, file, file, shown.line);
    if (shown.severity == dialect::Severity::Error) {
      fmt::format_to(to, R"(      <failure type="{}" message="{}">{})", shown.def.code, message, body);
      lines_of(path, out);
      out += "</failure>\n";
    } else {
      fmt::format_to(to, "      <system-out>{}", body);
      lines_of(path, out);
      out += "</system-out>\n";
    }
    out += "    </testcase>\n";
  }

  /// Appends the lines of a note, which starts with a line end.
  static void lines_of(std::string_view text, std::string& out) {
    if (!text.empty()) text.remove_prefix(1);
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      out += "\n" + text::xml_escaped(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  ReportStyle style_;
};

std::unique_ptr<Renderer> make_junit_renderer(const ReportStyle& style) {
  return std::make_unique<JunitRenderer>(style);
}

}  // namespace isocnc::formats
