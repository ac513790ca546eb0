#include "analyzer/selection/shown_report.h"

#include <utility>

#include "analyzer/selection/style_findings.h"

namespace isocnc::selection {

template <class Text>
static check::Report shown(check::Report found, const Text& text, Suppressions comments, const Selection& selection) {
  check::Report report = with_style(selection.shown(std::move(found)), text, selection);
  return selection.shown(comments.apply(std::move(report), selection));
}

check::Report shown_report(check::Report found, std::string_view text, const Selection& selection) {
  return shown(std::move(found), text, Suppressions(text), selection);
}

check::Report shown_report(check::Report found, const syntax::Document& document, Suppressions comments,
                           const Selection& selection) {
  return shown(std::move(found), document, std::move(comments), selection);
}

}  // namespace isocnc::selection
