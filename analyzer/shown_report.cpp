#include "analyzer/shown_report.h"

#include <utility>

#include "analyzer/style_findings.h"

namespace isocnc::analyzer {

template <class Text>
static Report shown(Report found, const Text& text, Suppressions comments, const Selection& selection) {
  Report report = with_style(selection.shown(std::move(found)), text, selection);
  return selection.shown(comments.apply(std::move(report), selection));
}

Report shown_report(Report found, std::string_view text, const Selection& selection) {
  return shown(std::move(found), text, Suppressions(text), selection);
}

Report shown_report(Report found, const syntax::Document& document, Suppressions comments, const Selection& selection) {
  return shown(std::move(found), document, std::move(comments), selection);
}

}  // namespace isocnc::analyzer
