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

/// A value of a JSON text, which knows where it begins.
struct JsonValue {
  enum class Kind : std::uint8_t { Null, Boolean, Number, String, List, Object };

  Kind kind = Kind::Null;
  std::size_t at = 0;  ///< In bytes, from 0.
  bool boolean = false;
  double number = 0;
  std::string string;
  std::vector<JsonValue> elements;
  std::vector<JsonMember> members;  ///< As they stand: a key may be there twice.
};

struct JsonMember {
  std::string key;
  std::size_t at = 0;  ///< Of the key.
  JsonValue value;
};

/// Deeper than any configuration.
inline constexpr std::size_t kDeepestJson = 32;

/// Reads a JSON text with comments. What is no such text, is not UTF-8 or is nested more deeply than kDeepestJson has
/// one mistake, where reading ended.
std::variant<JsonValue, Mistake> parse_json(std::string_view text);

}  // namespace isocnc::configuration
