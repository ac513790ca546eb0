#include "analyzer/formats/renderers.h"

namespace isocnc::formats {

static constexpr struct {
  std::string_view name;
  std::unique_ptr<Renderer> (*make)(const ReportStyle& style);
} kFormats[] = {
#define ISOCNC_FORMAT_ROW(name) {#name, make_##name##_renderer},
    ISOCNC_FORMATS(ISOCNC_FORMAT_ROW)
#undef ISOCNC_FORMAT_ROW
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
