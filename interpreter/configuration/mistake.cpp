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
