#include "analyzer/rules/rule.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::analyzer::rules {

/// A rapid that goes below the clearance, or crosses the face beneath it; not one that only rises.
static void check(const Block& block, const execution::Move& move, execution::Sink& sink) {
  if (move.kind != execution::MoveKind::Rapid || !block.setup.clearance) return;
  const double clearance = *block.setup.clearance - geometry::kEqualCoordinate;
  const geometry::Vec3 way = move.to.tip - move.from.tip;
  const bool goes_down = way.z() < 0 && move.to.tip.z() < clearance;
  const bool crosses = way.head<2>().cwiseAbs().maxCoeff() > geometry::kEqualCoordinate;
  // The first motion leaves the home position, which is the machine's affair.
  const bool begins_below =
      block.before.mode(dialect::ModalGroup::Motion) != dialect::kNoMotion && move.from.tip.z() < clearance;
  if (!goes_down && !(crosses && begins_below)) return;
  const syntax::Word* const word = goes_down ? block.argument('Z') : nullptr;
  sink.report({.id = "rapid-below-clearance"_diag,
               .span = word ? word->span() : block.motion_word().span(),
               .values = {goes_down ? move.to.tip.z() : move.from.tip.z(), *block.setup.clearance}});
}

extern const Rule rapid_below_clearance = {.check_move = check};

}  // namespace isocnc::analyzer::rules
