#include "analyzer/selection/fingerprint.h"

#include "interpreter/text/characters.h"

namespace isocnc::selection {

static std::uint64_t hash_on(std::uint64_t hash, char c) {
  return (hash ^ static_cast<unsigned char>(c)) * 0x00000100000001b3ULL;
}

std::uint64_t hash_on(std::uint64_t hash, std::string_view text) {
  for (const char c : text) hash = hash_on(hash, c);
  return hash;
}

Fingerprint Fingerprints::next(dialect::DiagnosticId id, std::string_view line) {
  if (line.data() != line_.data() || line.size() != line_.size()) {
    line_ = line;
    line_hash_ = kHashStart;
    for (const char c : line)
      if (!text::is_blank(c)) line_hash_ = hash_on(line_hash_, c);
  }
  return {.line_hash = line_hash_, .occurrence = ++seen_[{line_hash_, id}]};
}

}  // namespace isocnc::selection
