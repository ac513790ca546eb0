#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "debugger/dap/protocol.h"
#include "debugger/session/session.h"

namespace isocnc::requests {

using dap::BreakpointBody;
using dap::BreakpointsBody;
using dap::Item;
using dap::member;
using dap::RequestError;
using dap::required;
using rpc::Json;
using session::Session;

/// Something that a client can ask for. Each has a file of its name in this folder, which defines it under that name
/// (`extern const DebugRequest step_back`); the build gathers them. A request knows no thread, no channel and no other
/// request: it takes arguments, asks the session, and returns the body of the response.
struct DebugRequest {
  std::string_view command;
  /// The body of the response, null for none. Throws RequestError, and what nlohmann-json throws where the arguments
  /// are wrong.
  Json (*answer)(Session& session, const Json& arguments) = nullptr;
  /// Its part of Capabilities; null for none.
  Json (*capabilities)() = nullptr;
};

/// The result of a handler, as JSON; null for one that returns nothing.
template <class Handle>
Json body_of(const Handle& handle) {
  if constexpr (std::is_void_v<decltype(handle())>) {
    handle();
    return nullptr;
  } else {
    return handle();
  }
}

template <auto handle>
struct AnswerOf;

template <class Body, Body (*handle)(Session&)>
struct AnswerOf<handle> {
  static Json answer(Session& session, const Json&) {
    return body_of([&] { return handle(session); });
  }
};

template <class Body, class Arguments, Body (*handle)(Session&, const Arguments&)>
struct AnswerOf<handle> {
  static Json answer(Session& session, const Json& arguments) {
    return body_of([&] { return handle(session, arguments.get<Arguments>()); });
  }
};

/// A request by its handler, `Body handle(Session&)` or `Body handle(Session&, const Arguments&)`, where Arguments can
/// be read from JSON and Body, unless it is void, written as JSON.
template <auto handle>
constexpr DebugRequest on(std::string_view command, Json (*capabilities)() = nullptr) {
  return {.command = command, .answer = AnswerOf<handle>::answer, .capabilities = capabilities};
}

/// All requests, in the order of their files' names.
std::span<const DebugRequest* const> all_requests();

/// As the launch wants it, and in hexadecimal where the request does.
expressions::ValueFormat format_of(const Session& session, const dap::FormatArguments& arguments);

/// A line of the client, from 0. Throws RequestError for one that cannot be.
std::size_t to_line(const Session& session, std::int64_t line);

/// Throws RequestError where one of the rules cannot be read.
breakpoints::BreakpointRules compile_rules(const Session& session, const dap::RuleArguments& arguments);

/// The breakpoints that are asked for, each with an id, and the response. One for which `make` throws RequestError is
/// left out, and the response says why.
template <class Breakpoint, class Arguments>
std::pair<std::vector<Breakpoint>, BreakpointsBody> make_breakpoints(
    Session& session, const std::vector<Item<Arguments>>& items,
    const std::function<Breakpoint(const Arguments& arguments, std::int64_t id)>& make) {
  std::pair<std::vector<Breakpoint>, BreakpointsBody> made;
  for (const Item<Arguments>& item : items) {
    BreakpointBody body{.id = session.new_breakpoint_id(), .message = {}, .line = {}, .source = {}};
    try {
      made.first.push_back(make(item.get(), *body.id));
      body.is_verified = true;
    } catch (const RequestError& error) {
      body.message = error.in(session.language());
    }
    made.second.breakpoints.push_back(std::move(body));
  }
  return made;
}

}  // namespace isocnc::requests
