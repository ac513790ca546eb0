#pragma once

#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::dialect {

/// The codes that one word of a selection names.
struct CodeSet {
  std::bitset<kDiagnosticCount> codes;
  std::size_t exactness = 0;  ///< How many letters of the code were given; `ALL` gives none.
};

/// The codes of `ISO031`, of `arc-center-mismatch`, of the beginning `W1` or of `ALL`, capitals aside; none when
/// nothing is called that.
std::optional<CodeSet> find_codes(std::string_view word);

/// The code or name that was most plausibly meant.
std::optional<std::string> nearest_code(std::string_view word);

}  // namespace isocnc::dialect
