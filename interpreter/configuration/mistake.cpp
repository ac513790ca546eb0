#include "interpreter/configuration/mistake.h"

#include <algorithm>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/near_names.h"
#include "interpreter/text/unicode.h"

namespace isocnc::configuration {

using dialect::Language;

std::string Mistake::message(Language language) const {
  const auto name = [&](std::size_t i) -> std::string_view {
    if (i >= names.size()) return {};
    return language == Language::Italian ? names[i].it : names[i].en;
  };
  const std::string said = dialect::format(text, language, name(0), name(1));
  return fmt::format("{}{}{}{}", key, key.empty() ? "" : ": ", said, dialect::did_you_mean(meant, language));
}

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

std::string located_message(std::string_view file, const LineColumn& place, const Mistake& mistake, Language language) {
  return text::printable(fmt::format("{}:{}:{}: {}: {}", file, place.line, place.column,
                                     dialect::severity_name(dialect::Severity::Error, language),
                                     mistake.message(language)));
}

std::string shortened(std::string_view text) {
  static constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return std::string(text);
  std::size_t end = 0;
  for (std::size_t next = 0; next <= kLongest;
       next += std::max<std::size_t>(1, text::sequence_length(text.substr(next))))
    end = next;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace isocnc::configuration
