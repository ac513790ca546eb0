#pragma once

#include <string_view>

#include "analyzer/report.h"
#include "analyzer/selection.h"
#include "analyzer/suppressions.h"
#include "interpreter/syntax/document.h"

namespace isocnc::analyzer {

/// Of all that the check of a text has found, what is shown: the selection's findings and its rules of style, less what
/// the program's comments silence, with the comments that silence nothing (W190) where those are selected. The one
/// order for isolint, editors and debuggers.
Report shown_report(Report found, std::string_view text, const Selection& selection);
/// The same for a document and the comments that stand in it.
Report shown_report(Report found, const syntax::Document& document, Suppressions comments, const Selection& selection);

}  // namespace isocnc::analyzer
