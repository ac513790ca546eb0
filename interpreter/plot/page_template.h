#pragma once

#include <string_view>

namespace isocnc::plot {

/// The page of --plot FILE.html, built from toolpath-view/; empty if npm was not available. Only isorun links it, so
/// that isolint builds without npm. `kPageTitle` and `kPageData` occur in it once each.
extern const std::string_view kPageTemplate;

inline constexpr std::string_view kPageTitle = "<!--title-->";
inline constexpr std::string_view kPageData = "<!--data-->";

}  // namespace isocnc::plot
