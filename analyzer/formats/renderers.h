#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/formats/rendering.h"

namespace isocnc::formats {

/// The values of `--format`.
std::vector<std::string> format_names();

/// The renderer of a format, or null if the name is unknown.
std::unique_ptr<Renderer> make_renderer(std::string_view format, const ReportStyle& style);

// All formats, in the order of the help: each is a file, render_NAME.cpp, with a make_NAME_renderer.
#define ISOCNC_FORMATS(FORMAT) \
  FORMAT(text)                 \
  FORMAT(concise)              \
  FORMAT(json)                 \
  FORMAT(sarif)                \
  FORMAT(github)               \
  FORMAT(gitlab)               \
  FORMAT(junit)                \
  FORMAT(checkstyle)

#define ISOCNC_DECLARE_RENDERER(name) std::unique_ptr<Renderer> make_##name##_renderer(const ReportStyle& style);
ISOCNC_FORMATS(ISOCNC_DECLARE_RENDERER)
#undef ISOCNC_DECLARE_RENDERER

/// A renderer of counts instead of findings, or null if the format cannot express them.
std::unique_ptr<Renderer> make_statistics_renderer(std::string_view format, const ReportStyle& style);

}  // namespace isocnc::formats
