#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::selection {

/// FNV-1a of 64 bits, going on from `hash`: the same on every machine, so that it can be kept in files.
inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ULL;
std::uint64_t hash_on(std::uint64_t hash, std::string_view text);

/// What a finding is recognized by when the program around it has been edited: its code, its line's text without
/// blanks, and how many like it stand above in the file. Its line number is no part of it.
struct Fingerprint {
  std::uint64_t line_hash = 0;
  std::uint64_t occurrence = 1;  ///< From 1.
};

/// Makes the fingerprints of one file's findings, which must be asked for in their order.
class Fingerprints {
 public:
  /// `line` is the text of the finding's line, and must stay where it is until the next call.
  Fingerprint next(dialect::DiagnosticId id, std::string_view line);

 private:
  std::string_view line_;  // The last, which has often more findings than one.
  std::uint64_t line_hash_ = kHashStart;
  std::map<std::pair<std::uint64_t, dialect::DiagnosticId>, std::uint64_t> seen_;
};

}  // namespace isocnc::selection
