#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

#define ISOCNC_REQUEST(name) extern const Request name;
#include <requests.inc>
#undef ISOCNC_REQUEST

static const Request* const kRequests[] = {
#define ISOCNC_REQUEST(name) &(name),
#include <requests.inc>
#undef ISOCNC_REQUEST
};

std::span<const Request* const> all_requests() { return kRequests; }

static constexpr dialect::Text kNoLine{"there is no line {}", "non c'è nessuna riga {}"};
static constexpr dialect::Text kBadHits{"a hit condition is a number, or one behind =, >, >=, <, <= or %, not {}",
                                        "una condizione sul numero di passaggi è un numero, o un numero dopo =, >, >=, "
                                        "<, <= o %, non {}"};

session::ValueFormat format_of(const Session& session, const Json& arguments) {
  session::ValueFormat format = session.launch_options().format;
  const Json wish = arguments.value("format", Json());
  if (session::find_flag(wish, "hex").value_or(false)) format.is_hexadecimal = true;
  return format;
}

std::uint64_t line_argument(const Session& session, const Json& arguments, const char* key) {
  const std::int64_t number = integer(arguments, key);
  const auto line = session.client().from_client_line(number);
  if (!line) throw RequestError(session.in_language(kNoLine, number));
  return *line;
}

session::BreakpointRules rules_of(const Session& session, const Json& breakpoint) {
  session::BreakpointRules rules;
  for (const char* const key : {"condition", "hitCondition", "logMessage"})
    rules.text += find_text(breakpoint, key).value_or("") + "\n";
  const auto is_given = [](const std::optional<std::string>& wish) {
    return wish && wish->find_first_not_of(" \t") != std::string::npos;
  };
  if (const auto condition = find_text(breakpoint, "condition"); is_given(condition)) {
    auto compiled = session::Expression::compile(*condition, session.language());
    if (const auto* const problem = std::get_if<session::ExpressionProblem>(&compiled))
      throw RequestError(problem->message);
    rules.condition = std::get<session::Expression>(std::move(compiled));
  }
  if (const auto hits = find_text(breakpoint, "hitCondition"); is_given(hits)) {
    rules.hits = session::HitCondition::read(*hits);
    if (!rules.hits) throw RequestError(session.in_language(kBadHits, *hits));
  }
  if (const auto message = find_text(breakpoint, "logMessage"); is_given(message)) {
    auto compiled = session::LogMessage::compile(*message, session.launch_options().format, session.language());
    if (const auto* const problem = std::get_if<session::ExpressionProblem>(&compiled))
      throw RequestError(problem->message);
    rules.message = std::get<session::LogMessage>(std::move(compiled));
  }
  return rules;
}

Json read_breakpoints(Session& session, const Json& arguments,
                      const std::function<void(const Json& breakpoint, std::int64_t id)>& read) {
  Json breakpoints = Json::array();
  for (const Json& each : list(arguments, "breakpoints")) {
    const std::int64_t id = session.new_breakpoint_id();
    try {
      read(each, id);
      breakpoints.push_back({{"id", id}, {"verified", true}});
    } catch (const RequestError& error) {
      breakpoints.push_back({{"id", id}, {"verified", false}, {"message", error.what()}});
    }
  }
  return {{"breakpoints", breakpoints}};
}

}  // namespace isocnc::debugger::requests
