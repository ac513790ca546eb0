#include "analyzer/rules/rule.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::rules {

/// A rapid or a straight feed move to the tool's current position; arcs have their own code.
static void check_motion_goes_nowhere(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                                      execution::Sink& sink) {
  if (move.kind == execution::MoveKind::Arc) return;
  const double way = (move.to.tip - move.from.tip).cwiseAbs().maxCoeff();
  const double turn = std::max(std::abs(move.to.b - move.from.b), std::abs(move.to.c - move.from.c));
  if (std::max(way, turn) <= geometry::kEqualCoordinate)
    report(sink, "motion-goes-nowhere"_diag, block.motion_word().span());
}

extern const Rule motion_goes_nowhere = {.check_move = check_motion_goes_nowhere};

}  // namespace isocnc::rules
