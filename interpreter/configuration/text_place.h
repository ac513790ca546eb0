#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace isocnc::configuration {

/// A position in a text, from 1; columns in code points.
struct LineColumn {
  std::size_t line = 1;
  std::size_t column = 1;
};
LineColumn place_of(std::size_t at, std::string_view text);

/// Where a configuration describes something.
struct DescriptionPlace {
  LineColumn shown;        ///< For messages.
  std::uint32_t byte = 0;  ///< Byte of the line, from 0.
};

/// The places of ascending offsets in one well-formed UTF-8 text, which all together take the time of reading it once.
class PlaceFinder {
 public:
  explicit PlaceFinder(std::string_view text) : text_(text) {}

  /// The place of a byte. An offset below that of the call before starts over.
  DescriptionPlace of(std::size_t at);

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  DescriptionPlace place_;
};

}  // namespace isocnc::configuration
