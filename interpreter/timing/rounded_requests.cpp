#include "interpreter/timing/rounded_requests.h"

namespace isocnc::timing {

static void round_rest(const PlannedRequest& request, const kinematics::Machine& machine, motion::Rounder& rounder,
                       motion::RoundedPath& path) {
  if (request.rests) rounder.come_to_rest(machine, path);
}

static void round_motion(const PlannedRequest& request, const kinematics::Machine& machine, motion::Rounder& rounder,
                         motion::RoundedPath& path) {
  if (request.move == nullptr) return;
  rounder.push(machine, *request.move, path);
  while (rounder.has_more()) rounder.take_next(machine, path);
  if (request.wait <= 0) return;
  rounder.come_to_rest(machine, path);
  path.wait(request.wait);
}

/// Goes on past these requests.
static motion::Rounder advanced(motion::Rounder rounder, const kinematics::Machine& machine,
                                std::span<const PlannedRequest> requests) {
  motion::RoundedPath path(false);
  for (const PlannedRequest& request : requests) {
    round_rest(request, machine, rounder, path);
    round_motion(request, machine, rounder, path);
  }
  return rounder;
}

bool RoundedRequests::make(const kinematics::Machine& machine, std::span<const PlannedRequest> before,
                           std::span<const PlannedRequest> requests) {
  before_ = before.empty() ? motion::Rounder() : advanced(motion::Rounder::anywhere(), machine, before);
  if (!before.empty() && !before_.is_settled()) return false;
  first_number_ = before.empty() ? 0 : before.front().number;
  path_.clear();
  ends_.clear();
  after_ = before_;
  for (const PlannedRequest& request : requests) {
    round_rest(request, machine, after_, path_);
    const std::size_t end_of_rest = path_.end();
    round_motion(request, machine, after_, path_);
    ends_.push_back({end_of_rest, path_.end()});
  }
  return true;
}

motion::Rounder RoundedRequests::rounder_before(const kinematics::Machine& machine,
                                                std::span<const PlannedRequest> requests, std::size_t request) const {
  return advanced(before_, machine, requests.first(request));
}

}  // namespace isocnc::timing
