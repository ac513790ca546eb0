#include "lsp/rpc/json.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <system_error>

template class nlohmann::basic_json<>;

namespace isocnc::rpc {

/// Ignores brackets within strings.
static bool nests_too_deeply(std::string_view text) {
  std::size_t depth = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_in_string = !is_in_string;
    if (is_in_string) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestMessage) return true;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return false;
}

/// The length of `\u` and four digits.
static constexpr std::size_t kEscapeLength = 6;

/// The UTF-16 unit of such an escape at the start of a text.
static std::optional<std::uint32_t> escaped_unit(std::string_view text) {
  if (text.size() < kEscapeLength || !text.starts_with("\\u")) return std::nullopt;
  std::uint32_t unit = 0;
  const char* const end = text.data() + kEscapeLength;
  const auto [after, error] = std::from_chars(text.data() + 2, end, unit, 16);
  return error == std::errc() && after == end ? std::optional(unit) : std::nullopt;
}

static bool is_high(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
static bool is_low(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

/// The text with U+FFFD in place of each half of a surrogate pair.
static std::string with_whole_characters(std::string text) {
  for (std::size_t at = text.find('\\'); at < text.size(); at = text.find('\\', at)) {
    const std::string_view rest = std::string_view(text).substr(at);
    const auto unit = escaped_unit(rest);
    if (!unit) {
      at += 2;
      continue;
    }
    const auto next = escaped_unit(rest.substr(kEscapeLength));
    const bool is_pair = is_high(*unit) && next && is_low(*next);
    if (!is_pair && (is_high(*unit) || is_low(*unit))) text.replace(at, kEscapeLength, "\\uFFFD");
    at += is_pair ? 2 * kEscapeLength : kEscapeLength;
  }
  return text;
}

/// An editor whose user deletes half a character sends the other half, which the library takes for no JSON.
Json parse(std::string_view text) {
  if (nests_too_deeply(text)) return Json(Json::value_t::discarded);
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() && text.find("\\u") != std::string_view::npos)
    json = Json::parse(with_whole_characters(std::string(text)), nullptr, false);
  return json;
}

}  // namespace isocnc::rpc
