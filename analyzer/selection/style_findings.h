#pragma once

#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "interpreter/syntax/document.h"

namespace isocnc::selection {

/// The report with the findings of the selected style rules.
check::Report with_style(check::Report report, std::string_view text, const Selection& selection);
check::Report with_style(check::Report report, const syntax::Document& document, const Selection& selection);

/// Whether a style rule is selected.
bool has_style(const Selection& selection);

}  // namespace isocnc::selection
