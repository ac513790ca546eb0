#pragma once

#include <nlohmann/json.hpp>

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<>;

namespace isocnc::lsp::rpc {

/// Keys are looked up in a tree: a message with a hundred thousand of them costs no more than its length.
using Json = nlohmann::json;

}  // namespace isocnc::lsp::rpc
