#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNoFilter{"there is no filter {}", "non c'è nessun filtro {}"};
static constexpr dialect::Text kNoCondition{"the filter {} takes no condition", "il filtro {} non ammette condizioni"};

namespace {

/// A filter that is to be on.
struct WantedFilter {
  std::string name;
  std::string condition;  ///< Empty for none.
};

struct FilterArguments {
  std::vector<WantedFilter> filters;
};

/// What is no name is shown as it is: no filter has that name.
void from_json(const Json& json, FilterArguments& arguments) {
  for (const Json& filter : member<std::vector<Json>>(json, "filters").value_or(std::vector<Json>()))
    arguments.filters.push_back({filter.is_string() ? filter.get<std::string>() : filter.dump(), {}});
  for (const Json& option : member<std::vector<Json>>(json, "filterOptions").value_or(std::vector<Json>()))
    arguments.filters.push_back(
        {required<std::string>(option, "filterId"), member<std::string>(option, "condition").value_or("")});
}

}  // namespace

static BreakpointBody refused(std::string message) {
  return {.id = {}, .message = std::move(message), .line = {}, .source = {}};
}

static BreakpointBody turn_on(Session& session, const WantedFilter& wanted) {
  const auto filter = breakpoints::find_exception_filter(wanted.name);
  if (!filter) return refused(session.in_language(kNoFilter, wanted.name));
  std::optional<expressions::Expression> condition;
  if (!wanted.condition.empty()) {
    if (!breakpoints::definition(*filter).takes_condition)
      return refused(session.in_language(kNoCondition, wanted.name));
    auto compiled = expressions::Expression::compile(wanted.condition, session.language());
    if (const auto* const problem = std::get_if<expressions::ExpressionProblem>(&compiled))
      return refused(problem->message);
    condition = std::get<expressions::Expression>(std::move(compiled));
  }
  session.exception_filters().turn_on(*filter, std::move(condition));
  return {.id = {}, .is_verified = true, .message = {}, .line = {}, .source = {}};
}

/// The exception filters that are on. Warnings stay on where the launch asks for them.
static BreakpointsBody answer_set_exception_breakpoints(Session& session, const FilterArguments& arguments) {
  session.exception_filters().turn_all_off();
  BreakpointsBody body;
  for (const WantedFilter& wanted : arguments.filters) body.breakpoints.push_back(turn_on(session, wanted));
  if (session.launch_options().break_on_warnings)
    session.exception_filters().turn_on(breakpoints::ExceptionFilter::Warnings);
  return body;
}

static Json exception_filter_capabilities() { return {{"supportsExceptionFilterOptions", true}}; }

extern const DebugRequest set_exception_breakpoints =
    on<&answer_set_exception_breakpoints>("setExceptionBreakpoints", exception_filter_capabilities);

}  // namespace isocnc::requests
