#include "debugger/breakpoints/wanted_code.h"

#include <algorithm>

#include "debugger/expressions/read_number.h"
#include "interpreter/text/characters.h"

namespace isocnc::breakpoints {

std::optional<WantedCode> WantedCode::read(std::string_view name) {
  name = text::trimmed(name);
  if (name.size() < 2) return std::nullopt;
  const char letter = text::upper(name.front());
  const auto number = expressions::read_number<std::uint32_t>(text::trimmed(name.substr(1)));
  if (!number || (letter != 'G' && letter != 'M' && letter != 'T')) return std::nullopt;
  if (*number > (letter == 'T' ? 999999u : 999u)) return std::nullopt;
  return WantedCode{letter, *number};
}

bool WantedCode::is_in(const syntax::LineTree& tree) const {
  return std::any_of(tree.words.begin(), tree.words.end(), [&](const syntax::Word& word) {
    return word.letter == letter && word.value == static_cast<double>(number);
  });
}

}  // namespace isocnc::breakpoints
