#include <fmt/format.h>

#include "analyzer/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::analyzer {

/// `pocket.iso:12:3: error: ... [ISO026]`: one line each, as compilers and grep print them.
class ConciseRenderer final : public Renderer {
 public:
  explicit ConciseRenderer(const Style& style) : style_(style) {}

  void file(std::string_view name, std::string_view text, const Report& report, Output& output) override {
    LineFinder lines(text);
    for (const LocatedFinding& located : report.findings) {
      const std::string_view line = lines.line(located.line);
      const syntax::Finding& finding = located.finding;
      const dialect::DiagnosticDef& def = dialect::definition(finding.id);
      const std::string_view marked = line.substr(finding.span.begin, finding.span.end - finding.span.begin);
      fmt::format_to(std::back_inserter(output.buffer()), "{}:{}:{}: {}: {} [{}]\n", name, located.line + 1,
                     lines.column(finding.span.begin), dialect::severity_name(def.severity, style_.language),
                     printable(dialect::message(finding.id, style_.language, marked, finding.values)), def.code);
      output.relieve();
    }
  }

 private:
  Style style_;
};

std::unique_ptr<Renderer> make_concise_renderer(const Style& style) { return std::make_unique<ConciseRenderer>(style); }

}  // namespace isocnc::analyzer
