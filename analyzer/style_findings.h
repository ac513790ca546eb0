#pragma once

#include <string_view>

#include "analyzer/report.h"
#include "analyzer/selection.h"
#include "interpreter/syntax/document.h"

namespace isocnc::analyzer {

/// The report with what the shown style rules say of how the program is written.
Report with_style(Report report, std::string_view text, const Selection& selection);
Report with_style(Report report, const syntax::Document& document, const Selection& selection);

/// Whether some style rule is shown.
bool has_style(const Selection& selection);

}  // namespace isocnc::analyzer
