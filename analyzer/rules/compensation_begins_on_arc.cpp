#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// G41 or G42 has been written, and no motion in the plane has followed.
static constexpr Facts kWaits = 1;

static constexpr RuleMemory kCompensationStart = {
    .facts = {Fact{.started_by = at(BlockStep::CompensationOn),
                   .ended_by = at(BlockStep::CompensationOff, BlockStep::CompensatedMotion)}}};

/// An arc as the first motion under G41 or G42.
static void check_compensation_begins_on_arc(const Block& block, execution::Sink& sink) {
  const std::uint8_t motion = block.motion();
  if (motion != 2 && motion != 3) return;
  const bool begins_here = !block.compensated() && (block.g(41) || block.g(42));
  if (begins_here || block.holds(kWaits)) report(sink, "compensation-begins-on-arc"_diag, block.motion_word().span());
}

extern const Rule compensation_begins_on_arc = {
    .concerns = kMotion, .check = check_compensation_begins_on_arc, .memory = &kCompensationStart};

}  // namespace isocnc::rules
