#include "interpreter/timing/event_times.h"

namespace isocnc::timing {

void EventTimes::begin_first() {
  if (!std::exchange(waiting_.front().has_begun, true)) waiting_.front().request.timed.start = time_;
}

void EventTimes::take(const motion::StretchTime& time, const motion::Stretch* stretch) {
  for (; !waiting_.empty() && waiting_.front().request.number < time.tag; report_first()) begin_first();
  if (waiting_.empty()) return;
  begin_first();
  TimedEvent& moving = waiting_.front().request.timed;
  if (listeners_.stretch && stretch != nullptr) {
    motion::Stretch placed = *stretch;
    placed.start = time_;
    listeners_.stretch(placed, moving);
  }
  time_ += time.duration;
  moving.duration = time_ - moving.start;
  if (time.ends_move) report_first();
}

void EventTimes::report_first() {
  const TimedEvent& timed = waiting_.front().request.timed;
  time_ += timed.wait;
  if (listeners_.event) listeners_.event(timed);
  waiting_.pop_front();
}

/// Requests without a following motion are made now.
void EventTimes::come_to_rest(std::uint64_t number) {
  for (; !waiting_.empty() && waiting_.front().request.number < number; report_first()) begin_first();
  if (waiting_.empty() || !waiting_.front().request.rest) return;
  begin_first();
  Request& request = waiting_.front().request;
  request.timed.duration = *request.rest;
  time_ += *request.rest;
  tip_ = request.tip;
  report_first();
}

}  // namespace isocnc::timing
