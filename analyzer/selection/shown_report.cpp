#include "analyzer/selection/shown_report.h"

#include <utility>

#include "analyzer/check/folding.h"
#include "analyzer/selection/style_findings.h"

namespace isocnc::selection {

template <class Text>
static check::Report unfolded(check::Report found, const Text& text, Suppressions comments, const Selection& selection,
                              const LookedFor& by_run) {
  check::Report report = with_style(selection.shown(std::move(found)), text, selection);
  return selection.shown(comments.apply(std::move(report), selection, by_run));
}

check::Report shown_report(check::Report found, std::string_view text, const Selection& selection,
                           const FindingFilter& filter, const LookedFor& by_run) {
  check::Report report = unfolded(std::move(found), text, Suppressions(text), selection, by_run);
  return check::folded(filter ? filter(std::move(report), text) : std::move(report));
}

check::Report shown_report(check::Report found, const syntax::Document& document, Suppressions comments,
                           const Selection& selection, const std::function<check::Report(check::Report)>& filter,
                           const LookedFor& by_run) {
  check::Report report = unfolded(std::move(found), document, std::move(comments), selection, by_run);
  return check::folded(filter ? filter(std::move(report)) : std::move(report));
}

}  // namespace isocnc::selection
