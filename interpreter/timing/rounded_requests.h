#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/kinematics/move.h"
#include "interpreter/motion/rounded_path.h"
#include "interpreter/motion/rounder.h"

namespace isocnc::timing {

/// What the planner has to know of a request.
struct PlannedRequest {
  std::uint64_t number = 0;
  const kinematics::Move* move = nullptr;  ///< Null if it is no motion.
  double wait = 0;                         ///< Seconds at rest after the motion.
  bool rests = false;                      ///< Whether the machine comes to rest before it.
};

/// The path of some requests in a row, made apart from that of the requests before them. Its times depend on those, and
/// are left to a RequestPlanner. Only for machines whose jerk is not limited.
class RoundedRequests {
 public:
  explicit RoundedRequests(bool keeps_paths) : path_(keeps_paths) {}

  /// Makes the path of `requests`. `before`: the last motions and rests before them; none if these are the first
  /// requests. Returns false if that is too few to tell how the path goes on from there: then nothing else may be
  /// called.
  bool make(const kinematics::Machine& machine, std::span<const PlannedRequest> before,
            std::span<const PlannedRequest> requests);

  /// Number of the first request that the path depends on.
  std::uint64_t first_number() const { return first_number_; }
  motion::RoundedPathReader reader() const { return motion::RoundedPathReader(path_); }
  /// The end, in the path, of the rest before a request, and of its motion.
  std::size_t end_of_rest(std::size_t request) const { return ends_[request].rest; }
  std::size_t end_of_motion(std::size_t request) const { return ends_[request].motion; }
  /// What makes the path of the requests after these.
  const motion::Rounder& rounder_after() const { return after_; }
  /// What makes the path from one of `requests` on.
  motion::Rounder rounder_before(const kinematics::Machine& machine, std::span<const PlannedRequest> requests,
                                 std::size_t request) const;

 private:
  struct RequestEnds {
    std::size_t rest;
    std::size_t motion;
  };

  motion::RoundedPath path_;
  std::vector<RequestEnds> ends_;  ///< Of each request.
  motion::Rounder before_;
  motion::Rounder after_;
  std::uint64_t first_number_ = 0;
};

}  // namespace isocnc::timing
