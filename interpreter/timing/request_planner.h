#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "interpreter/motion/planner.h"
#include "interpreter/timing/request_reader.h"
#include "interpreter/timing/rounded_requests.h"

namespace isocnc::timing {

inline PlannedRequest planned_request(const Request& request) {
  const TimedEvent& timed = request.timed;
  return {request.number, timed.move ? &*timed.move : nullptr, timed.wait, request.rest.has_value()};
}

/// Plans requests, from a rest on. How long a stretch takes does not depend on what was before the last rest, not even
/// in its last bit: so parts of a run that begin at rest can be planned apart from each other.
///
/// What is known goes to an `out`: `take(stretch)` for each stretch of motion, or with its time alone if it does not
/// `wants_stretches()`, and `come_to_rest(number)` where the machine is at rest before the request of this number.
class RequestPlanner {
 public:
  /// `keeps_paths`: whether an `out` will want stretches. `first`: number of the first request.
  RequestPlanner(const kinematics::Machine& machine, bool keeps_paths, std::uint64_t first = 0)
      : planner_(machine, keeps_paths), first_waiting_(first) {}

  template <class Out>
  void take(const PlannedRequest& request, Out& out) {
    const bool is_full = is_full_at(request);
    const kinematics::Move* move = request.move;
    std::optional<kinematics::Move> kept;
    if (is_full && move != nullptr) move = &kept.emplace(*move);  // What is reported moves what waits.
    if (is_full) last_forced_rest_ = request.number;
    if (is_full || request.rests) come_to_rest(request.number, out);
    if (request.rests) first_waiting_ = request.number + 1;
    if (move == nullptr) return;
    planner_.push(*move);
    if (request.wait > 0) planner_.rest(request.wait);
    hand_over(out);
  }

  /// Does what take() of each of these requests does, by their path.
  template <class Out>
  void take(std::span<const PlannedRequest> requests, const RoundedRequests& rounded,
            const kinematics::Machine& machine, Out& out) {
    std::size_t i = 0;
    if (!last_forced_rest_ || *last_forced_rest_ < rounded.first_number()) {
      motion::RoundedPathReader path = rounded.reader();
      for (; i < requests.size() && !is_full_at(requests[i]); ++i) take(requests[i], i, rounded, path, out);
      planner_.go_on_from(i == requests.size() ? rounded.rounder_after()
                                               : rounded.rounder_before(machine, requests, i));
    }
    for (; i < requests.size(); ++i) take(requests[i], out);
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

  bool is_full_at(const PlannedRequest& request) const { return request.number - first_waiting_ >= kMaxWaiting; }

  /// The next request, the `i`-th one of `rounded`.
  template <class Out>
  void take(const PlannedRequest& request, std::size_t i, const RoundedRequests& rounded,
            motion::RoundedPathReader& path, Out& out) {
    if (request.rests) {
      planner_.take_rounded(path, rounded.end_of_rest(i));
      hand_over(out);
      out.come_to_rest(request.number);
      first_waiting_ = request.number + 1;
    }
    if (request.move == nullptr) return;
    planner_.take_rounded(path, rounded.end_of_motion(i));
    hand_over(out);
  }

  template <class Out>
  void hand_over(Out& out) {
    if (out.wants_stretches()) {
      while (const motion::Stretch* const stretch = planner_.next()) hand_over(*stretch, out);
    } else {
      while (const motion::StretchTime* const time = planner_.next_time()) hand_over(*time, out);
    }
  }

  template <class StretchOrTime, class Out>
  void hand_over(const StretchOrTime& stretch, Out& out) {
    first_waiting_ = std::max(first_waiting_, stretch.tag + (stretch.ends_move ? 1 : 0));
    out.take(stretch);
  }

  template <class Out>
  void come_to_rest(std::uint64_t number, Out& out) {
    planner_.rest();
    hand_over(out);
    out.come_to_rest(number);
    first_waiting_ = number;
  }

  motion::Planner planner_;
  std::uint64_t first_waiting_;                    ///< Number of the first request whose times are not known.
  std::optional<std::uint64_t> last_forced_rest_;  ///< Request before which the machine was last assumed to stop.
};

}  // namespace isocnc::timing
