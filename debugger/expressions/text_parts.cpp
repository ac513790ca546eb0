#include "debugger/expressions/text_parts.h"

#include "interpreter/text/characters.h"

namespace isocnc::expressions {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text::is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && text::is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace isocnc::expressions
