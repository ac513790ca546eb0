#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "interpreter/timing/event_times.h"
#include "interpreter/timing/request_planner.h"
#include "interpreter/timing/request_reader.h"
#include "interpreter/timing/rounded_requests.h"

namespace isocnc::timing {

/// Does what Timing does, to the same bits, while other threads plan.
///
/// The caller's thread reads the events and calls the listeners. What it has read is cut into parts: where the machine
/// rests, if there is such a place in time, so that the next part need not wait for this one. Each thread plans the
/// first part that need not wait; where all must, it makes the path of one, which needs only the moves just before it.
/// The caller's thread does so, too, while many parts are ahead of the listeners.
class ParallelTiming : private RequestReader::Receiver {
 public:
  /// `jobs`: number of threads with the caller's. With 1 the listeners are called as soon as the times are known.
  ParallelTiming(const TimedMachine& machine, int jobs, TimingListeners listeners);
  ~ParallelTiming();
  ParallelTiming(const ParallelTiming&) = delete;
  ParallelTiming& operator=(const ParallelTiming&) = delete;

  void take(const running::Event& event) { reader_.take(event, *this); }

  /// Ends the run: the machine comes to rest, and all events are reported.
  void finish();

  /// Total time in seconds of all events reported.
  double time() const { return times_.time(); }
  /// Position of the tip at the start, in the callback of a tool change, and at the end; machine frame.
  geometry::Pose tip() const { return has_ended_ ? reader_.tip() : times_.tip(); }
  /// Positions of the joints at the start and at the end.
  kinematics::Coordinates joints() const { return reader_.joints(); }

 private:
  /// The machine is at rest: EventTimes::come_to_rest().
  struct Rest {
    std::uint64_t number = 0;
    std::size_t stretches_before = 0;  ///< Number of the part's stretches before it.
  };

  /// Plans parts, one after the other, of which the first begins at rest.
  struct Chain {
    Chain(const kinematics::Machine& machine, bool keeps_paths, std::uint64_t first)
        : planner(machine, keeps_paths, first) {}

    RequestPlanner planner;
    std::uint64_t next = 0;    ///< Number of the part that is to be planned next, among those of the chain.
    bool is_planning = false;  ///< A thread plans it.
  };

  /// Requests in a row, with copies of their moves.
  struct Requests {
    std::vector<PlannedRequest> requests;
    std::vector<kinematics::Move> moves;

    void reserve(std::size_t count);
    void add(const PlannedRequest& request);
    void clear();
  };

  /// What is done about the path of a part before its turn to be planned.
  enum class PathState : std::uint8_t {
    Unmade,
    Making,  ///< By a thread.
    Made,
    Unknown,  ///< It depends on more than is known.
  };

  struct PlannedPart {
    explicit PlannedPart(bool wants_stretches) : path(wants_stretches), keeps_stretches(wants_stretches) {}

    std::shared_ptr<Chain> chain;
    std::uint64_t number_in_chain = 0;
    bool is_last = false;  ///< Whether the run ends with it.
    Requests requests;
    Requests before;  ///< The last motions and rests before it in its chain.
    PathState path_state = PathState::Unmade;
    RoundedRequests path;  ///< If it is made.
    bool keeps_stretches;  ///< Else only their times: passing a stretch on takes longer than planning it.
    std::vector<motion::Stretch> stretches;  ///< If they are kept.
    std::vector<motion::StretchTime> times;  ///< If not.
    std::vector<Rest> rests;
    bool is_planned = false;

    bool wants_stretches() const { return keeps_stretches; }
    void take(const motion::Stretch& stretch) { stretches.push_back(stretch); }
    void take(const motion::StretchTime& time) { times.push_back(time); }
    void come_to_rest(std::uint64_t number) { rests.push_back({number, stretches.size() + times.size()}); }
  };

  Request& add() override { return times_.add(); }
  Request& last() override { return times_.last(); }
  void complete_last() override;

  std::unique_ptr<PlannedPart> new_part(std::uint64_t first);
  void plan_alone(const PlannedRequest& request);
  void begin_chain(std::uint64_t first);
  void hand_over(std::size_t left);
  void help();
  void remember_last(const std::vector<PlannedRequest>& requests);
  static bool is_plannable(const PlannedPart& part);
  PlannedPart* first_to_do();
  void work_on(std::unique_lock<std::mutex>& lock, PlannedPart& part);
  void plan(std::unique_lock<std::mutex>& lock, PlannedPart& part);
  void make_path(std::unique_lock<std::mutex>& lock, PlannedPart& part);
  void report_planned(std::size_t left);
  void report(PlannedPart& part);
  template <class Stretches>
  void report(const Stretches& stretches, const std::vector<Rest>& rests);

  const TimedMachine* machine_;
  int jobs_;
  bool makes_paths_ahead_;  ///< Where jerk is not limited.
  RequestReader reader_;
  EventTimes times_;
  bool has_started_ = false;  ///< Threads have been asked for; the system may have given none.
  bool has_ended_ = false;
  std::unique_ptr<PlannedPart> filling_;
  std::shared_ptr<Chain> chain_;  ///< Of the part that is being filled; null if that begins at rest.
  std::uint64_t parts_in_chain_ = 0;
  Requests last_in_chain_;                             ///< The last motions and rests of the chain so far.
  bool knows_last_in_chain_ = true;                    ///< Else the next part's path is made when it is planned.
  std::vector<std::unique_ptr<PlannedPart>> emptied_;  ///< They keep their memory.

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::unique_ptr<PlannedPart>>
      parts_;  ///< Handed over and not reported. Guarded by the mutex, as are the states in PlannedPart and Chain.
  bool ends_ = false;
  std::vector<std::thread> threads_;  ///< The last member, since they use the others.
};

}  // namespace isocnc::timing
