#include "analyzer/renderers.h"

namespace isocnc::analyzer {

std::unique_ptr<Renderer> make_renderer(std::string_view format, const Style& style) {
  if (format == "text") return make_text_renderer(style);
  if (format == "concise") return make_concise_renderer(style);
  if (format == "json") return make_json_renderer(style);
  return nullptr;
}

}  // namespace isocnc::analyzer
