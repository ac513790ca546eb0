#include "interpreter/execution/feed.h"

namespace isocnc::execution {

void take_feed(double number, State& state) {
  state.feed_given = true;
  state.feed_on_rapid = false;
  if (!(number > 0)) return;  // Reported; the feed before it stays.
  state.last_feed = {.number = number, .mm_per_unit = state.mm_per_unit()};
  if (!state.inverse_time()) state.feed_per_minute = state.last_feed;
}

void take_spindle_speed(double number, State& state) {
  if (!(number > 0)) return;  // Reported; the speed before it stays.
  state.spindle_speed = number;
  state.speed_known = true;
  state.speed_given = true;
}

}  // namespace isocnc::execution
