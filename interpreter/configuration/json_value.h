#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

struct JsonMember;

/// A value of a JSON text, with its place.
struct JsonValue {
  enum class Kind : std::uint8_t { Null, Boolean, Number, String, List, Object };

  Kind kind = Kind::Null;
  std::size_t at = 0;   ///< Byte offset, from 0.
  std::size_t end = 0;  ///< That after its last byte.
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<JsonValue> elements;
  std::vector<JsonMember> members;  ///< In the order of the text; a key may occur twice.
};

struct JsonMember {
  std::string key;
  std::size_t at = 0;  ///< Byte offset of the key.
  JsonValue value;
};

/// Maximum nesting; no configuration needs more.
inline constexpr std::size_t kDeepestJson = 32;

/// Parses a JSON text with comments. For a text that is malformed, not UTF-8 or nested more deeply than kDeepestJson,
/// returns one mistake at the point where parsing stopped.
std::variant<JsonValue, Mistake> parse_json(std::string_view text);

}  // namespace isocnc::configuration
