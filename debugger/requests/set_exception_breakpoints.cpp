#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kNoFilter{"there is no filter {}", "non c'è nessun filtro {}"};

/// What the run stops at by itself.
static Json answer_set_exception_breakpoints(Session& session, const Json& arguments) {
  std::vector<std::string> names;
  for (const Json& filter : list(arguments, "filters"))
    names.push_back(filter.is_string() ? filter.get<std::string>() : filter.dump());
  for (const Json& option : list(arguments, "filterOptions")) names.push_back(text(option, "filterId"));
  session.exception_filters().turn_all_off();
  Json breakpoints = Json::array();
  for (const std::string& name : names) {
    const auto filter = session::find_exception_filter(name);
    if (filter) session.exception_filters().turn_on(*filter);
    Json breakpoint = {{"verified", filter.has_value()}};
    if (!filter) breakpoint["message"] = session.in_language(kNoFilter, name);
    breakpoints.push_back(breakpoint);
  }
  if (session.launch_options().break_on_warnings)
    session.exception_filters().turn_on(session::ExceptionFilter::Warnings);
  return {{"breakpoints", breakpoints}};
}

extern const Request set_exception_breakpoints = {.command = "setExceptionBreakpoints",
                                                  .answer = answer_set_exception_breakpoints};

}  // namespace isocnc::debugger::requests
