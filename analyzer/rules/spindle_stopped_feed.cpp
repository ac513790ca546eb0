#include "analyzer/rules/rule.h"
#include "analyzer/rules/spindle_use.h"

namespace isocnc::rules {

/// A feed move after M05, or after an S without M03 or M04. Without an S, the program may need no spindle: it may be
/// for a laser, or be part of a program.
static void check_spindle_stopped_feed(const ExecutedBlock& block, execution::Sink& sink) {
  if (!block.has_feed_move()) return;
  const int function = block.spindle_function_before(block.motion_word());
  if (function != 0 && function != 5) return;
  const bool has_speed = block.before.speed_given || block.line.spindle >= 0;
  const bool never_started = has_speed && block.holds(kNotStarted) && !block.has_user_function();
  const bool stops_here = function == 5 && block.spindle_turns();
  if (stops_here || never_started || block.holds(kStopped))
    report(sink, "spindle-stopped-feed"_diag, block.motion_word().span());
}

extern const Rule spindle_stopped_feed = {
    .concerns = kMotion, .check = check_spindle_stopped_feed, .memory = &kSpindleUse};

}  // namespace isocnc::rules
