#pragma once

#include <string_view>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "analyzer/selection/shown_report.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/simulation/run_findings.h"
#include "interpreter/syntax/document.h"

namespace isocnc::selection {

/// One list of what a check of the text and a run have found: what both have found on a line stands there once, as the
/// text shows it.
check::Report with_run(check::Report found, const simulation::RunOutcome& run);

/// The findings of a check and of a run that are shown, by the same steps as shown_report() of a check alone. On lines
/// that the run has executed, the joints have been compared with their travel (E160), so that what a check concludes
/// from the tip (W130), on every path or on that of the run, is left out there. Comments about what only a run shows
/// are useless (W190) where the run has found nothing of it, unless something could not be verified (W162).
check::Report shown_report_with_run(check::Report found, const simulation::RunOutcome& run, std::string_view text,
                                    const Selection& selection, const FindingFilter& filter = {});
/// The same for a document and the suppressions read from it, which are judged if the run is `whole`: all that
/// it has found of the present text.
check::Report shown_report_with_run(check::Report found, const simulation::RunOutcome& run, bool whole,
                                    const syntax::Document& document, Suppressions comments,
                                    const Selection& selection);

/// Removes what the run judges better, on the lines that it has executed: what a check concludes from the tip (W130)
/// where the run has compared the joints, and the stopped spindle (W102) where the run has found it cutting (E158); if
/// these are selected.
check::Report without_tips(check::Report report, const simulation::RunOutcome& run, const Selection& selection);

/// The findings of a run alone that are shown: those that are selected and that no comment of the program suppresses.
check::Report shown_run_report(const simulation::RunOutcome& run, std::string_view text, const Selection& selection);

}  // namespace isocnc::selection
