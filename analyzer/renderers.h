#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "analyzer/rendering.h"

namespace isocnc::analyzer {

/// The renderer of a format (`text`, `concise`, `json`), or null when there is none of that name.
std::unique_ptr<Renderer> make_renderer(std::string_view format, const Style& style);

std::unique_ptr<Renderer> make_text_renderer(const Style& style);
std::unique_ptr<Renderer> make_concise_renderer(const Style& style);
std::unique_ptr<Renderer> make_json_renderer(const Style& style);

}  // namespace isocnc::analyzer
