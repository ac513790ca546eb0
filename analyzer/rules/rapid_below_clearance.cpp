#include "analyzer/rules/rule.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::rules {

/// A rapid that goes down below the clearance, or moves across the face below it; rising rapids are allowed.
static void check_rapid_below_clearance(const ExecutedBlock& block, const execution::ProgrammedMove& move,
                                        execution::Sink& sink) {
  if (move.kind != execution::MoveKind::Rapid || !block.setup.clearance) return;
  const double clearance = *block.setup.clearance - geometry::kEqualCoordinate;
  const geometry::Vec3 way = move.to.tip - move.from.tip;
  if (move.to.tip.z() >= clearance) return;
  const bool crosses = way.head<2>().cwiseAbs().maxCoeff() > geometry::kEqualCoordinate;
  // The first motion leaves the home position; that path is the machine's responsibility.
  const bool leaves_home = block.before.motion() == nullptr;
  if (way.z() >= 0 && (!crosses || leaves_home)) return;
  const syntax::Word* const word = block.argument('Z');
  sink.report({.id = "rapid-below-clearance"_diag,
               .span = word ? word->span() : block.motion_word().span(),
               .values = {move.to.tip.z(), *block.setup.clearance}});
}

extern const Rule rapid_below_clearance = {.check_move = check_rapid_below_clearance};

}  // namespace isocnc::rules
