#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "debugger/session/arguments.h"
#include "debugger/session/session.h"

namespace isocnc::debugger::requests {

using session::find_flag;
using session::find_integer;
using session::find_number;
using session::find_text;
using session::integer;
using session::Json;
using session::list;
using session::RequestError;
using session::Session;
using session::text;

/// Something that a client can ask for. Each has a file of its name in this folder, which defines it under that name
/// (`extern const Request step_back`); the build gathers them. A request knows no thread, no channel and no other
/// request: it takes arguments, asks the session, and returns the body of the response.
struct Request {
  std::string_view command;
  /// May throw RequestError, and what nlohmann-json throws where the arguments are wrong.
  Json (*answer)(Session& session, const Json& arguments) = nullptr;
  /// Its part of Capabilities; null for none.
  Json (*capabilities)() = nullptr;
};

/// All requests, in the order of their files' names.
std::span<const Request* const> all_requests();

/// As the launch wants it, and in hexadecimal where the request does (`format`).
session::ValueFormat format_of(const Session& session, const Json& arguments);

/// A line from 0. Throws RequestError for one that cannot be.
std::uint64_t line_argument(const Session& session, const Json& arguments, const char* key);

/// The condition, hit condition and log message of a breakpoint. Throws RequestError where one cannot be read.
session::BreakpointRules rules_of(const Session& session, const Json& breakpoint);

/// Goes through the breakpoints that are asked for: `read` takes each with its id, and throws RequestError for one that
/// cannot be. The body of the response.
Json read_breakpoints(Session& session, const Json& arguments,
                      const std::function<void(const Json& breakpoint, std::int64_t id)>& read);

}  // namespace isocnc::debugger::requests
