#include "analyzer/rules/rule.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::rules {

/// An arc by radius that ends where it starts has no sweep (D36); a full turn needs a center.
static void check_arc_goes_nowhere(const ExecutedBlock& block, execution::Sink& sink) {
  const dialect::GCode* const motion = block.motion();
  if (!motion || !motion->is_arc() || block.before.unknown != 0 || block.after.unknown != 0) return;
  const syntax::Word* radius = nullptr;
  for (const syntax::Word& word : block.line.words) {
    if (word.owner == syntax::Word::kNoOwner) continue;
    if (word.letter == 'I' || word.letter == 'J' || word.letter == 'K') return;
    if (word.letter == 'R') radius = &word;
  }
  if (!radius || !block.line.findings.empty()) return;
  const geometry::Vec3 way = block.after.position.tip - block.before.position.tip;
  if (way.cwiseAbs().maxCoeff() <= geometry::kEqualCoordinate) report(sink, "arc-goes-nowhere"_diag, radius->span());
}

extern const Rule arc_goes_nowhere = {kMotion, check_arc_goes_nowhere};

}  // namespace isocnc::rules
