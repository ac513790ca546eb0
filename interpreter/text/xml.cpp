#include "interpreter/text/xml.h"

#include "interpreter/text/unicode.h"

namespace isocnc::text {

std::string xml_escaped(std::string_view text) {
  std::string rest = text::printable(text);
  for (const std::string_view forbidden : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"})  // U+FFFE and U+FFFF.
    for (std::size_t at = rest.find(forbidden); at != std::string::npos; at = rest.find(forbidden, at))
      rest.replace(at, forbidden.size(), "\xEF\xBF\xBD");
  std::string result;
  for (const char c : rest) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace isocnc::text
