#pragma once

#include <string_view>

namespace isocnc::plot {

/// The page of --plot FILE.html, made of toolpath-view/ by the build; empty where there was no npm to build it with.
/// Linked by isorun alone, so that who builds isolint needs none. `kPageTitle` and `kPageData` stand in it once each.
extern const std::string_view kPageTemplate;

inline constexpr std::string_view kPageTitle = "<!--title-->";
inline constexpr std::string_view kPageData = "<!--data-->";

}  // namespace isocnc::plot
