#include "interpreter/timing/spindle_turn.h"

namespace isocnc::timing {

SpindleMotion spindle_after(int function, double speed) {
  return function == 5 ? SpindleMotion{} : SpindleMotion{.function = function, .speed = speed};
}

SpindleMotion spindle_after(const running::Event& event, const SpindleMotion& before, double speed) {
  if (std::holds_alternative<running::ToolEvent>(event.what)) return {};
  const auto* const function = std::get_if<running::FunctionEvent>(&event.what);
  const bool turns = function != nullptr && !dialect::is_user_function(function->number);
  return turns ? spindle_after(function->number, speed) : before;
}

}  // namespace isocnc::timing
