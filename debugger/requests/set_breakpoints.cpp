#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kOtherFile{"this is not the program that is debugged",
                                          "non è il programma in esecuzione"};
static constexpr dialect::Text kBehindEnd{"no block follows", "non segue nessun blocco"};

/// Older clients send lines alone.
static Json wanted_breakpoints(const Json& arguments) {
  Json breakpoints = list(arguments, "breakpoints");
  if (!breakpoints.empty() || arguments.contains("breakpoints")) return breakpoints;
  Json made = Json::array();
  for (const Json& line : list(arguments, "lines")) made.push_back({{"line", line}});
  return made;
}

static session::SourceBreakpoint read_wish(Session& session, const Json& breakpoint) {
  session::SourceBreakpoint wish{.id = session.new_breakpoint_id(),
                                 .wanted_line = line_argument(session, breakpoint, "line")};
  try {
    wish.rules = rules_of(session, breakpoint);
  } catch (const RequestError& error) {
    wish.problem = error.what();
  }
  return wish;
}

static Json to_json(const Session& session, const session::SourceBreakpoint& wish) {
  Json json = {{"id", wish.id}, {"verified", wish.line.has_value()}, {"source", session.source()}};
  json["line"] = session.client().to_client_line(wish.line.value_or(wish.wanted_line));
  if (!wish.problem.empty()) json["message"] = wish.problem;
  if (wish.problem.empty() && !wish.line) json["message"] = session.in_language(kBehindEnd);
  return json;
}

/// All breakpoints of a file, in place of those it had.
static Json answer_set_breakpoints(Session& session, const Json& arguments) {
  session.debuggee();
  const Json source = arguments.value("source", Json::object());
  const Json wanted = wanted_breakpoints(arguments);
  Json breakpoints = Json::array();
  if (!session.is_program(find_text(source, "path").value_or(""))) {
    for (std::size_t i = 0; i < wanted.size(); ++i)
      breakpoints.push_back({{"verified", false}, {"message", session.in_language(kOtherFile)}});
    return {{"breakpoints", breakpoints}};
  }
  std::vector<session::SourceBreakpoint> wishes;
  for (const Json& breakpoint : wanted) wishes.push_back(read_wish(session, breakpoint));
  for (const session::SourceBreakpoint& wish : session.set_source_breakpoints(std::move(wishes)))
    breakpoints.push_back(to_json(session, wish));
  return {{"breakpoints", breakpoints}};
}

static Json set_breakpoints_capabilities() {
  return {{"supportsConditionalBreakpoints", true},
          {"supportsHitConditionalBreakpoints", true},
          {"supportsLogPoints", true}};
}

extern const Request set_breakpoints = {
    .command = "setBreakpoints", .answer = answer_set_breakpoints, .capabilities = set_breakpoints_capabilities};

}  // namespace isocnc::debugger::requests
