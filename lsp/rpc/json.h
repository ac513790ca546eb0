#pragma once

#include <cstddef>
#include <string_view>

#include <nlohmann/json.hpp>

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<>;

namespace isocnc::lsp::rpc {

/// Keys are looked up in a tree: a message with a hundred thousand of them costs no more than its length.
using Json = nlohmann::json;

/// No message of the protocols nests half as deeply. The library copies and writes a value by recursion: one nested
/// more deeply than the stack would end the process.
inline constexpr std::size_t kDeepestMessage = 256;

/// Of what comes from the other side. Discarded (nlohmann's word) where it is no JSON, or nested more deeply.
Json parse(std::string_view text);

}  // namespace isocnc::lsp::rpc
