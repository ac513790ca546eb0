#include "interpreter/dialect/code_set.h"

#include <vector>

#include "interpreter/dialect/any_case.h"
#include "interpreter/dialect/near_names.h"

namespace isocnc::dialect {

std::optional<CodeSet> find_codes(std::string_view word) {
  CodeSet set;
  if (word.empty()) return std::nullopt;
  if (equal_words(word, "ALL")) {
    set.codes.set();
    return set;
  }
  for (std::size_t i = 0; i < kDiagnosticCount; ++i)
    if (begins_with(kDiagnostics[i].code, word)) set.codes.set(i);
  set.exactness = word.size();
  if (const std::optional<DiagnosticId> id = find_diagnostic(word)) {
    set.codes.set(static_cast<std::size_t>(*id));
    set.exactness = definition(*id).code.size();
  }
  return set.codes.any() ? std::optional(set) : std::nullopt;
}

std::optional<std::string> nearest_code(std::string_view word) {
  std::vector<std::string> names;
  for (const DiagnosticDef& def : kDiagnostics) {
    names.emplace_back(def.code);
    names.emplace_back(def.name);
  }
  return nearest_name(word, names);
}

}  // namespace isocnc::dialect
