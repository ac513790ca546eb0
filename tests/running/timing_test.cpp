#include "interpreter/running/timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/running/runner.h"

namespace isocnc::running {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kTiny = 1e-9;

/// 100 mm/s at most, 1000 mm/s^2.
TimedMachine slow_machine() {
  TimedMachine machine{.motion = motion::three_axis_router()};
  for (motion::AxisLimits& axis : machine.motion.axes) {
    axis.speed = 100;
    axis.acceleration = 1000;
  }
  machine.durations = {.tool_change = 5, .spindle = 3, .channel = 0.5, .functions = {{100, 7}}};
  return machine;
}

struct Timed {
  std::vector<TimedEvent> events;
  double seconds = 0;
};

Timed time(std::string_view program, const TimedMachine& machine = slow_machine()) {
  Timed timed;
  Timing timing(machine, {.event = [&](const TimedEvent& event) { timed.events.push_back(event); }});
  run(program, {}, [&](const Event& event) { timing.take(event); });
  timing.finish();
  timed.seconds = timing.time();
  return timed;
}

/// Behind the tool change.
double seconds_of(std::string_view program) {
  return time("M06 T101001\n" + std::string(program) + "M02\n").seconds - 5;
}

/// From rest to rest over a length with this speed: 1000 mm/s^2 at both ends.
double trapezoid(double length, double speed) { return length / speed + speed / 1000; }

TEST(Timing, OfAMotionIsThatOfItsTrapezoid) {
  EXPECT_NEAR(seconds_of("G01 X200 F3000\n"), trapezoid(200, 50), kTiny);
  EXPECT_NEAR(seconds_of("G00 X200\n"), trapezoid(200, 100), kTiny);
  EXPECT_NEAR(seconds_of("G70\nG00 X2\n"), trapezoid(50.8, 100), kTiny);
}

TEST(Timing, OfMotionsInLineIsThatOfOneMotion) {
  EXPECT_NEAR(seconds_of("G01 X50 F3000\nX120\nX200\n"), trapezoid(200, 50), kTiny);
}

TEST(Timing, OfInverseTimeIsThatTime) {
  // 1/0.5 min = 120 s at nearly constant speed, and the way up and down.
  const double speed = 240.0 / 120;
  EXPECT_NEAR(seconds_of("G93\nG01 X240 F0.5\n"), 120 + speed / 1000, 1e-6);
}

TEST(Timing, ExactStopEmptiesTheChannelOfThreeAxesOnly) {
  const double parts = trapezoid(100, 50);
  EXPECT_NEAR(seconds_of("G01 X100 F3000 G09\nX200\n"), 2 * parts + 0.5, kTiny);
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nG09\nX200\n"), 2 * parts + 0.5, kTiny);
  EXPECT_NEAR(seconds_of("G49\nG01 X100 F3000 G09\nX200\n"), 2 * parts, kTiny);
}

TEST(Timing, MachineStandsForWhatIsNoMotion) {
  const double parts = trapezoid(100, 50);
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nG04 P2.5\nX200\n"), 2 * parts + 2.5, kTiny);
  EXPECT_NEAR(seconds_of("S1000 M03\n"), 3, kTiny);
  EXPECT_NEAR(seconds_of("M100\nM101\n"), 7, kTiny);
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nIF V1 = 1 GOTO N5\nX200\nN5\n"), 2 * parts, kTiny);
}

/// What does not stop the machine has the time of the motion behind it; a motion that goes nowhere takes none.
TEST(Timing, EventsComeInOrderWithTheirTimes) {
  const Timed timed = time("M06 T101001\nG01 X100 F3000\nS500\nX100\nX200\nM02\n");
  std::vector<std::string> told;
  std::vector<double> starts;
  for (const TimedEvent& event : timed.events) {
    told.push_back(std::string(kind_of(event.event)) + " " + std::to_string(event.event.line + 1));
    starts.push_back(event.start - 5);
  }
  EXPECT_THAT(told, ElementsAre("tool 1", "feed 2", "spindle 3", "feed 4", "feed 5", "end 6"));
  const double half = trapezoid(200, 50) / 2;
  EXPECT_THAT(starts, ElementsAre(DoubleNear(-5, kTiny), DoubleNear(0, kTiny), DoubleNear(half, kTiny),
                                  DoubleNear(half, kTiny), DoubleNear(half, kTiny), DoubleNear(2 * half, kTiny)));
}

TEST(Timing, AnErrorKeepsWhatWasDoneBefore) {
  const Timed timed = time("M06 T101001\nG01 X200 F3000\nG02 X1\n");
  ASSERT_EQ(timed.events.size(), 2u);
  EXPECT_NEAR(timed.events.back().duration, trapezoid(200, 50), kTiny);
}

}  // namespace
}  // namespace isocnc::running
