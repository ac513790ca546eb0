#include "interpreter/timing/parallel_timing.h"

#include <algorithm>
#include <utility>

#include "interpreter/kinematics/element.h"
#include "interpreter/threads/side_by_side.h"

namespace isocnc::timing {

/// Number of requests in a part that is cut where the machine rests, and the maximum if it does not. Handing a part
/// over takes some microseconds, as long as planning a few requests.
static constexpr std::size_t kFewRequests = 128;
static constexpr std::size_t kMostRequests = 256;
/// Maximum number of lines into which an arc of a part is split (kinematics::segment_count). A part keeps their
/// stretches.
static constexpr int kMostSegments = 64;
/// Number of motions and rests that tell where the path of those after them begins: it depends on two elements.
static constexpr std::size_t kRemembered = 4;
/// Parts that are not yet reported, for each thread: then the caller's thread plans, too. Some hundred KiB each.
static constexpr std::size_t kPartsAhead = 2;

void ParallelTiming::Requests::reserve(std::size_t count) {
  requests.reserve(count);
  moves.reserve(count);  // The requests point to them.
}

void ParallelTiming::Requests::add(const PlannedRequest& request) {
  requests.push_back(request);
  if (request.move != nullptr) requests.back().move = &moves.emplace_back(*request.move);
}

void ParallelTiming::Requests::clear() {
  requests.clear();
  moves.clear();
}

ParallelTiming::ParallelTiming(const TimedMachine& machine, int jobs, TimingListeners listeners)
    : machine_(&machine),
      jobs_(std::max(jobs, 1)),
      makes_paths_ahead_(!kinematics::limits_jerk(machine.motion)),
      reader_(machine),
      times_(std::move(listeners), machine.home, 0),
      chain_(std::make_shared<Chain>(machine.motion, times_.wants_stretches(), 0)) {
  last_in_chain_.reserve(kRemembered);
}

ParallelTiming::~ParallelTiming() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ParallelTiming::complete_last() {
  const PlannedRequest request = planned_request(times_.last());
  if (jobs_ == 1) return chain_->planner.take(request, times_);
  if (request.move != nullptr && kinematics::segment_count(machine_->motion, *request.move) > kMostSegments)
    return plan_alone(request);
  if (!filling_) filling_ = new_part(request.number);
  filling_->requests.add(request);
  if (filling_->requests.requests.size() < (request.rests ? kFewRequests : kMostRequests)) return;
  if (request.rests) chain_.reset();
  hand_over(kPartsAhead * static_cast<std::size_t>(jobs_));
}

/// Plans a request on this thread when all before it are reported, so that its stretches need not be kept.
void ParallelTiming::plan_alone(const PlannedRequest& request) {
  const kinematics::Move move = *request.move;  // What is reported moves what waits.
  if (filling_) hand_over(0);
  report_planned(0);
  if (!chain_) begin_chain(request.number);
  chain_->planner.take({request.number, &move, request.wait, request.rests}, times_);
  knows_last_in_chain_ = false;
}

void ParallelTiming::begin_chain(std::uint64_t first) {
  chain_ = std::make_shared<Chain>(machine_->motion, times_.wants_stretches(), first);
  parts_in_chain_ = 0;
  last_in_chain_.clear();
  knows_last_in_chain_ = true;
}

/// A part that continues the chain, or begins one at rest if there is none.
std::unique_ptr<ParallelTiming::PlannedPart> ParallelTiming::new_part(std::uint64_t first) {
  std::unique_ptr<PlannedPart> part;
  if (emptied_.empty()) {
    part = std::make_unique<PlannedPart>(times_.wants_stretches());
    part->requests.reserve(kMostRequests);
    part->before.reserve(kRemembered);
  } else {
    part = std::move(emptied_.back());
    emptied_.pop_back();
  }
  if (!chain_) begin_chain(first);
  part->chain = chain_;
  part->number_in_chain = parts_in_chain_++;
  for (const PlannedRequest& request : last_in_chain_.requests) part->before.add(request);
  part->path_state = knows_last_in_chain_ && makes_paths_ahead_ ? PathState::Unmade : PathState::Unknown;
  return part;
}

/// Whether the path depends on a request: on a motion, or a rest.
static bool shapes_path(const PlannedRequest& request) { return request.move != nullptr || request.rests; }

void ParallelTiming::remember_last(const std::vector<PlannedRequest>& requests) {
  std::size_t found = 0;
  std::size_t first = requests.size();
  for (std::size_t i = requests.size(); i-- > 0 && found < kRemembered;) {
    if (!shapes_path(requests[i])) continue;
    first = i;
    ++found;
  }
  if (found == 0) return;  // What is remembered still is the last of them.
  last_in_chain_.clear();
  knows_last_in_chain_ = true;
  for (std::size_t i = first; i < requests.size(); ++i)
    if (shapes_path(requests[i])) last_in_chain_.add(requests[i]);
}

/// Hands over the part that is filled, and reports those that are planned until so many are left.
void ParallelTiming::hand_over(std::size_t left) {
  if (!filling_->is_last && !std::exchange(has_started_, true))
    threads_ = threads::start_threads(jobs_ - 1, [this] { help(); });
  if (chain_) remember_last(filling_->requests.requests);
  {
    const std::lock_guard lock(mutex_);
    parts_.push_back(std::move(filling_));
  }
  changed_.notify_all();
  report_planned(left);
}

void ParallelTiming::finish() {
  reader_.finish(*this);
  if (jobs_ == 1) {
    chain_->planner.finish(times_);
  } else {
    if (!filling_) filling_ = new_part(0);
    filling_->is_last = true;
    hand_over(0);
  }
  has_ended_ = true;
}

/// Whether the chain of a part has come to it, and no thread works on it.
bool ParallelTiming::is_plannable(const PlannedPart& part) {
  return !part.is_planned && !part.chain->is_planning && part.chain->next == part.number_in_chain &&
         part.path_state != PathState::Making;
}

/// The first part that can be planned, or whose path can be made meanwhile; null if there is none.
ParallelTiming::PlannedPart* ParallelTiming::first_to_do() {
  PlannedPart* unmade = nullptr;
  for (const std::unique_ptr<PlannedPart>& part : parts_) {
    if (is_plannable(*part)) return part.get();
    const bool is_waiting = part->number_in_chain > part->chain->next;
    if (unmade == nullptr && is_waiting && part->path_state == PathState::Unmade) unmade = part.get();
  }
  return unmade;
}

void ParallelTiming::help() {
  std::unique_lock lock(mutex_);
  while (true) {
    PlannedPart* part = nullptr;
    changed_.wait(lock, [&] { return ends_ || (part = first_to_do()) != nullptr; });
    if (ends_) return;
    work_on(lock, *part);
  }
}

void ParallelTiming::work_on(std::unique_lock<std::mutex>& lock, PlannedPart& part) {
  if (is_plannable(part)) {
    plan(lock, part);
  } else {
    make_path(lock, part);
  }
  changed_.notify_all();
}

void ParallelTiming::plan(std::unique_lock<std::mutex>& lock, PlannedPart& part) {
  Chain& chain = *part.chain;
  chain.is_planning = true;
  const bool is_made = part.path_state == PathState::Made;
  lock.unlock();
  if (is_made) {
    chain.planner.take(part.requests.requests, part.path, machine_->motion, part);
  } else {
    for (const PlannedRequest& request : part.requests.requests) chain.planner.take(request, part);
  }
  if (part.is_last) chain.planner.finish(part);
  lock.lock();
  chain.is_planning = false;
  ++chain.next;
  part.is_planned = true;
}

void ParallelTiming::make_path(std::unique_lock<std::mutex>& lock, PlannedPart& part) {
  part.path_state = PathState::Making;
  lock.unlock();
  const bool is_made = part.path.make(machine_->motion, part.before.requests, part.requests.requests);
  lock.lock();
  part.path_state = is_made ? PathState::Made : PathState::Unknown;
}

void ParallelTiming::report_planned(std::size_t left) {
  std::unique_lock lock(mutex_);
  const auto is_first_planned = [&] { return !parts_.empty() && parts_.front()->is_planned; };
  while (is_first_planned() || parts_.size() > left) {
    if (is_first_planned()) {
      std::unique_ptr<PlannedPart> part = std::move(parts_.front());
      parts_.pop_front();
      lock.unlock();
      report(*part);
      emptied_.push_back(std::move(part));
      lock.lock();
    } else if (PlannedPart* const part = first_to_do()) {
      work_on(lock, *part);
    } else {
      changed_.wait(lock, [&] { return is_first_planned() || first_to_do() != nullptr; });
    }
  }
}

template <class Stretches>
void ParallelTiming::report(const Stretches& stretches, const std::vector<Rest>& rests) {
  auto rest = rests.begin();
  for (std::size_t i = 0; i <= stretches.size(); ++i) {
    for (; rest != rests.end() && rest->stretches_before == i; ++rest) times_.come_to_rest(rest->number);
    if (i < stretches.size()) times_.take(stretches[i]);
  }
}

/// Calls the listeners for a planned part, and empties it.
void ParallelTiming::report(PlannedPart& part) {
  if (part.keeps_stretches) {
    report(part.stretches, part.rests);
  } else {
    report(part.times, part.rests);
  }
  part.chain.reset();
  part.is_planned = false;
  part.requests.clear();
  part.before.clear();
  part.stretches.clear();
  part.times.clear();
  part.rests.clear();
}

}  // namespace isocnc::timing
