#pragma once

#include <functional>
#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/syntax/document.h"

namespace isocnc::selection {

/// Takes findings out of a report, for example those that a baseline knows.
using FindingFilter = std::function<check::Report(check::Report, std::string_view)>;

/// The findings of a check that are shown: adds the selected style rules, keeps the selected findings, removes those
/// that the program's comments suppress, and adds useless comments (W190) if selected; `filter` may remove more. Then
/// folds the others (D66): a removed line is missing in its fold, and no more. isolint, editors and debuggers all use
/// this order. `by_run` as in Suppressions::apply().
check::Report shown_report(check::Report found, std::string_view text, const Selection& selection,
                           const FindingFilter& filter = {}, const LookedFor& by_run = {});
/// The same for a document and the suppressions read from it.
check::Report shown_report(check::Report found, const syntax::Document& document, Suppressions comments,
                           const Selection& selection, const std::function<check::Report(check::Report)>& filter = {},
                           const LookedFor& by_run = {});

}  // namespace isocnc::selection
