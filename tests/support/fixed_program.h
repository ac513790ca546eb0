#pragma once

#include <set>
#include <string>
#include <string_view>

#include "analyzer/check_text.h"
#include "analyzer/fixer.h"
#include "analyzer/suppressions.h"

namespace isocnc::support {

/// The text with all that can be fixed.
inline std::string fixed(std::string_view text, bool unsafe) {
  const analyzer::Selection selection;
  const execution::Setup setup;
  return analyzer::fix_text(text, {.selection = selection, .setup = setup, .unsafe = unsafe}).text;
}

/// What is found, by its codes.
inline std::multiset<std::string> codes_of(std::string_view text) {
  std::multiset<std::string> codes;
  for (const analyzer::LocatedFinding& located : analyzer::suppress(analyzer::check_text(text, {}), text, {}).findings)
    codes.emplace(dialect::definition(located.finding.id).code);
  return codes;
}

}  // namespace isocnc::support
