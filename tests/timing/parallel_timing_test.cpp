#include "interpreter/timing/parallel_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/runner.h"
#include "interpreter/timing/timing.h"
#include "tests/simulation/random_run.h"

namespace isocnc::timing {
namespace {

/// All that the listeners are told, with each number to its last bit.
class Log {
 public:
  /// Those who want times alone are served in another way.
  TimingListeners listeners(bool want_stretches) {
    if (!want_stretches) return {.event = [this](const TimedEvent& timed) { add(timed); }, .stretch = {}};
    return {.event = [this](const TimedEvent& timed) { add(timed); },
            .stretch =
                [this](const motion::Stretch& stretch, const TimedEvent& timed) {
                  text_ += fmt::format("{} {} {:a} {:a} {}", stretch.tag, stretch.ends_move, stretch.start,
                                       stretch.duration, timed.event.line);
                  for (int i = 0; i < stretch.phase_count; ++i) {
                    const motion::Phase& phase = stretch.phases[static_cast<std::size_t>(i)];
                    text_ += fmt::format(" {:a} {:a} {:a} {:a} {:a}", phase.duration, phase.from, phase.speed,
                                         phase.acceleration, phase.jerk);
                  }
                  for (const kinematics::Coordinates& c : stretch.path.c) text_ += fmt::format(" {:a}", c.sum());
                  text_ += '\n';
                }};
  }

  void add_tip(const geometry::Pose& tip) {
    text_ += fmt::format("tip {:a} {:a} {:a} {:a} {:a}\n", tip.tip.x(), tip.tip.y(), tip.tip.z(), tip.b, tip.c);
  }
  void add_end(double time, const kinematics::Coordinates& joints) {
    text_ += fmt::format("end {:a} {:a} {:a}\n", time, joints.sum(), joints.norm());
  }
  void add_run(const running::RunResult& result) { text_ += fmt::format("line {}\n", result.line); }
  const std::string& text() const { return text_; }

 private:
  void add(const TimedEvent& timed) {
    text_ += fmt::format("{} {} {:a} {:a} {:a} {} {}\n", timed.event.line, running::kind_of(timed.event), timed.start,
                         timed.duration, timed.wait, timed.begins_at_known_place, timed.ends_at_known_place);
  }

  std::string text_;
};

template <class Course>
void run_through(std::string_view program, const TimedMachine& machine, Course& course, Log& log) {
  log.add_tip(course.tip());
  running::RunOptions options;
  options.setup.home = machine.home;
  options.stop_at_errors = false;  // Random programs have some.
  const running::RunResult result =
      running::run(program, options, [&](const running::Event& event) { course.take(event); });
  course.finish();
  log.add_run(result);
  log.add_tip(course.tip());
  log.add_end(course.time(), course.joints());
}

std::string in_one_thread(std::string_view program, const TimedMachine& machine, bool wants_stretches) {
  Log log;
  Timing timing(machine, log.listeners(wants_stretches));
  run_through(program, machine, timing, log);
  return log.text();
}

std::string with_jobs(int jobs, std::string_view program, const TimedMachine& machine, bool wants_stretches) {
  Log log;
  ParallelTiming timing(machine, jobs, log.listeners(wants_stretches));
  run_through(program, machine, timing, log);
  return log.text();
}

/// `at_least`: lines of the log, so that the program says as much as its writer thinks.
void expect_the_same(std::string_view program, const TimedMachine& machine, bool wants_stretches,
                     std::size_t at_least) {
  const std::string expected = in_one_thread(program, machine, wants_stretches);
  ASSERT_GE(std::count(expected.begin(), expected.end(), '\n'), at_least) << expected.substr(0, 2000);
  for (const int jobs : {1, 2, 3, 8}) {
    const std::string found = with_jobs(jobs, program, machine, wants_stretches);
    const auto [a, b] = std::mismatch(expected.begin(), expected.end(), found.begin(), found.end());
    const auto around = [](const std::string& log, std::size_t at) {
      return log.substr(at - std::min<std::size_t>(at, 300), 600);
    };
    ASSERT_TRUE(found == expected) << jobs << " jobs differ from one:\n"
                                   << around(found, static_cast<std::size_t>(b - found.begin())) << "\nexpected\n"
                                   << around(expected, static_cast<std::size_t>(a - expected.begin())) << "\nprogram\n"
                                   << program.substr(0, 1000);
  }
}

void expect_the_same(std::string_view program, const TimedMachine& machine, std::size_t at_least) {
  expect_the_same(program, machine, true, at_least);
  if (!testing::Test::HasFatalFailure()) expect_the_same(program, machine, false, 0);
}

/// Many sections, so that parts are cut at rests and within motion.
TEST(ParallelTiming, GivesTheSameBitsForAnyNumberOfJobs) {
  for (const bool limits_jerk : {false, true}) {
    const TimedMachine machine = simulation::machine_of_tests(limits_jerk);
    for (std::uint64_t seed = 1; seed <= (limits_jerk ? 4U : 12U); ++seed) {
      support::Random random(seed);
      expect_the_same(simulation::RandomRun(random).text(100), machine, 2'000);
      if (HasFatalFailure()) return;
    }
  }
}

/// One motion without a rest is longer than a part, and than all parts that are ahead.
TEST(ParallelTiming, GivesTheSameBitsWithoutARest) {
  std::string program = "M06 T101001\nG01 X0 Y0 F6000\n";
  for (int i = 1; i <= 5'000; ++i)
    program += fmt::format("X{}.{} Y{}{}\n", i / 10, i % 10, i % 7, i % 900 == 0 ? " G09" : "");
  expect_the_same(program + "M02\n", TimedMachine(), 10'000);
}

/// More events wait for a motion than any control looks ahead: the machine stops before the 32,769th. Others before
/// them, and before a rest, do not count.
TEST(ParallelTiming, StopsAtTheSamePlaceWhereTooMuchWaits) {
  std::string program = "M06 T101001\n";
  for (int i = 0; i < 33'000; ++i) program += i % 2 == 0 ? "G04 P0.01\n" : "S1000\n";
  program += "G01 X10 F6000\nX20\nX30\nX40\nX50\n";
  for (int i = 0; i < 40'000; ++i) program += fmt::format("S{}\n", 1000 + i % 2);
  expect_the_same(program + "X30\nM02\n", TimedMachine(), 40'000);
}

/// More spans than the planner looks at lie before and after many rests: from which on it plans must not depend on what
/// was before them.
TEST(ParallelTiming, GivesTheSameBitsWhereTheMachineCannotStopInSight) {
  TimedMachine machine;
  for (kinematics::AxisLimits& axis : machine.motion.axes) axis.acceleration = 100;
  std::string program = "M06 T101001\nG00 X0 Y0 Z0\nG01 X0 F60000\n";
  int x = 0;
  for (int i = 0; i < 3'192; ++i) program += fmt::format("X{:.3f}\n", 0.001 * x++);
  for (int y = 1; y <= 5'100; ++y) program += fmt::format("Y{:.3f}\n", 0.001 * y);
  for (int i = 0; i < 140; ++i) program += "G04 P0.01\n";
  for (int i = 0; i < 30'000; ++i) program += fmt::format("X{:.3f}\n", 0.001 * x++);
  expect_the_same(program + "M02\n", machine, 60'000);
}

/// Such arcs become thousands of lines, which no part keeps.
TEST(ParallelTiming, GivesTheSameBitsForArcsOfManyLines) {
  TimedMachine machine;
  machine.motion = kinematics::head_router();
  std::string program = "M06 T101001\nG00 X2000 Y0 Z0\nG49\nG01 X2000 F100000\n";
  for (int i = 0; i < 12; ++i)
    program += fmt::format("G02 X2000 Y0 I0 J0\nG01 X{}\nG01 X2000\n{}", 2001 + i, i % 3 == 0 ? "G04 P1\n" : "");
  expect_the_same(program + "M02\n", machine, 5'000);
}

TEST(ParallelTiming, TellsTheTipAtAToolChange) {
  TimedMachine machine;
  machine.home.tip.z() = 400;
  machine.tool_lengths = {{execution::tool_code(101001), 80}, {execution::tool_code(101002), 120}};
  std::string program;
  for (int i = 0; i < 400; ++i) program += fmt::format("M06 T10100{}\nG00 X{}\n", 1 + i % 2, i);
  for (const int jobs : {1, 2}) {
    std::vector<double> heights;
    const ParallelTiming* course = nullptr;
    ParallelTiming timing(machine, jobs, {.event = [&](const TimedEvent& timed) {
                            if (std::holds_alternative<running::ToolEvent>(timed.event.what))
                              heights.push_back(course->tip().tip.z());
                          }});
    course = &timing;
    running::RunOptions options;
    options.setup.home = machine.home;
    running::run(program, options, [&](const running::Event& event) { timing.take(event); });
    timing.finish();
    ASSERT_EQ(heights.size(), 400U);
    for (std::size_t i = 0; i < heights.size(); ++i) EXPECT_EQ(heights[i], i % 2 == 0 ? 320 : 280) << i;
  }
}

TEST(ParallelTiming, AnswersForNothing) {
  expect_the_same("", TimedMachine(), 1);
  expect_the_same("M02\n", TimedMachine(), 1);
}

/// A run that is given up ends its threads, with parts that wait.
TEST(ParallelTiming, CanBeGivenUp) {
  const TimedMachine machine;
  std::size_t count = 0;
  ParallelTiming timing(machine, 3, {.event = [&](const TimedEvent&) { ++count; }});
  std::string program = "M06 T101001\nG01 X1 F6000\n";
  for (int i = 0; i < 2'000; ++i) program += fmt::format("G01 X{}\nG04 P0.1\n", i % 7);
  running::run(program, {}, [&](const running::Event& event) { timing.take(event); });
  EXPECT_GT(count, 1'000U);
  EXPECT_LT(count, 4'000U);
}

}  // namespace
}  // namespace isocnc::timing
