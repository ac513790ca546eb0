#pragma once

#include <string>
#include <vector>

#include "analyzer/check/report.h"
#include "tests/support/tree_text.h"

namespace isocnc::support {

/// Whether a code is an optional lint rule: W101 to W189. Tests about the control's own codes ignore these.
inline bool is_lint(std::string_view code) { return code >= "W101" && code < "W190"; }

/// One text for each finding of a report, with the path that leads to it. Equal texts mean that users see the same.
inline std::vector<std::string> texts_of(const check::Report& report) {
  std::vector<std::string> texts;
  for (const check::LocatedFinding& located : report.findings) {
    std::string text = fmt::format("line {}: {}", located.line, text_of(located.finding));
    if (located.path >= 0)
      for (const check::PathStep& step : report.paths.at(static_cast<std::size_t>(located.path)))
        text += fmt::format(" via {}{}", step.taken ? "" : "not ", step.line);
    if (located.mistake >= 0) text += fmt::format(" mistake {}", located.mistake);
    for (const check::Repetition& again : report.repetitions_of(located))
      text += fmt::format(" again {} {} {}", again.line, dialect::definition(again.id).code, text_of(again.span));
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace isocnc::support
