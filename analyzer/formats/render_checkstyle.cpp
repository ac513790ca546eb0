#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/xml.h"

namespace isocnc::formats {

/// Checkstyle's XML, which Jenkins, reviewdog and editors read.
class CheckstyleRenderer final : public Renderer {
 public:
  explicit CheckstyleRenderer(const ReportStyle& style) : style_(style) {}

  void begin(std::string& output) override {
    output += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<checkstyle version=\"4.3\">\n";
  }
  void end(std::string& output) override { output += "</checkstyle>\n"; }

  void file(const CheckedProgram& program, Output& output) override {
    syntax::LineFinder lines(program.text);
    output.buffer() += fmt::format("  <file name=\"{}\">\n", text::xml_escaped(plain_path(program.name)));
    for (const check::LocatedFinding& located : program.report.findings) {
      const ShownFinding shown = show(located, program.report, lines, style_);
      fmt::format_to(std::back_inserter(output.buffer()),
                     "    <error line=\"{}\" column=\"{}\" severity=\"{}\" message=\"{}\" source=\"isolint.{}\"/>\n",
                     shown.line, shown.column, dialect::severity_name(shown.severity, dialect::Language::English),
                     text::xml_escaped(shown.message), shown.def.code);
      output.drain();
    }
    output.buffer() += "  </file>\n";
  }

 private:
  ReportStyle style_;
};

std::unique_ptr<Renderer> make_checkstyle_renderer(const ReportStyle& style) {
  return std::make_unique<CheckstyleRenderer>(style);
}

}  // namespace isocnc::formats
