#include "analyzer/formats/renderers.h"

namespace isocnc::formats {

/// All formats.
static constexpr struct {
  std::string_view name;
  std::unique_ptr<Renderer> (*make)(const ReportStyle& style);
} kFormats[] = {
    {"text", make_text_renderer},   {"concise", make_concise_renderer},       {"json", make_json_renderer},
    {"sarif", make_sarif_renderer}, {"github", make_github_renderer},         {"gitlab", make_gitlab_renderer},
    {"junit", make_junit_renderer}, {"checkstyle", make_checkstyle_renderer},
};

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const auto& format : kFormats) names.emplace_back(format.name);
  return names;
}

std::unique_ptr<Renderer> make_renderer(std::string_view format, const ReportStyle& style) {
  for (const auto& each : kFormats)
    if (each.name == format) return each.make(style);
  return nullptr;
}

}  // namespace isocnc::formats
