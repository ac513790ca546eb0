#include <algorithm>
#include <cstdint>

#include "analyzer/check/check_text.h"
#include "interpreter/syntax/document.h"
#include "require.h"
#include "tests/support/report_text.h"

namespace isocnc::fuzz {

using check::LocatedFinding;

static void check_places(std::string_view text, const check::Report& report) {
  const syntax::Document document(text);
  for (const LocatedFinding& located : report.findings) {
    require(located.line < document.line_count(), "findings stand on lines of the text");
    const std::size_t length = document.text_of_line(located.line).size();
    const syntax::Span span = located.finding.span;
    require(span.begin <= span.end && span.end <= length, "findings lie within their line");
    require(located.finding.related.end <= length, "related places lie within their line");
    require(located.path < static_cast<std::int32_t>(report.paths.size()), "findings name paths of the report");
  }
  const auto by_place = [](const LocatedFinding& a, const LocatedFinding& b) {
    return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
  };
  require(std::is_sorted(report.findings.begin(), report.findings.end(), by_place), "findings are sorted");
}

/// Repeats the text until two jobs have several portions to share.
static std::string several_portions(std::string_view text) {
  constexpr std::size_t kPortions = 160 * 1024;
  std::string all(text);
  while (!text.empty() && all.size() < kPortions) all.append("\n").append(text);
  return all;
}

static void check_program(std::string_view text) {
  check_places(text, check::check_text(text, {}));
  if (text.size() % 64 != 0) return;  // Long texts are slow; some of them do.
  const std::string longer = several_portions(text);
  const auto alone = support::texts_of(check::check_text(longer, {}, 1));
  require(alone == support::texts_of(check::check_text(longer, {}, 2)), "two jobs give the same report as one");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  isocnc::fuzz::check_program(isocnc::fuzz::as_text(data, size));
  return 0;
}
