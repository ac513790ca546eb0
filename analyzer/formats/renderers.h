#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/formats/rendering.h"

namespace isocnc::formats {

/// What `--format` takes.
std::vector<std::string> format_names();

/// The renderer of a format, or null when there is none of that name.
std::unique_ptr<Renderer> make_renderer(std::string_view format, const Style& style);

std::unique_ptr<Renderer> make_text_renderer(const Style& style);
std::unique_ptr<Renderer> make_concise_renderer(const Style& style);
std::unique_ptr<Renderer> make_json_renderer(const Style& style);
std::unique_ptr<Renderer> make_sarif_renderer(const Style& style);
std::unique_ptr<Renderer> make_github_renderer(const Style& style);
std::unique_ptr<Renderer> make_gitlab_renderer(const Style& style);
std::unique_ptr<Renderer> make_junit_renderer(const Style& style);
std::unique_ptr<Renderer> make_checkstyle_renderer(const Style& style);

/// Counts in place of findings, or null when the format has no way to tell them.
std::unique_ptr<Renderer> make_statistics_renderer(std::string_view format, const Style& style);

}  // namespace isocnc::formats
