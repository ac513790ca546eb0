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

std::unique_ptr<Renderer> make_text_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_concise_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_json_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_sarif_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_github_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_gitlab_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_junit_renderer(const ReportStyle& style);
std::unique_ptr<Renderer> make_checkstyle_renderer(const ReportStyle& style);

/// A renderer of counts instead of findings, or null if the format cannot express them.
std::unique_ptr<Renderer> make_statistics_renderer(std::string_view format, const ReportStyle& style);

}  // namespace isocnc::formats
