#pragma once

#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::dialect {

/// The diagnostic codes that one word of a selection names.
struct CodeSet {
  std::bitset<kDiagnosticCount> codes;
  std::size_t exactness = 0;  ///< Number of characters of the code that were given; 0 for `ALL`.
};

/// The codes named by a code (`ISO031`), a name (`arc-center-mismatch`), a prefix (`W1`) or `ALL`, in any case; nothing
/// for an unknown word.
std::optional<CodeSet> find_codes(std::string_view word);

/// The code or name that was probably meant.
std::optional<std::string> nearest_code(std::string_view word);

}  // namespace isocnc::dialect
