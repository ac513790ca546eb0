#include "debugger/requests/request.h"

namespace isocnc::requests {

#define ISOCNC_REQUEST(name) extern const DebugRequest name;
#include <requests.inc>
#undef ISOCNC_REQUEST

static const DebugRequest* const kRequests[] = {
#define ISOCNC_REQUEST(name) &(name),
#include <requests.inc>
#undef ISOCNC_REQUEST
};

std::span<const DebugRequest* const> all_requests() { return kRequests; }

static constexpr dialect::Text kNoLine{"there is no line {}", "non c'è nessuna riga {}"};
static constexpr dialect::Text kBadHits{"a hit condition is a number, or one after =, >, >=, <, <= or %, not {}",
                                        "una condizione sul numero di passaggi è un numero, o un numero dopo =, >, >=, "
                                        "<, <= o %, non {}"};

expressions::ValueFormat format_of(const Session& session, const dap::FormatArguments& arguments) {
  expressions::ValueFormat format = session.launch_options().format;
  if (arguments.is_hexadecimal) format.is_hexadecimal = true;
  return format;
}

std::size_t to_line(const Session& session, std::int64_t line) {
  const auto from_zero = session.client().from_client_line(line);
  if (!from_zero) throw RequestError(session.in_language(kNoLine, line));
  return *from_zero;
}

/// What has been compiled. Throws RequestError for a mistake.
template <class Compiled>
static Compiled compiled_or_throw(std::variant<Compiled, expressions::ExpressionProblem> result) {
  if (const auto* const problem = std::get_if<expressions::ExpressionProblem>(&result))
    throw RequestError(problem->message);
  return std::get<Compiled>(std::move(result));
}

/// A client may send a rule that has been left empty.
static bool is_given(const std::optional<std::string>& rule) {
  return rule && rule->find_first_not_of(" \t") != std::string::npos;
}

breakpoints::BreakpointRules compile_rules(const Session& session, const dap::RuleArguments& arguments) {
  const auto& [condition, hits, message] = arguments;
  breakpoints::BreakpointRules rules;
  rules.text = condition.value_or("") + "\n" + hits.value_or("") + "\n" + message.value_or("") + "\n";
  if (is_given(condition))
    rules.condition = compiled_or_throw(expressions::Expression::compile(*condition, session.language()));
  if (is_given(hits)) {
    rules.hits = breakpoints::HitCondition::read(*hits);
    if (!rules.hits) throw RequestError(session.in_language(kBadHits, *hits));
  }
  if (is_given(message))
    rules.message = compiled_or_throw(
        expressions::LogMessage::compile(*message, session.launch_options().format, session.language()));
  return rules;
}

}  // namespace isocnc::requests
