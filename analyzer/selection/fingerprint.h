#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/hash.h"

namespace isocnc::selection {

/// Identifies a finding after the program around it has been edited: its code, its line's text without blanks, and the
/// number of equal findings above it in the file. The line number does not matter.
struct Fingerprint {
  std::uint64_t line_hash = 0;
  std::uint64_t occurrence = 1;  ///< The number of the equal finding, from 1 at the top of the file.
};

/// Makes the fingerprints of one file's findings; next() must be called in the order of the findings.
class Fingerprints {
 public:
  /// `line` is the text of the finding's line; it must stay valid until the next call.
  Fingerprint next(dialect::DiagnosticId id, std::string_view line);

 private:
  std::string_view line_;  // The line of the last call; consecutive findings often share it.
  std::uint64_t line_hash_ = text::kHashStart;
  std::map<std::pair<std::uint64_t, dialect::DiagnosticId>, std::uint64_t> seen_;
};

}  // namespace isocnc::selection
