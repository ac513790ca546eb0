#include <algorithm>
#include <cmath>

#include "analyzer/rules/rule.h"
#include "interpreter/execution/machine_move.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::rules {

/// A feed move that would turn B or C faster than the machine's maximum, in degrees/min.
static void check_rotary_speed_above_machine(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                                             execution::Sink& sink) {
  if (move.kind == execution::MoveKind::Rapid || !(move.feed > 0)) return;
  const double b = std::abs(move.to.b - move.from.b);
  const double c = std::abs(move.to.c - move.from.c);
  const double turn = std::max(b, c);
  const double maximum = block.setup.limits.rotary_speed;
  if (turn == 0 || std::isinf(maximum)) return;
  const double length = execution::in_machine(move, block.after).length;
  const double way = length > geometry::kEqualCoordinate ? length : turn;
  const double minutes = move.inverse_time ? 1 / move.feed : way / move.feed;
  if (turn <= maximum * minutes) return;
  const syntax::Word* const word = block.argument(b >= c ? 'B' : 'C');
  sink.report({.id = "rotary-speed-above-machine"_diag,
               .span = word ? word->span() : block.motion_word().span(),
               .values = {std::round(turn / minutes), maximum}});
}

extern const Rule rotary_speed_above_machine = {.check_move = check_rotary_speed_above_machine};

}  // namespace isocnc::rules
