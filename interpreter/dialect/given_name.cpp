#include "interpreter/dialect/given_name.h"

#include <string>
#include <utility>

#include "interpreter/dialect/kept_values.h"

namespace isocnc::dialect {

/// In English and in Italian.
static KeptValues<std::pair<std::string, std::string>>& names() {
  static KeptValues<std::pair<std::string, std::string>> names;
  return names;
}

GivenName GivenName::of(Text name) { return {names().number_of({std::string(name.en), std::string(name.it)})}; }

std::string_view GivenName::in(Language language) const {
  const auto& [english, italian] = names().at(number);
  return language == Language::Italian ? italian : english;
}

}  // namespace isocnc::dialect
