#include "debugger/session/text_parts.h"

#include "interpreter/syntax/characters.h"

namespace isocnc::debugger::session {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && syntax::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && syntax::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace isocnc::debugger::session
