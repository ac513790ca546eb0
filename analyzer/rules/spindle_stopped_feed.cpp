#include "analyzer/rules/rule.h"

namespace isocnc::analyzer::rules {

/// A feed move after M05. Not before the first M03: how a program's spindle is started first is the shop's affair.
static void check(const Block& block, execution::Sink& sink) {
  const std::uint8_t motion = block.motion();
  const bool is_feed = motion != 0 && motion != dialect::kNoMotion;
  if (!is_feed) return;
  const int function = block.spindle_function_before(block.motion_word());
  const bool stops_here = function == 5 && block.spindle_turns();
  const bool stands = function == 0 || function == 5 ? block.before.knows(execution::State::kStopped) : false;
  if (!stops_here && !stands) return;
  report(sink, "spindle-stopped-feed"_diag, block.motion_word().span());
}

extern const Rule spindle_stopped_feed = {kMotion, check};

}  // namespace isocnc::analyzer::rules
