#pragma once

#include <regex>
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

/// Without the codes by which a program is judged once its units are those that were meant, where it has G20 or G21:
/// these are rewritten all at once, whatever that brings to light.
inline std::multiset<std::string> without_what_units_reveal(std::multiset<std::string> codes, std::string_view text) {
  static const std::regex kForeignUnits("[Gg][ \\t]*0*2[ \\t]*[01](?![0-9.])");
  if (!std::regex_search(text.begin(), text.end(), kForeignUnits)) return codes;
  for (const char* const code : {"W001", "W111", "W112", "W119", "W120", "W190", "ISO029", "ISO030", "ISO031"})
    codes.erase(code);
  return codes;
}

}  // namespace isocnc::support
