#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/formats/related.h"
#include "analyzer/formats/renderers.h"
#include "analyzer/formats/sarif_log.h"
#include "analyzer/selection/fingerprint.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/locale.h"

namespace isocnc::formats {

using dialect::DiagnosticId;
using dialect::Severity;
using OrderedJson = nlohmann::ordered_json;

/// The maximum number of related locations of a finding.
static constexpr std::size_t kMaxRelated = 100;

static std::string_view level(Severity severity) {
  static constexpr std::string_view kLevels[] = {"error", "warning", "note"};
  return kLevels[static_cast<std::size_t>(severity)];
}

/// SARIF 2.1.0, which code scanning services and editors read. The log is written in pieces: results first, then the
/// files that they refer to.
class SarifRenderer final : public Renderer {
 public:
  explicit SarifRenderer(const ReportStyle& style) : style_(style) {}

  void begin(std::string& output) override {
    SarifLog::Header header{.version = ISOCNC_VERSION,
                            .language = std::string(dialect::name_of(style_.language)),
                            .shard = style_.shard,
                            .rules = {}};
    for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i)
      header.rules.push_back(dumped(rule(DiagnosticId{static_cast<std::uint8_t>(i)})));
    log_.begin(header, output);
  }

  void file(const CheckedProgram& program, Output& output) override {
    const OrderedJson artifact = {{"uri", uri_of(program.name)}, {"index", artifacts_.size()}};
    OrderedJson described = {{"location", {{"uri", uri_of(program.name)}}},
                             {"roles", OrderedJson::array({"analysisTarget"})}};
    if (!program.certificate.empty()) described["properties"] = {{"certificate", program.certificate}};
    artifacts_.push_back(dumped(described));
    syntax::LineFinder lines(program.text);
    const StepTexts steps(program.text, program.report, style_.language);
    selection::Fingerprints fingerprints;
    fixing::FindingFixes fixes(program.text, program.report, program.setup);
    for (const check::LocatedFinding& located : program.report.findings) {
      const ShownFinding shown = show(located, program.report, lines, style_);
      OrderedJson object = result(shown, located.finding.id, artifact);
      const selection::Fingerprint print = fingerprints.next(located.finding.id, shown.line_text);
      object["partialFingerprints"]["primaryLocationLineHash"] =
          fmt::format("{:016x}:{}", print.line_hash, print.occurrence);
      if (located.path >= 0) object["codeFlows"] = code_flows(located, program.report, steps, shown, artifact);
      if (located.repetitions >= 0) add_repetitions(located, program.report, lines, artifact, object);
      if (located.is_of_run) add_run(located, artifact, object);
      if (const std::optional<fixes::Fix> fix = fixes.offered_in_full(located))
        object["fixes"] = OrderedJson::array({fix_of(*fix, fixes, artifact)});
      log_.add_result(dumped(object), output.buffer());
      output.drain();
    }
  }

  void end(std::string& output) override { log_.end(artifacts_, output); }

 private:
  OrderedJson rule(DiagnosticId id) const {
    const dialect::DiagnosticDef& def = dialect::definition(id);
    OrderedJson rule = {{"id", def.code},
                        {"name", def.name},
                        {"shortDescription", {{"text", def.title.in(style_.language)}}},
                        {"fullDescription", {{"text", def.explanation.in(style_.language)}}}};
    // SARIF requires an absolute URI; in a build without a site URL the rule pages are local files.
    if (const std::string url = rule_url(id); url.find("://") != std::string::npos) rule["helpUri"] = url;
    rule["help"] = {{"text", def.explanation.in(style_.language)}};
    rule["defaultConfiguration"] = {{"level", level(def.severity)}};
    if (def.is_off) rule["defaultConfiguration"]["enabled"] = false;
    return rule;
  }

  static OrderedJson location(const ShownFinding& shown, const OrderedJson& artifact) {
    return {{"artifactLocation", artifact},
            {"region",
             {{"startLine", shown.line},
              {"startColumn", shown.column},
              {"endLine", shown.line},
              {"endColumn", shown.end_column}}}};
  }

  static OrderedJson result(const ShownFinding& shown, DiagnosticId id, const OrderedJson& artifact) {
    OrderedJson locations = OrderedJson::array();
    locations.push_back({{"physicalLocation", location(shown, artifact)}});
    return {{"ruleId", shown.def.code},
            {"ruleIndex", static_cast<std::size_t>(id)},
            {"level", level(shown.severity)},
            {"message", {{"text", shown.message}}},
            {"locations", locations}};
  }

  /// The jumps that lead to the finding, then the finding.
  static OrderedJson code_flows(const check::LocatedFinding& located, const check::Report& report,
                                const StepTexts& steps, const ShownFinding& shown, const OrderedJson& artifact) {
    OrderedJson places = OrderedJson::array();
    const auto add = [&](const OrderedJson& place, std::string_view text) {
      places.push_back({{"location", {{"physicalLocation", place}, {"message", {{"text", text}}}}}});
    };
    for (const check::PathStep& step : report.paths[static_cast<std::size_t>(located.path)])
      add({{"artifactLocation", artifact}, {"region", {{"startLine", step.line + 1}}}}, steps.of(step));
    add(location(shown, artifact), shown.message);
    OrderedJson thread_flows = OrderedJson::array();
    thread_flows.push_back({{"locations", places}});
    OrderedJson flows = OrderedJson::array();
    flows.push_back({{"threadFlows", thread_flows}});
    return flows;
  }

  /// The lines below that repeat the finding: the first of them, the last one, and how many there are.
  void add_repetitions(const check::LocatedFinding& located, const check::Report& report, syntax::LineFinder lines,
                       const OrderedJson& artifact, OrderedJson& object) const {
    static constexpr dialect::Text kAgain = {"here again", "anche qui"};
    const std::span<const check::Repetition> repetitions = report.repetitions_of(located);
    OrderedJson places = OrderedJson::array();
    const auto add = [&](const check::Repetition& again) {
      const ShownFinding shown = show({.line = again.line, .finding = again.finding()}, {}, lines, style_);
      places.push_back(
          {{"physicalLocation", location(shown, artifact)}, {"message", {{"text", kAgain.in(style_.language)}}}});
    };
    const std::size_t first = std::min(repetitions.size() - 1, kMaxRelated - 1);
    for (std::size_t i = 0; i < first; ++i) add(repetitions[i]);
    add(repetitions.back());
    object["relatedLocations"] = places;
    object["properties"] = {{"repeats", repetitions.size()}, {"lastLine", repetitions.back().line + 1}};
  }

  /// What a run has shown: the numbers of the message, the bodies, and the other places.
  void add_run(const check::LocatedFinding& located, const OrderedJson& artifact, OrderedJson& object) const {
    OrderedJson& properties = object["properties"];
    properties["source"] = "run";
    const auto& [body, obstacle] = located.finding.names;
    if (obstacle != dialect::GivenName()) {
      properties["body"] = body.in(style_.language);
      properties["obstacle"] = obstacle.in(style_.language);
      const dialect::DiagnosticDef& def = dialect::definition(located.finding.id);
      for (std::size_t i = 0; i < std::size(def.arguments); ++i)
        if (!def.arguments[i].empty()) properties[std::string(def.arguments[i])] = located.finding.values[i];
    }
    for (const RunPlace& place : run_places(located, style_.language)) {
      OrderedJson in_file = artifact;
      if (!place.file.empty()) in_file = {{"uri", uri_of(place.file)}};
      object["relatedLocations"].push_back(
          {{"physicalLocation",
            {{"artifactLocation", in_file}, {"region", {{"startLine", place.line}, {"startColumn", place.column}}}}},
           {"message", {{"text", place.note}}}});
    }
  }

  OrderedJson fix_of(const fixes::Fix& fix, fixing::FindingFixes& fixes, const OrderedJson& artifact) const {
    OrderedJson replacements = OrderedJson::array();
    for (const fixing::ShownEdit& edit : fixes.shown(fix))
      replacements.push_back({{"deletedRegion",
                               {{"startLine", edit.line},
                                {"startColumn", edit.column},
                                {"endLine", edit.end_line},
                                {"endColumn", edit.end_column}}},
                              {"insertedContent", {{"text", edit.text}}}});
    const OrderedJson change = {{"artifactLocation", artifact}, {"replacements", replacements}};
    return {{"description", {{"text", fix.title_in(style_.language)}}},
            {"artifactChanges", OrderedJson::array({change})}};
  }

  ReportStyle style_;
  SarifLog log_;
  std::vector<std::string> artifacts_;
};

std::unique_ptr<Renderer> make_sarif_renderer(const ReportStyle& style) {
  return std::make_unique<SarifRenderer>(style);
}

}  // namespace isocnc::formats
