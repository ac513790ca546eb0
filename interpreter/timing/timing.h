#pragma once

#include "interpreter/timing/event_times.h"
#include "interpreter/timing/request_planner.h"
#include "interpreter/timing/request_reader.h"

namespace isocnc::timing {

/// Computes the times of the events of a run. The control looks ahead, so the duration of a motion is known some
/// motions later. Events are reported in the order in which they were taken. Memory does not grow with the program:
/// after more waiting events than any control looks ahead the machine is assumed to stop.
class Timing : private RequestReader::Receiver {
 public:
  Timing(const TimedMachine& machine, TimingListeners listeners)
      : reader_(machine), planner_(machine.motion, true), times_(std::move(listeners), machine.home, 0) {}
  /// Continues from `standing` instead of the program start.
  Timing(const TimedMachine& machine, const Standing& standing)
      : reader_(machine, standing), planner_(machine.motion, true), times_({}, standing.tip, standing.time) {}

  /// Replaces the callbacks. A Timing is a value: a copy runs independently but calls the same callbacks.
  void listen(TimingListeners listeners) { times_.listen(std::move(listeners)); }

  void take(const running::Event& event) { reader_.take(event, *this); }

  /// Ends the run: the machine comes to rest.
  void finish() {
    reader_.finish(*this);
    planner_.finish(times_);
  }

  /// Frees the memory of events already reported. Call it before copying, so that the copy is small.
  void release_reported() {
    times_.forget_reported();
    planner_.forget_handed_out();
  }

  /// Heap memory in bytes, without the object itself.
  std::size_t memory() const { return times_.memory() + planner_.memory(); }

  /// Seconds since the program start, at the end of all that is known.
  double time() const { return times_.time(); }

  /// Position of the resting machine, tip (machine frame) and joints: at the start, in the callback of a tool change,
  /// and at the end.
  geometry::Pose tip() const { return reader_.tip(); }
  kinematics::Coordinates joints() const { return reader_.joints(); }

 private:
  Request& add() override { return times_.add(); }
  Request& last() override { return times_.last(); }
  void complete_last() override { planner_.take(planned_request(times_.last()), times_); }

  RequestReader reader_;
  RequestPlanner planner_;
  EventTimes times_;
};

}  // namespace isocnc::timing
