#pragma once

#include <set>
#include <string>
#include <string_view>

#include "analyzer/check/check_text.h"
#include "analyzer/fixing/fixer.h"
#include "analyzer/selection/shown_report.h"

namespace isocnc::support {

/// The default selection plus one code.
inline selection::Selection selection_with(std::string_view code) {
  selection::Selection selection;
  if (!code.empty()) selection.follow({.severities = {std::string(code) + "=warning"}}, dialect::Language::English);
  return selection;
}

/// The text after all fixes; `code` is selected as well.
inline std::string fixed(std::string_view text, bool unsafe, std::string_view code = {}) {
  const selection::Selection selection = selection_with(code);
  const rules::CheckSetup setup;
  return fixing::fix_text(text, {.selection = selection, .setup = setup, .unsafe = unsafe}).text;
}

/// The report of all findings that are shown.
inline check::Report found_in(std::string_view text, std::string_view code = {}) {
  const selection::Selection selection = selection_with(code);
  return selection::shown_report(check::check_text(text, {}), text, selection);
}

/// The codes of all findings that are shown.
inline std::multiset<std::string> codes_of(std::string_view text, std::string_view code = {}) {
  std::multiset<std::string> codes;
  for (const check::LocatedFinding& located : found_in(text, code).findings)
    codes.emplace(dialect::definition(located.finding.id).code);
  return codes;
}

}  // namespace isocnc::support
