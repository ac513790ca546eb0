#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::formats {

/// `pocket.iso:12:3: error: ... [ISO026]`: one line per finding, as compilers and grep print them.
class ConciseRenderer final : public Renderer {
 public:
  explicit ConciseRenderer(const ReportStyle& style) : style_(style) {}

  void file(const CheckedProgram& program, Output& output) override {
    const std::string name = printable(program.name);
    syntax::LineFinder lines(program.text);
    for (const check::LocatedFinding& located : program.report.findings) {
      const ShownFinding shown = show(located, program.report, lines, style_);
      fmt::format_to(std::back_inserter(output.buffer()), "{}:{}:{}: {}: {} [{}]\n", name, shown.line, shown.column,
                     dialect::severity_name(shown.severity, style_.language), printable(shown.message), shown.def.code);
      output.drain();
    }
  }

 private:
  ReportStyle style_;
};

std::unique_ptr<Renderer> make_concise_renderer(const ReportStyle& style) {
  return std::make_unique<ConciseRenderer>(style);
}

}  // namespace isocnc::formats
