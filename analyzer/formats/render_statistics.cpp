#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analyzer/formats/renderers.h"
#include "analyzer/selection/tally.h"

namespace isocnc::formats {

/// The number of findings of each code in all files, the most frequent first: as a table or as JSON.
class StatisticsRenderer final : public Renderer {
 public:
  StatisticsRenderer(const ReportStyle& style, bool as_json) : style_(style), as_json_(as_json) {}

  void file(const CheckedProgram& program, Output&) override { tally_.add(program.report); }

  void end(std::string& output) override { output += as_json_ ? json() : table(); }

 private:
  std::vector<dialect::DiagnosticId> found() const {
    std::vector<dialect::DiagnosticId> ids;
    for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
      const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
      if (tally_.of(id) > 0) ids.push_back(id);
    }
    std::stable_sort(ids.begin(), ids.end(), [&](auto a, auto b) { return tally_.of(a) > tally_.of(b); });
    return ids;
  }

  std::string table() const {
    std::string text;
    for (const dialect::DiagnosticId id : found()) {
      const dialect::DiagnosticDef& def = dialect::definition(id);
      fmt::format_to(std::back_inserter(text), "{:6}  {:6}  {:7}  {}\n", tally_.of(id), def.code,
                     dialect::severity_name(tally_.heaviest(id), style_.language), def.title.in(style_.language));
    }
    return text;
  }

  std::string json() const {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const dialect::DiagnosticId id : found()) {
      const dialect::DiagnosticDef& def = dialect::definition(id);
      array.push_back({{"code", def.code},
                       {"name", def.name},
                       {"severity", dialect::severity_name(tally_.heaviest(id), dialect::Language::English)},
                       {"title", def.title.in(style_.language)},
                       {"count", tally_.of(id)}});
    }
    return array.dump(2) + "\n";
  }

  ReportStyle style_;
  bool as_json_;
  selection::Tally tally_;
};

std::unique_ptr<Renderer> make_statistics_renderer(std::string_view format, const ReportStyle& style) {
  if (format != "text" && format != "concise" && format != "json") return nullptr;
  return std::make_unique<StatisticsRenderer>(style, format == "json");
}

}  // namespace isocnc::formats
