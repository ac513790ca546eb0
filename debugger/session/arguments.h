#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lsp/rpc/json.h"

namespace isocnc::debugger::session {

using lsp::rpc::Json;

// Members of a request's arguments. One that is there and of another type throws RequestError, and null counts as not
// there.
std::optional<std::int64_t> find_integer(const Json& arguments, const char* key);
std::optional<double> find_number(const Json& arguments, const char* key);
std::optional<bool> find_flag(const Json& arguments, const char* key);
std::optional<std::string> find_text(const Json& arguments, const char* key);

// Those that have to be there.
std::int64_t integer(const Json& arguments, const char* key);
std::string text(const Json& arguments, const char* key);

/// An array, empty where there is none.
Json list(const Json& arguments, const char* key);

}  // namespace isocnc::debugger::session
