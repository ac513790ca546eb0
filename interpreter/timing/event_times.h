#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "interpreter/motion/stretch.h"
#include "interpreter/timing/fifo.h"
#include "interpreter/timing/request_reader.h"

namespace isocnc::timing {

/// Callbacks of a run's times; each is optional.
struct TimingListeners {
  std::function<void(const TimedEvent&)> event;
  /// Called for each piece of motion, with its event. Called before `event`, so the event's duration is not known
  /// yet.
  std::function<void(const motion::Stretch&, const TimedEvent&)> stretch;
};

/// Gives requests the times that a RequestPlanner has found, and reports them, in their order. Each begins where the
/// one before it ends, to the last bit: so the durations alone decide. A value.
class EventTimes {
 public:
  /// `start`: seconds since the program start.
  EventTimes(TimingListeners listeners, const geometry::Pose& tip, double start)
      : listeners_(std::move(listeners)), time_(start), tip_(tip) {}

  void listen(TimingListeners listeners) { listeners_ = std::move(listeners); }

  Request& add() { return waiting_.emplace_back().request; }
  Request& last() { return waiting_.back().request; }

  /// The next stretch of motion.
  void take(const motion::Stretch& stretch) { take(stretch, &stretch); }
  /// The same where no listener wants more.
  void take(const motion::StretchTime& time) { take(time, nullptr); }
  bool wants_stretches() const { return static_cast<bool>(listeners_.stretch); }
  /// Reports all requests before that of the number, and that one too if it asks for the rest.
  void come_to_rest(std::uint64_t number);

  /// Seconds since the program start, at the end of all that is known.
  double time() const { return time_; }
  /// Where the tip was at the start, or after the last request to rest that has been reported; machine frame.
  const geometry::Pose& tip() const { return tip_; }

  void forget_reported() { waiting_.forget_popped(); }
  /// Heap memory in bytes, without the object itself.
  std::size_t memory() const { return waiting_.size() * sizeof(Waiting); }

 private:
  struct Waiting {
    Request request;
    bool has_begun = false;
  };

  void take(const motion::StretchTime& time, const motion::Stretch* stretch);
  void begin_first();
  void report_first();

  TimingListeners listeners_;
  Fifo<Waiting> waiting_;
  double time_;
  geometry::Pose tip_;
};

}  // namespace isocnc::timing
