#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// G41 or G42 has been written, and no motion in the plane has followed.
static constexpr Facts kWaits = 1;

static constexpr RuleMemory kCompensationStart = {
    .facts = {Fact{.started_by = at(BlockStep::CompensationOn),
                   .ended_by = at(BlockStep::CompensationOff, BlockStep::CompensatedMotion)}}};

/// An arc as the first motion under G41 or G42.
static void check_compensation_begins_on_arc(const ExecutedBlock& block, execution::Sink& sink) {
  const dialect::GCode* const motion = block.motion();
  if (!motion || !motion->is_arc()) return;
  const bool begins_here =
      !block.compensated() && (block.g(GRole::CompensationLeft) || block.g(GRole::CompensationRight));
  if (begins_here || block.holds(kWaits)) report(sink, "compensation-begins-on-arc"_diag, block.motion_word().span());
}

extern const Rule compensation_begins_on_arc = {
    .concerns = kMotion, .check = check_compensation_begins_on_arc, .memory = &kCompensationStart};

}  // namespace isocnc::rules
