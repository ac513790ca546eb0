#include <algorithm>
#include <array>

#include "analyzer/rules/rule.h"
#include "interpreter/execution/machine_move.h"

namespace isocnc::rules {

using execution::Travel;

/// The place where an axis exceeds its travel, at the end of a motion or at an arc's extreme point. A motion that
/// starts outside is reported only if it goes further out: the return is part of the same mistake.
static void check_travel_exceeded(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                                  execution::Sink& sink) {
  constexpr double kSlack = 1e-6;
  const geometry::Vec3 from = block.after.to_machine(move.from.tip);
  const std::array<double, execution::kAxisCount> start = {from.x(), from.y(), from.z(), move.from.b, move.from.c};
  const auto extents = execution::extents(execution::in_machine(move, block.after));
  for (std::size_t axis = 0; axis < start.size(); ++axis) {
    const Travel& travel = block.setup.limits.travel[axis];
    const geometry::Range& reached = extents[axis];
    const bool below = reached.minimum < std::min(travel.minimum, start[axis]) - kSlack;
    const bool above = reached.maximum > std::max(travel.maximum, start[axis]) + kSlack;
    if (!below && !above) continue;
    // In a face frame, other coordinates may move the machine's axis.
    const syntax::Word* const word =
        block.after.face_mounted && axis < 3 ? nullptr : block.argument(dialect::kAxisLetters[axis]);
    const bool is_in_inches = axis < 3 && block.after.in_inches();
    const double unit = dialect::mm_per_unit(is_in_inches);
    sink.report({.id = "travel-exceeded"_diag,
                 .is_in_inches = is_in_inches,
                 .span = word ? word->span() : block.motion_word().span(),
                 .values = {static_cast<double>(axis), (below ? reached.minimum : reached.maximum) / unit,
                            (below ? travel.minimum : travel.maximum) / unit}});
  }
}

extern const Rule travel_exceeded = {.check_move = check_travel_exceeded};

}  // namespace isocnc::rules
