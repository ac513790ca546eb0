#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kNoFilter{"there is no filter {}", "non c'è nessun filtro {}"};

/// What the run stops at by itself.
static Json answer_set_exception_breakpoints(Session& session, const Json& arguments) {
  std::vector<std::string> names;
  for (const Json& filter : list(arguments, "filters"))
    names.push_back(filter.is_string() ? filter.get<std::string>() : filter.dump());
  for (const Json& option : list(arguments, "filterOptions")) names.push_back(text(option, "filterId"));
  session.watchmen.on = {};
  Json breakpoints = Json::array();
  for (const std::string& name : names) {
    const auto watch = session::find_watch(name);
    if (watch) session.watchmen.on[static_cast<std::size_t>(*watch)] = true;
    Json breakpoint = {{"verified", watch.has_value()}};
    if (!watch) breakpoint["message"] = session.in_language(kNoFilter, name);
    breakpoints.push_back(breakpoint);
  }
  if (session.wishes().break_on_warnings)
    session.watchmen.on[static_cast<std::size_t>(session::Watch::Warnings)] = true;
  return {{"breakpoints", breakpoints}};
}

extern const Request set_exception_breakpoints = {.command = "setExceptionBreakpoints",
                                                  .answer = answer_set_exception_breakpoints};

}  // namespace isocnc::debugger::requests
