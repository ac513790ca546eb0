#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "analyzer/check/report.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::formats {

/// The line above that a finding comes from: where the frame was mounted, the mode was set, the label first stood.
struct RelatedPlace {
  std::uint64_t line = 0;  ///< From 0.
  std::string_view text;   ///< Of the line.
  syntax::Span span;
  dialect::Text note;  ///< What happened there.
};

/// Looks for the related places of a file's findings, upward from each. What it finds is the nearest line above that
/// fits, and it gives up after a bounded stretch: a help for the reader, of which no judgment depends.
class RelatedPlaces {
 public:
  explicit RelatedPlaces(std::string_view text) : text_(text) {}

  /// `line_text` must lie in the text.
  std::optional<RelatedPlace> of(const check::LocatedFinding& located, std::string_view line_text);

 private:
  std::string_view text_;
  std::size_t bytes_left_ = 64'000'000;  // To be looked through for all findings together.
};

}  // namespace isocnc::formats
