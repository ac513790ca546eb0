#pragma once

#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<>;

namespace isocnc::rpc {

/// Objects keep their keys in a tree: the cost of a message with 100,000 keys stays in proportion to its length.
using Json = nlohmann::json;

/// The maximum nesting of a message: over twice what the protocols need. The library copies and writes values by
/// recursion, so a deeply nested value could overflow the stack and end the process.
inline constexpr std::size_t kDeepestMessage = 256;

/// Parses a message of the other side, in which half a surrogate pair is U+FFFD. Text that is not JSON, or nested more
/// deeply than kDeepestMessage, gives a `discarded` value of nlohmann-json.
Json parse(std::string_view text);

}  // namespace isocnc::rpc
