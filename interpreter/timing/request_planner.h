#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "interpreter/motion/planner.h"
#include "interpreter/timing/request_reader.h"

namespace isocnc::timing {

/// What the planner has to know of a request.
struct PlannedRequest {
  std::uint64_t number = 0;
  const kinematics::Move* move = nullptr;  ///< Null if it is no motion.
  double wait = 0;                         ///< Seconds at rest after the motion.
  bool rests = false;                      ///< Whether the machine comes to rest before it.
};

inline PlannedRequest planned_request(const Request& request) {
  const TimedEvent& timed = request.timed;
  return {request.number, timed.move ? &*timed.move : nullptr, timed.wait, request.rest.has_value()};
}

/// Plans requests, from a rest on. How long a stretch takes does not depend on what was before the last rest, not even
/// in its last bit: so parts of a run that begin at rest can be planned apart from each other.
///
/// What is known goes to an `out`: `take(stretch)` for each stretch of motion, and `come_to_rest(number)` where the
/// machine is at rest before the request of this number.
class RequestPlanner {
 public:
  /// `first`: number of the first request.
  explicit RequestPlanner(const kinematics::Machine& machine, std::uint64_t first = 0)
      : planner_(machine), first_waiting_(first) {}

  template <class Out>
  void take(const PlannedRequest& request, Out& out) {
    const bool is_full = request.number - first_waiting_ >= kMaxWaiting;
    const kinematics::Move* move = request.move;
    std::optional<kinematics::Move> kept;
    if (is_full && move != nullptr) move = &kept.emplace(*move);  // What is reported moves what waits.
    if (is_full || request.rests) come_to_rest(request.number, out);
    if (request.rests) first_waiting_ = request.number + 1;
    if (move == nullptr) return;
    planner_.push(*move);
    if (request.wait > 0) planner_.rest(request.wait);
    hand_over(out);
  }

  /// Comes to rest after all requests.
  template <class Out>
  void finish(Out& out) {
    come_to_rest(std::numeric_limits<std::uint64_t>::max(), out);
  }

  void forget_handed_out() { planner_.forget_handed_out(); }
  /// Heap memory in bytes, without the object itself.
  std::size_t memory() const { return planner_.memory(); }

 private:
  /// Maximum number of requests that wait for their times; no control looks ahead so far. Then the machine is assumed
  /// to stop, so that memory does not grow with the program.
  static constexpr std::uint64_t kMaxWaiting = 32768;

  template <class Out>
  void hand_over(Out& out) {
    while (const motion::Stretch* const stretch = planner_.next()) {
      first_waiting_ = std::max(first_waiting_, stretch->tag + (stretch->ends_move ? 1 : 0));
      out.take(*stretch);
    }
  }

  template <class Out>
  void come_to_rest(std::uint64_t number, Out& out) {
    planner_.rest();
    hand_over(out);
    out.come_to_rest(number);
    first_waiting_ = number;
  }

  motion::Planner planner_;
  std::uint64_t first_waiting_;  ///< Number of the first request whose times are not known.
};

}  // namespace isocnc::timing
