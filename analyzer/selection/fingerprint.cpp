#include "analyzer/selection/fingerprint.h"

#include "interpreter/text/characters.h"

namespace isocnc::selection {

Fingerprint Fingerprints::next(dialect::DiagnosticId id, std::string_view line) {
  if (line.data() != line_.data() || line.size() != line_.size()) {
    line_ = line;
    line_hash_ = text::kHashStart;
    for (const char c : line)
      if (!text::is_blank(c)) line_hash_ = text::hash_on(line_hash_, c);
  }
  return {.line_hash = line_hash_, .occurrence = ++seen_[{line_hash_, id}]};
}

}  // namespace isocnc::selection
