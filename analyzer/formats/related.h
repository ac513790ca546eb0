#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::formats {

/// The earlier line that explains a finding: where the frame was mounted, the mode was set, or the label was first
/// defined.
struct RelatedPlace {
  std::size_t line = 0;   ///< The line, from 0.
  std::string_view text;  ///< The text of the line.
  syntax::Span span;
  dialect::Text note;  ///< The event on that line.
};

/// Finds the related places of a file's findings by searching upward from each. Takes the nearest line above that fits,
/// and gives up after a limited distance: it is a help for the reader, and no check depends on it.
class RelatedPlaces {
 public:
  explicit RelatedPlaces(std::string_view text) : text_(text) {}

  /// `line_text` must be part of the text.
  std::optional<RelatedPlace> of(const check::LocatedFinding& located, std::string_view line_text);

 private:
  std::string_view text_;
  std::size_t bytes_left_ = 64'000'000;  // The bytes that all searches together may still read.
};

/// Another place that belongs to a finding of a run: where a contact ends, and where a configuration describes what is
/// hit.
struct RunPlace {
  std::string_view file;   ///< As shown to users; empty for the program.
  std::size_t line = 1;    ///< From 1.
  std::size_t column = 1;  ///< From 1.
  std::string note;        ///< What is there.
};

std::vector<RunPlace> run_places(const check::LocatedFinding& located, dialect::Language language);

}  // namespace isocnc::formats
