#include "interpreter/timing/request_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace isocnc::timing {
namespace {

/// All that a RequestPlanner says of times, with each number to its last bit.
struct PlanLog {
  explicit PlanLog(bool stretches) : asks_for_stretches(stretches) {}

  bool asks_for_stretches;
  std::string text;

  bool wants_stretches() const { return asks_for_stretches; }
  void take(const motion::Stretch& stretch) { take(static_cast<const motion::StretchTime&>(stretch)); }
  void take(const motion::StretchTime& time) {
    text += fmt::format("{} {} {:a}\n", time.tag, time.ends_move, time.duration);
  }
  void come_to_rest(std::uint64_t number) { text += fmt::format("rest {}\n", number); }
};

kinematics::Machine lazy_router() {
  kinematics::Machine machine = kinematics::three_axis_router();
  for (kinematics::AxisLimits& axis : machine.axes) axis.acceleration = 100;
  return machine;
}

/// Short motions in a row: each `bend`-th turns a corner, some stop exactly. With other requests between them.
class RequestList {
 public:
  RequestList(int motions, int others, int bend, int dwell, bool stops = true) {
    geometry::Pose at;
    for (int i = 1; i <= motions; ++i) {
      geometry::Pose to = at;
      (bend > 0 && i / bend % 2 == 1 ? to.tip.y() : to.tip.x()) += 0.001;
      moves_.push_back({.tag = requests_.size(),
                        .from = at,
                        .to = to,
                        .feed = {kinematics::FeedKind::Speed, 1000},
                        .exact_stop = stops && i % 1'501 == 0});
      add({.move = &moves_.back(), .wait = stops && i % 2'003 == 0 ? 0.25 : 0});
      for (int k = 0; k < others; ++k) add({});
      if (dwell > 0 && i % dwell == 0) add({.rests = true});
      at = to;
    }
  }

  std::string planned(const kinematics::Machine& machine, bool stretches, std::size_t& memory) const {
    RequestPlanner planner(machine, stretches);
    PlanLog log(stretches);
    for (const PlannedRequest& request : requests_) planner.take(request, log);
    memory = planner.memory();
    planner.finish(log);
    return log.text;
  }

  /// In parts of this size, of which nearly all have their path made ahead. Counts these.
  std::string planned_in_parts(const kinematics::Machine& machine, bool stretches, std::size_t size, int& made,
                               std::size_t& memory) const {
    RequestPlanner planner(machine, stretches);
    PlanLog log(stretches);
    const std::span<const PlannedRequest> all = requests_;
    for (std::size_t begin = 0; begin < all.size(); begin += size) {
      const std::span<const PlannedRequest> part = all.subspan(begin, std::min(size, all.size() - begin));
      RoundedRequests path(stretches);
      if (begin / size % 30 != 2 && path.make(machine, last_before(begin), part)) {
        planner.take(part, path, machine, log);
        ++made;
      } else {
        for (const PlannedRequest& request : part) planner.take(request, log);
      }
      memory = std::max(memory, planner.memory());
    }
    planner.finish(log);
    return log.text;
  }

 private:
  void add(PlannedRequest request) {
    request.number = requests_.size();
    requests_.push_back(request);
  }

  /// The last motions and rests.
  std::vector<PlannedRequest> last_before(std::size_t end) const {
    std::vector<PlannedRequest> found;
    for (std::size_t i = end; i-- > 0 && found.size() < 4;)
      if (requests_[i].move != nullptr || requests_[i].rests) found.insert(found.begin(), requests_[i]);
    return found;
  }

  std::deque<kinematics::Move> moves_;  // The requests point to them.
  std::vector<PlannedRequest> requests_;
};

void expect_same(const std::string& found, const std::string& expected, const std::string& where) {
  const auto [a, b] = std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
  ASSERT_TRUE(found == expected) << where << ":\n"
                                 << std::string(b, std::min(b + 200, found.end())) << "\nexpected\n"
                                 << std::string(a, std::min(a + 200, expected.end()));
}

/// In one piece and in parts, with stretches and with their times alone.
void expect_the_same_in_parts(const RequestList& requests, const kinematics::Machine& machine) {
  std::size_t with_stretches = 0;
  const std::string expected = requests.planned(machine, true, with_stretches);
  std::size_t with_times = 0;
  expect_same(requests.planned(machine, false, with_times), expected, "times alone");
  EXPECT_LT(with_times, with_stretches);
  for (const std::size_t size : {7U, 250U, 256U}) {
    const bool stretches = size == 250;
    int made = 0;
    std::size_t most = 0;
    const std::string found = requests.planned_in_parts(machine, stretches, size, made, most);
    EXPECT_GT(made, 20) << size;
    EXPECT_LE(most, 2 * with_stretches + 1'000'000) << size;
    expect_same(found, expected, fmt::format("parts of {}", size));
  }
}

TEST(RequestPlanner, TimesAPathMadeAheadToTheSameBits) {
  expect_the_same_in_parts({12'000, 1, 5, 0}, kinematics::three_axis_router());
  expect_the_same_in_parts({12'000, 0, 0, 70}, kinematics::three_axis_router());
}

/// The machine stops before the 32,769th request that waits, also within a path made ahead, and just before one.
TEST(RequestPlanner, StopsAtTheSamePlaceWhereTooMuchWaits) {
  for (const int others : {4, 6}) expect_the_same_in_parts({12'000, others, 0, 0, false}, lazy_router());
}

}  // namespace
}  // namespace isocnc::timing
