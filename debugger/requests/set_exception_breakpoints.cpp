#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNoFilter{"there is no filter {}", "non c'è nessun filtro {}"};

namespace {

struct FilterArguments {
  std::vector<std::string> names;
};

/// What is no name is shown as it is: no filter has that name.
void from_json(const Json& json, FilterArguments& arguments) {
  for (const Json& filter : member<std::vector<Json>>(json, "filters").value_or(std::vector<Json>()))
    arguments.names.push_back(filter.is_string() ? filter.get<std::string>() : filter.dump());
  for (const Json& option : member<std::vector<Json>>(json, "filterOptions").value_or(std::vector<Json>()))
    arguments.names.push_back(required<std::string>(option, "filterId"));
}

}  // namespace

static BreakpointBody turn_on(Session& session, const std::string& name) {
  const auto filter = breakpoints::find_exception_filter(name);
  if (!filter) return {.id = {}, .message = session.in_language(kNoFilter, name), .line = {}, .source = {}};
  session.exception_filters().turn_on(*filter);
  return {.id = {}, .is_verified = true, .message = {}, .line = {}, .source = {}};
}

/// The exception filters that are on. Warnings stay on where the launch asks for them.
static BreakpointsBody answer_set_exception_breakpoints(Session& session, const FilterArguments& arguments) {
  session.exception_filters().turn_all_off();
  BreakpointsBody body;
  for (const std::string& name : arguments.names) body.breakpoints.push_back(turn_on(session, name));
  if (session.launch_options().break_on_warnings)
    session.exception_filters().turn_on(breakpoints::ExceptionFilter::Warnings);
  return body;
}

extern const DebugRequest set_exception_breakpoints = on<&answer_set_exception_breakpoints>("setExceptionBreakpoints");

}  // namespace isocnc::requests
