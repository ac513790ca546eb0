#pragma once

#include <string>
#include <vector>

#include "analyzer/check/report.h"
#include "tests/support/tree_text.h"

namespace isocnc::support {

/// Whether a finding is an opinion: W101 to W189. Programs about the control's own codes say nothing of them.
inline bool is_lint(std::string_view code) { return code >= "W101" && code < "W190"; }

/// A report's findings with the paths that lead to them, one text each: equal texts mean that users are told the same.
inline std::vector<std::string> texts_of(const check::Report& report) {
  std::vector<std::string> texts;
  for (const check::LocatedFinding& located : report.findings) {
    std::string text = fmt::format("line {}: {}", located.line, text_of(located.finding));
    if (located.path >= 0)
      for (const check::PathStep& step : report.paths.at(static_cast<std::size_t>(located.path)))
        text += fmt::format(" via {}{}", step.taken ? "" : "not ", step.line);
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace isocnc::support
