#include "debugger/session/event_text.h"

#include <fmt/format.h>

namespace isocnc::session {

using dialect::Text;

static constexpr Text kToolChange{"tool change: {}", "cambio utensile: {}"};
static constexpr Text kSpindleSpeed{"spindle speed: S{}", "velocità mandrino: S{}"};

static std::string tool_change_text(const running::ToolEvent& change, const SessionState& state) {
  std::string name = running::tool_name(change.tool);
  const configuration::Tool* const tool = state.configuration.machine.find_tool(change.tool);
  if (tool && !tool->name.empty()) name += fmt::format(" ({})", tool->name);
  return state.in_language(kToolChange, name);
}

static std::string function_text(const running::FunctionEvent& call, const SessionState& state) {
  std::string text = fmt::format("M{:02}", call.number);
  for (const execution::FunctionParameter& each : call.parameters)
    text += fmt::format(" P{}={}", each.number, expressions::show_value(each.value));
  const configuration::NamedFunction* const named = state.configuration.machine.find_function(call.number);
  if (named && !named->name.empty()) text += fmt::format(" ({})", named->name);
  return text;
}

std::string event_text(const running::Event& event, const SessionState& state) {
  if (const auto* const change = std::get_if<running::ToolEvent>(&event.what)) return tool_change_text(*change, state);
  if (const auto* const speed = std::get_if<running::SpindleSpeedEvent>(&event.what))
    return state.in_language(kSpindleSpeed, expressions::show_value(speed->speed));
  if (const auto* const call = std::get_if<running::FunctionEvent>(&event.what)) return function_text(*call, state);
  if (const auto* const signal = std::get_if<running::SignalEvent>(&event.what))
    return fmt::format("G{}: {}", signal->code->number, state.in_language(signal->code->signal.message));
  return {};
}

}  // namespace isocnc::session
