#include "analyzer/rules/rule.h"

namespace isocnc::rules {

/// An arc as the first motion under G41 or G42.
static void check_compensation_begins_on_arc(const Block& block, execution::Sink& sink) {
  const std::uint8_t motion = block.motion();
  if (motion != 2 && motion != 3) return;
  const bool begins_here = !block.compensated() && (block.g(41) || block.g(42));
  if (begins_here || block.before.knows(execution::State::kCompensationWaits))
    report(sink, "compensation-begins-on-arc"_diag, block.motion_word().span());
}

extern const Rule compensation_begins_on_arc = {kMotion, check_compensation_begins_on_arc};

}  // namespace isocnc::rules
