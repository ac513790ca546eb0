#pragma once

#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "interpreter/syntax/document.h"

namespace isocnc::selection {

/// The report with what the shown style rules say of how the program is written.
check::Report with_style(check::Report report, std::string_view text, const Selection& selection);
check::Report with_style(check::Report report, const syntax::Document& document, const Selection& selection);

/// Whether some style rule is shown.
bool has_style(const Selection& selection);

}  // namespace isocnc::selection
