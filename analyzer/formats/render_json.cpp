#include <nlohmann/json.hpp>

#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/formats/related.h"
#include "analyzer/formats/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::formats {

using OrderedJson = nlohmann::ordered_json;

/// One array of objects, as docs/isolint.md describes them; columns from 1 in code points, ends exclusive.
class JsonRenderer final : public Renderer {
 public:
  explicit JsonRenderer(const ReportStyle& style) : style_(style) {}

  void begin(std::string& output) override { output += "["; }
  void end(std::string& output) override { output += first_ ? "]\n" : "\n]\n"; }

  void file(const CheckedProgram& program, Output& output) override {
    syntax::LineFinder lines(program.text);
    const StepTexts steps(program.text, program.report, style_.language);
    fixing::FindingFixes fixes(program.text, program.report, program.setup);
    for (const check::LocatedFinding& located : program.report.findings) {
      output.buffer() += first_ ? "\n  " : ",\n  ";
      first_ = false;
      const OrderedJson object = to_json(program.name, lines, located, program.report, steps, fixes);
      output.buffer() += object.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
      output.drain();
    }
  }

 private:
  OrderedJson to_json(std::string_view name, syntax::LineFinder& lines, const check::LocatedFinding& located,
                      const check::Report& report, const StepTexts& steps, fixing::FindingFixes& fixes) const {
    const ShownFinding shown = show(located, report, lines, style_);
    OrderedJson object;
    object["file"] = name;
    object["line"] = shown.line;
    object["column"] = shown.column;
    object["endLine"] = shown.line;
    object["endColumn"] = shown.end_column;
    object["severity"] = dialect::severity_name(shown.severity, dialect::Language::English);
    object["code"] = shown.def.code;
    object["name"] = shown.def.name;
    object["message"] = shown.message;
    object["url"] = rule_url(located.finding.id);
    object["fix"] = fix_of(located, fixes);
    object["path"] = nullptr;
    if (located.path >= 0) {
      object["path"] = OrderedJson::array();
      for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
        object["path"].push_back({{"line", step.line + 1}, {"text", steps.of(step)}});
    }
    if (const auto repetitions = report.repetitions_of(located); !repetitions.empty()) {
      object["repeats"] = repetitions.size();
      object["lastLine"] = repetitions.back().line + 1;
    }
    if (located.is_of_run) object["source"] = "run";
    for (const RunPlace& place : run_places(located, style_.language))
      object["related"].push_back({{"file", place.file.empty() ? name : place.file},
                                   {"line", place.line},
                                   {"column", place.column},
                                   {"text", place.note}});
    return object;
  }

  OrderedJson fix_of(const check::LocatedFinding& located, fixing::FindingFixes& fixes) const {
    const std::optional<fixes::Fix> fix = fixes.offered_in_full(located);
    if (!fix) return nullptr;
    OrderedJson edits = OrderedJson::array();
    for (const fixing::ShownEdit& edit : fixes.shown(*fix))
      edits.push_back({{"line", edit.line},
                       {"column", edit.column},
                       {"endLine", edit.end_line},
                       {"endColumn", edit.end_column},
                       {"text", edit.text}});
    return {{"title", fix->title_in(style_.language)}, {"safe", fix->safety == fixes::Safety::Safe}, {"edits", edits}};
  }

  ReportStyle style_;
  bool first_ = true;
};

std::unique_ptr<Renderer> make_json_renderer(const ReportStyle& style) { return std::make_unique<JsonRenderer>(style); }

}  // namespace isocnc::formats
