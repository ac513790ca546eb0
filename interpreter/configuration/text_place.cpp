#include "interpreter/configuration/text_place.h"

#include <algorithm>

#include "interpreter/text/unicode.h"

namespace isocnc::configuration {

static bool ends_line(std::string_view text, std::size_t i) {
  return text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
}

LineColumn place_of(std::size_t at, std::string_view text) {
  LineColumn place;
  std::size_t begin = 0;
  at = std::min(at, text.size());
  for (std::size_t i = 0; i < at; ++i) {
    if (!ends_line(text, i)) continue;
    ++place.line;
    begin = i + 1;
  }
  place.column = text::column_of(text.substr(begin, std::min(text.size() - begin, at - begin + 4)), at - begin);
  return place;
}

DescriptionPlace PlaceFinder::of(std::size_t at) {
  if (at < at_) {
    at_ = 0;
    place_ = {};
  }
  for (; at_ < std::min(at, text_.size()); ++at_) {
    if (ends_line(text_, at_)) {
      place_ = {.shown = {.line = place_.shown.line + 1}};
      continue;
    }
    ++place_.byte;
    if (!text::is_inside_character(text_[at_])) ++place_.shown.column;
  }
  return place_;
}

}  // namespace isocnc::configuration
