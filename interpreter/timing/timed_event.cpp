#include "interpreter/timing/timed_event.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "interpreter/kinematics/travel.h"

namespace isocnc::timing {

using execution::MoveKind;

double tip_length(const TimedEvent& timed, const TimedMachine& machine) {
  return timed.move ? kinematics::tip_travel(machine.motion, *timed.move).length : 0;
}

std::string to_json(const TimedEvent& timed, const TimedMachine& machine) {
  std::array<std::pair<std::string_view, double>, 4> more;
  std::size_t count = 0;
  const auto* const move = std::get_if<running::MoveEvent>(&timed.event.what);
  if (timed.move) more[count++] = {"lengthMm", tip_length(timed, machine)};
  if (move != nullptr && move->kind != MoveKind::Rapid) more[count++] = {"feed", running::feed_of(*move)};
  more[count++] = {"start", timed.start};
  more[count++] = {"duration", timed.duration};
  return to_json(timed.event, std::span(more).first(count));
}

}  // namespace isocnc::timing
