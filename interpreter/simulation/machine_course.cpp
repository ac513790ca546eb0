#include "interpreter/simulation/machine_course.h"

namespace isocnc::simulation {

void MachineCourse::take(const running::Event& event, const Listeners& listeners) {
  compensation_.take(event, compensated(listeners));
}

Compensation::Listeners MachineCourse::compensated(const Listeners& listeners) {
  return {.event = [this, &listeners](const running::Event& event) { go(event, listeners); },
          .warning =
              [&listeners](const RunWarning& warning) {
                if (listeners.warning) listeners.warning(warning);
              }};
}

void MachineCourse::go(const running::Event& event, const Listeners& listeners) {
  if (const auto* const frame = std::get_if<running::FrameEvent>(&event.what)) {
    position_.take(*frame);
    if (listeners.frame) listeners.frame(*frame, tip().tip);
  } else if (const auto* const tool = std::get_if<running::ToolEvent>(&event.what)) {
    position_.mount(machine_->motion.kinematics, machine_->length_of(tool->tool));
  } else if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) {
    kinematics::Move made = timing::planned_move(*move, *machine_, position_.tool_length());
    position_.follow(*move, made);
    listeners.move(event, made);
  }
}

}  // namespace isocnc::simulation
