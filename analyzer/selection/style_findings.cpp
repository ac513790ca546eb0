#include "analyzer/selection/style_findings.h"

#include <algorithm>
#include <utility>

#include "analyzer/style/rule.h"
#include "interpreter/text/characters.h"

namespace isocnc::selection {

static style::IsWanted wanted_by(const Selection& selection) {
  return [&](dialect::DiagnosticId id) { return selection.shows(id); };
}

bool has_style(const Selection& selection) { return !style::StyleReader(wanted_by(selection)).is_idle(); }

static check::Report with_remarks(check::Report report, const std::vector<style::StyleFinding>& style_findings) {
  if (style_findings.empty()) return report;
  for (const style::StyleFinding& style_finding : style_findings)
    report.findings.push_back({style_finding.line, style_finding.finding});
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const check::LocatedFinding& a, const check::LocatedFinding& b) {
                     return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
                   });
  return report;
}

check::Report with_style(check::Report report, std::string_view text, const Selection& selection) {
  return with_remarks(std::move(report), style::read_program(text, wanted_by(selection)));
}

check::Report with_style(check::Report report, const syntax::Document& document, const Selection& selection) {
  style::StyleReader reader(wanted_by(selection));
  if (reader.is_idle()) return report;
  syntax::ChunkTrees trees;
  for (std::size_t chunk = 0; chunk < document.chunk_count(); ++chunk) {
    std::string_view rest = document.chunk_text(chunk);
    trees.read(document, chunk);
    for (std::size_t i = 0; i < trees.size() && !rest.empty(); ++i) {
      const syntax::LineTree tree = trees[i];
      const char* const line_end = rest.data() + tree.text.size();
      const char* const next = text::skip_line_end(line_end, rest.data() + rest.size());
      const std::string_view terminator(line_end, static_cast<std::size_t>(next - line_end));
      reader.read({document.first_line_of_chunk(chunk) + i, tree, terminator});
      rest.remove_prefix(tree.text.size() + terminator.size());
    }
  }
  return with_remarks(std::move(report), reader.finish());
}

}  // namespace isocnc::selection
