#pragma once

#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/syntax/document.h"

namespace isocnc::selection {

/// Of all that the check of a text has found, what is shown: the selection's findings and its rules of style, less what
/// the program's comments silence, with the comments that silence nothing (W190) where those are selected. The one
/// order for isolint, editors and debuggers.
check::Report shown_report(check::Report found, std::string_view text, const Selection& selection);
/// The same for a document and the comments that stand in it.
check::Report shown_report(check::Report found, const syntax::Document& document, Suppressions comments,
                           const Selection& selection);

}  // namespace isocnc::selection
