#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/formats/renderers.h"
#include "analyzer/selection/fingerprint.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/hash.h"

namespace isocnc::formats {

using OrderedJson = nlohmann::ordered_json;

/// GitLab's Code Quality report: one array of issues.
class GitlabRenderer final : public Renderer {
 public:
  explicit GitlabRenderer(const ReportStyle& style) : style_(style) {}

  void begin(std::string& output) override { output += "["; }
  void end(std::string& output) override { output += first_ ? "]\n" : "\n]\n"; }

  void file(const CheckedProgram& program, Output& output) override {
    static constexpr std::string_view kSeverities[] = {"major", "minor", "info"};
    const std::string path = plain_path(program.name);
    syntax::LineFinder lines(program.text);
    selection::Fingerprints fingerprints;
    for (const check::LocatedFinding& located : program.report.findings) {
      const ShownFinding shown = show(located, program.report, lines, style_);
      const selection::Fingerprint print = fingerprints.next(located.finding.id, shown.line_text);
      const std::string all =
          fmt::format("{}\n{}\n{:016x}\n{}", path, shown.def.code, print.line_hash, print.occurrence);
      const OrderedJson issue = {
          {"description", fmt::format("{}: {}", shown.def.code, shown.message)},
          {"check_name", shown.def.code},
          {"fingerprint", fmt::format("{:016x}", text::hash_on(text::kHashStart, all))},
          {"severity", kSeverities[static_cast<std::size_t>(shown.severity)]},
          {"location", {{"path", path}, {"lines", {{"begin", shown.line}, {"end", shown.line}}}}}};
      output.buffer() += first_ ? "\n  " : ",\n  ";
      first_ = false;
      output.buffer() += issue.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
      output.drain();
    }
  }

 private:
  ReportStyle style_;
  bool first_ = true;
};

std::unique_ptr<Renderer> make_gitlab_renderer(const ReportStyle& style) {
  return std::make_unique<GitlabRenderer>(style);
}

}  // namespace isocnc::formats
