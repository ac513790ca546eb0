#include "lsp/rpc/long_text.h"

#include <charconv>
#include <cstdint>
#include <cstring>

namespace isocnc::rpc {

/// The placeholder for a long string is this text and a number. If the other side sends such a text itself, it is read
/// as a long string of the same message, which does no harm.
static constexpr std::string_view kPlaceholder{"\0text:", 6};
static constexpr std::string_view kWrittenPlaceholder = "\\u0000text:";

static const char* find(const char* begin, const char* end, char wanted) {
  const void* const at = begin == end ? nullptr : std::memchr(begin, wanted, static_cast<std::size_t>(end - begin));
  return at ? static_cast<const char*>(at) : end;
}

/// The quote that closes a string whose characters start at `begin`; `end` if there is none.
static const char* closing_quote(const char* const begin, const char* end) {
  for (const char* quote = find(begin, end, '"'); quote != end; quote = find(quote + 1, end, '"')) {
    const char* before = quote;
    while (before != begin && before[-1] == '\\') --before;
    if ((quote - before) % 2 == 0) return quote;
  }
  return end;
}

/// The message with placeholders for its long strings, which are collected in `long_strings`.
static std::string without_long_strings(std::string_view message, std::vector<std::string_view>& long_strings) {
  std::string rest;
  const char* copied = message.data();
  const char* const end = message.data() + message.size();
  for (const char* quote = find(copied, end, '"'); quote != end;) {
    const char* const begin = quote + 1;
    const char* const closing = closing_quote(begin, end);
    if (closing == end) break;
    if (static_cast<std::size_t>(closing - begin) >= ParsedMessage::kLong) {
      rest.append(copied, begin);
      rest.append(kWrittenPlaceholder).append(std::to_string(long_strings.size()));
      long_strings.emplace_back(begin, static_cast<std::size_t>(closing - begin));
      copied = closing;
    }
    quote = find(closing + 1, end, '"');
  }
  rest.append(copied, end);
  return rest;
}

ParsedMessage ParsedMessage::parse(std::string text) {
  ParsedMessage parsed;
  if (text.size() < kLong) {
    parsed.json = rpc::parse(text);
    return parsed;
  }
  const auto message = std::make_shared<const std::string>(std::move(text));
  std::vector<std::string_view> long_strings;
  parsed.json = rpc::parse(without_long_strings(*message, long_strings));
  for (const std::string_view written : long_strings) parsed.long_texts_.emplace_back(message, written);
  return parsed;
}

std::string ParsedMessage::text(const Json& string) const {
  const auto& here = string.get_ref<const std::string&>();
  if (!here.starts_with(kPlaceholder)) return here;
  std::size_t index = 0;
  const char* const end = here.data() + here.size();
  const auto [after, error] = std::from_chars(here.data() + kPlaceholder.size(), end, index);
  const bool is_placeholder = error == std::errc() && after == end && index < long_texts_.size();
  return is_placeholder ? long_texts_[index].read() : here;
}

Json ParsedMessage::with_texts(Json part) const {
  if (long_texts_.empty()) return part;
  if (part.is_string()) return text(part);
  if (part.is_structured())
    for (Json& each : part) each = with_texts(std::move(each));
  return part;
}

/// The value of the four hexadecimal digits after \u; U+FFFD if they are missing.
static std::uint32_t code_unit(const char*& p, const char* end) {
  std::uint32_t unit = 0;
  if (end - p < 4) return 0xFFFD;
  const auto [after, error] = std::from_chars(p, p + 4, unit, 16);
  if (error != std::errc() || after != p + 4) return 0xFFFD;
  p += 4;
  return unit;
}

static void append_code_point(std::string& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

/// Reads the digits after \u, and the second half of a surrogate pair.
static void read_unicode(const char*& p, const char* end, std::string& text) {
  std::uint32_t code = code_unit(p, end);
  const auto is_low = [](std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; };
  if (code >= 0xD800 && code < 0xDC00 && end - p >= 6 && p[0] == '\\' && p[1] == 'u') {
    const char* after = p + 2;
    const std::uint32_t low = code_unit(after, end);
    if (is_low(low)) {
      p = after;
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
  }
  append_code_point(text, code >= 0xD800 && code < 0xE000 ? 0xFFFD : code);
}

std::string LongText::read() const {
  std::string text;
  text.reserve(written_.size());
  const char* p = written_.data();
  const char* const end = p + written_.size();
  for (;;) {
    const char* const escape = find(p, end, '\\');
    text.append(p, escape);
    if (escape == end || escape + 1 == end) return text;
    p = escape + 2;
    switch (escape[1]) {
      case 'n':
        text.push_back('\n');
        break;
      case 'r':
        text.push_back('\r');
        break;
      case 't':
        text.push_back('\t');
        break;
      case 'b':
        text.push_back('\b');
        break;
      case 'f':
        text.push_back('\f');
        break;
      case 'u':
        read_unicode(p, end, text);
        break;
      default:
        text.push_back(escape[1]);
        break;
    }
  }
}

}  // namespace isocnc::rpc
