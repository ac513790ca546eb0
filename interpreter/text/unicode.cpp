#include "interpreter/text/unicode.h"

#include <algorithm>

namespace isocnc::text {

std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!is_inside_character(text[i])) return 0;
  const unsigned char second = byte(1);
  const bool too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool out_of_range = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return too_long || out_of_range ? 0 : length;
}

std::size_t foreign_minus_length(std::string_view text) {
  static constexpr std::string_view kSigns[] = {
      "\xE2\x80\x90",  // U+2010 hyphen
      "\xE2\x80\x91",  // U+2011 non-breaking hyphen
      "\xE2\x80\x92",  // U+2012 figure dash
      "\xE2\x80\x93",  // U+2013 en dash
      "\xE2\x80\x94",  // U+2014 em dash
      "\xE2\x88\x92",  // U+2212 minus
      "\xEF\xB9\xA3",  // U+FE63 small hyphen-minus
      "\xEF\xBC\x8D",  // U+FF0D fullwidth hyphen-minus
      "\x96",          // The en dash of Windows-1252
  };
  for (const std::string_view sign : kSigns)
    if (text.starts_with(sign)) return sign.size();
  return 0;
}

std::size_t column_of(std::string_view line, std::size_t byte) {
  std::size_t column = 1;
  for (std::size_t at = 0; at < std::min(byte, line.size()); ++column)
    at += std::max<std::size_t>(1, sequence_length(line.substr(at)));
  return column;
}

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7F; };
  for (std::size_t at = 0; at < text.size();) {
    const auto after = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at), text.end(), is_plain);
    const auto plain = static_cast<std::size_t>(after - text.begin()) - at;
    result.append(text.substr(at, plain));
    at += plain;
    if (at == text.size()) break;
    const std::size_t length = sequence_length(text.substr(at));
    const auto c = static_cast<unsigned char>(text[at]);
    if (c == '\t') {
      result.push_back(' ');
    } else if (length == 0 || c < 0x20 || c == 0x7F ||
               (length == 2 && c == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0)) {
      result += "\xEF\xBF\xBD";
    } else {
      result.append(text.substr(at, length));
    }
    at += std::max<std::size_t>(1, length);
  }
  return result;
}

std::string ascii(std::string_view text) {
  std::string shown(text);
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return shown;
}

}  // namespace isocnc::text
