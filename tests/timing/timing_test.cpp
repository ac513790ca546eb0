#include "interpreter/timing/timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/runner.h"
#include "tests/simulation/random_run.h"

namespace isocnc::timing {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

using simulation::kTiny;

/// A machine with a maximum of 100 mm/s and 1000 mm/s^2.
TimedMachine slow_machine() {
  TimedMachine machine{.motion = kinematics::three_axis_router()};
  for (kinematics::AxisLimits& axis : machine.motion.axes) {
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
  running::run(program, {}, [&](const running::Event& event) { timing.take(event); });
  timing.finish();
  timed.seconds = timing.time();
  return timed;
}

/// The duration in seconds of the part after the tool change.
double seconds_of(std::string_view program) {
  return time("M06 T101001\n" + std::string(program) + "M02\n").seconds - 5;
}

/// The duration of a motion from rest to rest over `length` mm at `speed` mm/s, with 1000 mm/s^2 at both ends.
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
  // 1/0.5 min = 120 s at nearly constant speed, plus acceleration and braking.
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
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nG990\nX200\n"), 2 * parts, kTiny);
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nIF V1 = 1 GOTO N5\nX200\nN5\n"), 2 * parts, kTiny);
}

/// docs/isorun.md: an M03, M04 or M05 takes 3 s if it changes the direction or speed of the spindle.
TEST(Timing, OfTheSpindleIsThatOfItsChanges) {
  const std::pair<std::string_view, int> programs[] = {
      {"M05\n", 0},                                 // No change: the spindle stands at the start.
      {"S1000 M03\nM05\nM05\n", 2},                 // No change by the second M05.
      {"S1000 M03\nM03\nS1000 M03\n", 1},           // No change: same direction and speed.
      {"S1000 M04\nM04\n", 1},                      // No change: the same for M04.
      {"M03\nM03\n", 1},                            // The same without any S.
      {"S1000 M03\nS2000 M03\n", 2},                // A new speed.
      {"S1000 M03\nM04\nM03\n", 3},                 // A new direction.
      {"S1000 M03\nM05\nM03\n", 3},                 // A start from rest after the M05.
      {"S1000\nS2000\n", 0},                        // No change by an S without an M03.
      {"S1000 M03\nS2000\nG01 X0 F100\nM03\n", 2},  // A new speed at the second M03.
      {"S1000 M03\nS2000\nS1000 M03\n", 1},         // No change: the last S is the present speed.
      {"S1000 M03\nM100\nM03\n", 1},                // The M100, whose 7 s are added below, stops no spindle.
  };
  for (const auto& [program, changes] : programs) {
    const double functions = program.find("M100") == std::string_view::npos ? 0 : 7;
    EXPECT_NEAR(seconds_of(program), 3 * changes + functions, kTiny) << program;
  }
  EXPECT_NEAR(seconds_of("S1000 M03\nM06 T101001\nM05\nM03\n"), 3 + 5 + 3, kTiny) << "a tool change stops it";
}

/// An instruction without effect still stops the axes if the control waits for it.
TEST(Timing, OfWhatChangesNothingIsThatOfTheStop) {
  const double parts = trapezoid(100, 50);
  for (const std::string_view idle : {"M05\n", "G04 P0\n", "G990\n"})
    EXPECT_NEAR(seconds_of("G01 X100 F3000\n" + std::string(idle) + "X200\n"), 2 * parts, kTiny) << idle;
  EXPECT_NEAR(seconds_of("G01 X100 F3000\nS500\nX200\n"), trapezoid(200, 50), kTiny) << "an S alone does not";
}

/// An event that does not stop the machine has the start time of the motion after it; a motion of zero length takes no
/// time.
TEST(Timing, EventsComeInOrderWithTheirTimes) {
  const Timed timed = time("M06 T101001\nG01 X100 F3000\nS500\nX100\nX200\nM02\n");
  std::vector<std::string> reported;
  std::vector<double> starts;
  for (const TimedEvent& event : timed.events) {
    reported.push_back(std::string(running::kind_of(event.event)) + " " + std::to_string(event.event.line + 1));
    starts.push_back(event.start - 5);
  }
  EXPECT_THAT(reported, ElementsAre("tool 1", "feed 2", "spindle 3", "feed 4", "feed 5", "end 6"));
  const double half = trapezoid(200, 50) / 2;
  EXPECT_THAT(starts, ElementsAre(DoubleNear(-5, kTiny), DoubleNear(0, kTiny), DoubleNear(half, kTiny),
                                  DoubleNear(half, kTiny), DoubleNear(half, kTiny), DoubleNear(2 * half, kTiny)));
}

TEST(Timing, AnErrorKeepsWhatWasDoneBefore) {
  const Timed timed = time("M06 T101001\nG01 X200 F3000\nG02 X1\n");
  ASSERT_EQ(timed.events.size(), 2u);
  EXPECT_NEAR(timed.events.back().duration, trapezoid(200, 50), kTiny);
}

TEST(Timing, WaitsForTheChannelAfterTheMotion) {
  const Timed timed = time("M06 T101001\nG01 X100 F3000 G09\nX200\nM02\n");
  EXPECT_EQ(timed.events[1].wait, 0.5);
  EXPECT_NEAR(timed.events[2].start - timed.events[1].start - timed.events[1].duration, 0.5, kTiny);
}

/// A program may give any number as a feed or a dwell.
TEST(Timing, IsFiniteWhateverTheProgramSays) {
  const std::string tiny = "." + std::string(320, '0') + "1";
  const std::string huge = "1" + std::string(305, '0');
  const Timed timed =
      time("M06 T101001\nG01 X100 F" + tiny + "\nG93\nX0 F" + tiny + "\nG04 P" + huge + "\nG04 P" + huge + "\nM02\n");
  EXPECT_EQ(timed.events.size(), 6u);
  EXPECT_TRUE(std::isfinite(timed.seconds));
}

/// This holds for any number of lines without motion after a motion.
TEST(Timing, HoldsNoMoreThanAControlLooksAhead) {
  const auto check = [](auto&& next) {
    std::size_t reported = 0;
    std::size_t maximum = 0;
    const TimedMachine machine = slow_machine();
    Timing timing(machine, {.event = [&](const TimedEvent&) { ++reported; }});
    running::MoveEvent motion;
    motion.to.tip.x() = 100;
    motion.length = 100;
    timing.take({.line = 0, .what = motion});
    constexpr std::size_t kEvents = 40'000;
    for (std::size_t i = 1; i <= kEvents; ++i) {
      timing.take(next(i));
      maximum = std::max(maximum, i + 1 - reported);
    }
    timing.finish();
    EXPECT_EQ(reported, kEvents + 1);
    EXPECT_LT(maximum, 33'000u);
    EXPECT_NEAR(timing.time(), trapezoid(100, 100), kTiny);
  };
  check([](std::size_t line) { return running::Event{line, running::SpindleSpeedEvent{1000}}; });
  check([](std::size_t line) { return running::Event{line, running::FrameEvent{}}; });
  running::MoveEvent nowhere;
  nowhere.from.tip.x() = nowhere.to.tip.x() = 100;
  check([&](std::size_t line) { return running::Event{line, nowhere}; });
}

/// The Z of the tip at the start and end of each motion, with home at Z500 and tools of 100 and 40 mm.
std::vector<std::pair<double, double>> heights_of(std::string_view program) {
  TimedMachine machine = slow_machine();
  machine.tool_lengths = {{{1, 1, 1}, 100}, {{1, 1, 2}, 40}};
  machine.home.tip.z() = 500;
  running::RunOptions options;
  options.setup.home = machine.home;
  std::vector<std::pair<double, double>> heights;
  Timing timing(machine, {.event = [&](const TimedEvent& timed) {
                  if (timed.move) heights.emplace_back(timed.move->from.tip.z(), timed.move->to.tip.z());
                }});
  EXPECT_EQ(running::run(program, options, [&](const running::Event& event) { timing.take(event); }).ending,
            running::Ending::ProgramEnd);
  timing.finish();
  return heights;
}

/// Home is a position of the spindle nose: the tip of a tool is lower by its length, until the first motion.
TEST(Timing, AToolChangeMovesNoAxis) {
  using Heights = std::vector<std::pair<double, double>>;
  EXPECT_EQ(heights_of("M06 T101001\nG00 X50\nY20\nZ450\nX0\nM02\n"),
            (Heights{{400, 400}, {400, 400}, {400, 450}, {450, 450}}));
  EXPECT_EQ(heights_of("M06 T101001\nG00 Z500\nM02\n"), (Heights{{400, 500}}));
  EXPECT_EQ(heights_of("M06 T101001\nG00 Z450\nM06 T101002\nG00 X9\nG91\nX1 Z-10\nG90\nZ450\nM02\n"),
            (Heights{{400, 450}, {510, 510}, {510, 500}, {500, 450}}));
  EXPECT_EQ(heights_of("M06 T101003\nG00 X50\nM02\n"), (Heights{{500, 500}})) << "of no known length";
  EXPECT_EQ(heights_of("M06 T101001\nG00 Z450\nM06 T000000\nG00 X9\nM02\n"), (Heights{{400, 450}, {550, 550}}));
}

TEST(Timing, OfAToolChangeTheFaceFrameDecidesWhichAxesStay) {
  // Seen from the face, machine Z is -X, and machine X is Z.
  const auto heights = heights_of("M06 T101001\nG29 B90\nG00 Z5\nY5\nX10\nM02\n");
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_NEAR(heights[1].second, 400, kTiny);
  EXPECT_NEAR(heights[2].first, 400, kTiny);
  EXPECT_NEAR(heights[2].second, -10, kTiny);
}

TEST(Timing, OfAToolChangeArcsGoRoundAtTheHeightOfTheTip) {
  const auto heights = heights_of("M06 T101001\nG02 X20 I10 J0 F1000\nG91\nX20 I10 J0 Z3\nM02\n");
  EXPECT_EQ(heights, (std::vector<std::pair<double, double>>{{400, 400}, {400, 403}}));
}

/// The duration in seconds of a circle of 200 mm radius at 100 mm/s, a speed that the default machine reaches.
double circle_seconds(std::string_view circle) {
  const Timed timed = time(fmt::format("M06 T101001\nG00 X200 Y0\nG04 P0\n{}\nM02\n", circle), {});
  double seconds = 0;
  for (const TimedEvent& event : timed.events)
    if (event.move && event.move->feed.kind != kinematics::FeedKind::Rapid) seconds += event.duration;
  return seconds;
}

TEST(Timing, OfACircleIsThatOfItsLengthHoweverItIsWritten) {
  const double wanted = 2 * std::numbers::pi * 200 / 100;
  EXPECT_NEAR(circle_seconds("G03 X200 Y0 I0 J0 F6000"), wanted, 0.02 * wanted);
  EXPECT_NEAR(circle_seconds("G49\nG03 X200 Y0 I0 J0 F6000"), wanted, 0.02 * wanted);
  for (const int points : {2'000, 20'000}) {
    std::string circle;
    for (int i = 1; i <= points; ++i) {
      const double angle = 2 * std::numbers::pi * i / points;
      circle += fmt::format("G01 X{:.6f} Y{:.6f} F6000\n", 200 * std::cos(angle), 200 * std::sin(angle));
    }
    EXPECT_NEAR(circle_seconds(circle), wanted, 0.02 * wanted) << points;
  }
}

}  // namespace
}  // namespace isocnc::timing
