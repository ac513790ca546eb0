#include "debugger/session/wanted_code.h"

#include <algorithm>

#include "debugger/session/text_parts.h"
#include "interpreter/syntax/characters.h"

namespace isocnc::debugger::session {

std::optional<WantedCode> WantedCode::read(std::string_view name) {
  name = trimmed(name);
  if (name.size() < 2) return std::nullopt;
  const char letter = syntax::upper(name.front());
  const auto number = read_number<std::uint32_t>(trimmed(name.substr(1)));
  if (!number || (letter != 'G' && letter != 'M' && letter != 'T')) return std::nullopt;
  if (*number > (letter == 'T' ? 999999u : 999u)) return std::nullopt;
  return WantedCode{letter, *number};
}

bool WantedCode::is_in(const syntax::LineTree& tree) const {
  return std::any_of(tree.words.begin(), tree.words.end(), [&](const syntax::Word& word) {
    return word.letter == letter && word.value == static_cast<double>(number);
  });
}

}  // namespace isocnc::debugger::session
