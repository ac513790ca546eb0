#include "interpreter/simulation/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation_case.h"

namespace isocnc::simulation {
namespace {

constexpr std::string_view kTwoLines =
    "M06 T101001\n"
    "G1 X100 F6000\n"
    "V1=7\n"
    "G91 X100 F3000\n"
    "M02\n";

TEST(Simulation, BeginsAtHomeBeforeTheFirstBlock) {
  const Case two_lines{"; note\n" + std::string(kTwoLines)};
  const Simulation simulation = two_lines.start();
  EXPECT_EQ(simulation.time(), 0);
  EXPECT_EQ(simulation.blocks(), 0u);
  EXPECT_EQ(simulation.line(), 1u);
  EXPECT_FALSE(simulation.is_in_block());
  EXPECT_FALSE(simulation.has_ended());
  EXPECT_EQ(simulation.event(), nullptr);
  EXPECT_EQ(simulation.sample().tip.tip, geometry::Vec3(0, 0, 400));
  EXPECT_EQ(simulation.sample().joints[kinematics::kZ], 400);
}

/// A tool change moves no joint, so the tip of a longer tool is lower once it is mounted; the next motions start there.
TEST(Simulation, ShowsWhereTheToolEnds) {
  const Case changes{
      "M06 T101001\n"
      "G1 X50 F6000\n"
      "M06 T101002\n"
      "X80\n"
      "Z100\n"
      "M06 T000000\n"
      "M02\n"};
  Simulation simulation = changes.start();
  const auto expect = [&](double tip, double nose) {
    EXPECT_NEAR(simulation.sample().tip.tip.z(), tip, kTiny) << "line " << simulation.line();
    EXPECT_NEAR(simulation.sample().joints[kinematics::kZ], nose, kTiny) << "line " << simulation.line();
  };
  advance_to(simulation, 4);
  expect(400, 400);
  simulation.step_block();
  expect(320, 400);
  simulation.advance_along(20);
  expect(320, 400);
  simulation.step_block();
  simulation.advance_in_block(simulation.time() + 1);
  expect(320, 400);
  simulation.step_block();
  expect(280, 400);
  simulation.advance_along(10);
  expect(280, 400);
  EXPECT_NEAR(simulation.to_go().axes[kinematics::kZ], 0, kTiny) << "the motion leaves out Z";
  EXPECT_NEAR(simulation.to_go().path, 20, kTiny);
  simulation.step_block();
  simulation.advance_along(30);
  EXPECT_NEAR(simulation.to_go().axes[kinematics::kZ], 100 - simulation.sample().tip.tip.z(), kTiny);
  simulation.step_block();
  expect(100, 220);
  simulation.step_block();
  expect(220, 220);
}

TEST(Simulation, ShowsTheToolBesideTheContour) {
  const Case contour{
      "M06 T101001\n"
      "G1 X-20 Y20 Z0 F6000\n"
      "G41\n"
      "X0 Y0\n"
      "X40\n"
      "Y-40 G40\n"
      "M02\n"};
  Simulation simulation = contour.start();
  while (simulation.line() != 4) simulation.step_block();
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 0, 0.1);
  EXPECT_NEAR(simulation.sample().tip.tip.y(), 3, 0.1);
  simulation.advance_along(30);
  EXPECT_NEAR(simulation.sample().tip.tip.y(), 3, kTiny);
  EXPECT_NEAR(simulation.to_go().path, 10, 0.2);
  EXPECT_EQ(simulation.blocks(), 5u);
  simulation.step_block();
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 43, 0.1) << "round the corner";
  EXPECT_NEAR(simulation.sample().tip.tip.y(), 0, 0.1);
}

/// The position of the tip after each line of a program, if the operator takes over the machine before line `change`
/// (from 0) and does not move it.
std::vector<geometry::Vec3> places_when_taken_over(const Case& of, std::uint64_t change) {
  std::vector<geometry::Vec3> places;
  auto simulation = std::make_unique<Simulation>(of.start());
  while (!simulation->has_ended()) {
    if (simulation->line() == change)
      simulation = std::make_unique<Simulation>(*simulation, simulation->runner(), of.machine());
    simulation->step_block();
    places.push_back(simulation->sample().tip.tip);
  }
  return places;
}

/// The tool of 3 mm radius is at X40 Y3 after the G40, and moves straight to X60 Y0; the second contour runs at Y17.
TEST(Simulation, MovedByHandFollowsTheSamePath) {
  const Case contours{
      "M06 T101001\n"
      "G1 X-20 Y20 Z0 F6000\n"
      "G41 X0 Y0\n"
      "X40\n"
      "G40\n"
      "G0 Z9\n"
      "G18 G0 Z4\n"
      "G17\n"
      "G1 X60\n"
      "G42 X80 Y20\n"
      "X120\n"
      "X140 Y20 G40\n"
      "G1 X150 Y40\n"
      "M02\n"};
  constexpr double kRoundedCorner = 0.05;  // mm
  for (const std::uint64_t change : {1u, 2u, 5u, 6u, 7u, 8u, 9u, 12u}) {
    const std::vector<geometry::Vec3> places = places_when_taken_over(contours, change);
    ASSERT_EQ(places.size(), 14u) << change;
    for (const std::size_t line : {4u, 5u, 6u, 7u})
      EXPECT_NEAR((places[line].head<2>() - geometry::Vec2(40, 3)).norm(), 0, kRoundedCorner) << change << ' ' << line;
    EXPECT_NEAR((places[8] - geometry::Vec3(60, 0, 4)).norm(), 0, kRoundedCorner) << change;
    EXPECT_NEAR((places[10] - geometry::Vec3(120, 17, 4)).norm(), 0, kRoundedCorner) << change;
    EXPECT_NEAR((places[12] - geometry::Vec3(150, 40, 4)).norm(), 0, kRoundedCorner) << change;
  }
}

/// I.4.2: an S takes effect at the next M03 or M04, which takes time because the speed changes.
TEST(Simulation, TakenOverByHandKeepsAnSThatWaits) {
  const Case speeds{
      "M06 T101001\n"
      "S100 M03\n"
      "S200\n"
      "M03\n"
      "M02\n"};
  for (const std::uint64_t change : {2u, 3u}) {
    Simulation simulation = speeds.start();
    while (simulation.line() != change) simulation.step_block();
    Simulation taken_over(simulation, simulation.runner(), speeds.machine());
    for (Simulation* const each : {&simulation, &taken_over})
      while (!each->has_ended()) each->step_block();
    EXPECT_EQ(taken_over.time(), simulation.time()) << change;
  }
}

/// I.5: the control does not read the lines after an IF until the machine has arrived there.
TEST(Simulation, StopsBesideTheContourAtAnIf) {
  const Case fork{
      "M06 T101001\n"
      "G1 X-20 Y20 Z0 F6000\n"
      "G41 X0 Y0\n"
      "X40\n"
      "IF VGPL=1 GOTO N5\n"
      "Y-40\n"
      "N5 X80\n"
      "G40\n"
      "M02\n"};
  for (const double vgpl : {0, 1}) {
    Simulation simulation = fork.start();
    while (simulation.line() != 4) simulation.step_block();
    EXPECT_NEAR(simulation.sample().tip.tip.x(), 40, kTiny);
    EXPECT_NEAR(simulation.sample().tip.tip.y(), 3, kTiny);
    EXPECT_EQ(simulation.sample().speed, 0);
    simulation.set_vgpl(vgpl);
    while (simulation.line() != 6) simulation.step_block();
    simulation.step_block();
    EXPECT_NEAR(simulation.sample().tip.tip.x(), 80, kTiny);
    EXPECT_NEAR(simulation.sample().tip.tip.y(), vgpl == 1 ? 3 : -37, kTiny);
  }
}

TEST(Simulation, MovesWithoutStepsOfTheAccelerationWhereJerkIsLimited) {
  const Case line{"M06 T101001\nG1 X100 F6000\nM02\n", 0, true, true};
  Simulation simulation = line.start();
  simulation.step_block();
  const double start = simulation.time();
  advance_to(simulation, start + 0.005);
  const double jerk = simulation.sample().acceleration / 0.005;
  EXPECT_GT(jerk, 0);
  EXPECT_LE(jerk, *line.machine().motion.axes[kinematics::kX].jerk * (1 + kTiny));
  simulation.advance_along(30);
  EXPECT_NEAR(simulation.to_go().path, 100 - simulation.sample().tip.tip.x(), kTiny);
  simulation.step_block();
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 100, kTiny);
}

TEST(Simulation, StopsBetweenBlocks) {
  const Case two_lines{std::string(kTwoLines)};
  Simulation simulation = two_lines.start();
  simulation.step_block();
  EXPECT_EQ(simulation.time(), 5) << "the tool change";
  EXPECT_EQ(simulation.line(), 1u);
  simulation.step_block();
  EXPECT_EQ(simulation.line(), 2u);
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 100, 0.1);
  EXPECT_GT(simulation.sample().speed, 49) << "the machine goes on without a stop";
  const double time = simulation.time();
  simulation.step_block();
  EXPECT_EQ(simulation.time(), time) << "V1=7 takes no time";
  EXPECT_EQ(simulation.line(), 3u);
  simulation.step_block();
  simulation.step_block();
  EXPECT_TRUE(simulation.has_ended());
  EXPECT_EQ(simulation.run().ending, running::Ending::ProgramEnd);
  EXPECT_EQ(simulation.sample().speed, 0);
}

/// The present motion is shown, although the control has already read the whole program.
TEST(Simulation, ShowsTheMachinesPresent) {
  const Case two_lines{std::string(kTwoLines)};
  Simulation simulation = two_lines.start();
  simulation.step_block();
  simulation.advance_in_block(5.5);
  EXPECT_EQ(simulation.time(), 5.5);
  EXPECT_TRUE(simulation.is_in_block());
  EXPECT_EQ(simulation.line(), 1u);
  EXPECT_EQ(simulation.blocks(), 2u);
  EXPECT_EQ(simulation.run().registers[1], 0);
  EXPECT_FALSE(simulation.run().state.incremental());
  EXPECT_EQ(simulation.run().state.last_feed.number, 6000);
  ASSERT_NE(simulation.event(), nullptr);
  EXPECT_EQ(simulation.event()->line, 1u);
  EXPECT_NEAR(simulation.sample().speed, 100, kTiny);
}

TEST(Simulation, StopsAtAnyPointOfThePath) {
  const Case two_lines{std::string(kTwoLines)};
  Simulation simulation = two_lines.start();
  simulation.step_block();
  simulation.advance_along(30);
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 30, kTiny);
  EXPECT_NEAR(simulation.sample().joints[kinematics::kZ], simulation.sample().tip.tip.z() + 80, kTiny)
      << "the tool's length above the tip";
  EXPECT_NEAR(simulation.to_go().path, 70, kTiny);
  EXPECT_NEAR(simulation.to_go().axes[kinematics::kX], 70, kTiny);
  simulation.advance_along(30);
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 60, kTiny);
  simulation.advance_along(1000);
  EXPECT_FALSE(simulation.is_in_block()) << "no further than the block's end";
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 100, 0.1);
}

TEST(Simulation, StopsAtAnyPointOfAnArc) {
  const Case circle{"M06 T101001\nG2 X0 Y0 I10 J0 F600\nM02\n"};
  Simulation simulation = circle.start();
  simulation.step_block();
  const double whole = 20 * std::numbers::pi;
  simulation.advance_along(whole / 8);
  const double side = 10 * std::numbers::sqrt2 / 2;
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 10 - side, kTiny);
  EXPECT_NEAR(simulation.sample().tip.tip.y(), side, kTiny);
  EXPECT_NEAR(simulation.to_go().path, whole * 7 / 8, 1e-6);
  EXPECT_NEAR(simulation.to_go().axes[kinematics::kY], -side, kTiny);
  simulation.advance_along(whole / 2);
  EXPECT_NEAR(simulation.to_go().path, whole * 3 / 8, 1e-6);
}

TEST(Simulation, StopsInsideADwell) {
  const Case dwell{"M06 T101001\nG4 P2\nG1 X1 F100\nM02\n"};
  Simulation simulation = dwell.start();
  advance_to(simulation, 6.5);
  ASSERT_NE(simulation.event(), nullptr);
  EXPECT_EQ(running::kind_of(*simulation.event()), "dwell");
  EXPECT_EQ(simulation.to_go().path, 0);
  simulation.step_block();
  EXPECT_EQ(simulation.time(), 7);
  EXPECT_EQ(simulation.line(), 2u);
}

/// A G09 in G48 makes the machine wait until the look-ahead queue is full again: the wait is part of its block.
TEST(Simulation, WaitsForTheChannelInTheBlockOfTheExactStop) {
  const Case stop{"M06 T101001\nG1 X10 F6000 G09\nX20\nM02\n"};
  Simulation simulation = stop.start();
  simulation.step_block();
  simulation.step_block();
  const double end = simulation.time();
  Simulation waiting = stop.start();
  advance_to(waiting, end - 0.1);
  EXPECT_TRUE(waiting.is_in_block());
  EXPECT_EQ(waiting.line(), 1u);
  EXPECT_EQ(waiting.event(), nullptr);
  EXPECT_NEAR(waiting.sample().tip.tip.x(), 10, kTiny);
  EXPECT_EQ(waiting.sample().speed, 0);
}

/// I.5: the control evaluates the condition when the machine has arrived there.
TEST(Simulation, DecidesJumpsWhenTheMachineGetsThere) {
  const Case fork{"M06 T101001\nV1=1\nG1 X100 F6000\nIF V1=2 GOTO N5\nX50\nN5 Y10\nM02\n"};
  Simulation simulation = fork.start();
  simulation.step_block();
  simulation.step_block();
  simulation.advance_along(50);
  Simulation other = simulation;
  other.set_register(1, 2);
  simulation.step_block();
  EXPECT_EQ(simulation.line(), 3u);
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 100, kTiny) << "it stops there";
  simulation.step_block();
  EXPECT_EQ(simulation.line(), 4u);
  other.step_block();
  other.step_block();
  EXPECT_EQ(other.line(), 5u);
  other.step_block();
  EXPECT_NEAR(other.sample().tip.tip.x(), 100, kTiny) << "nothing has been read of the other way";
  EXPECT_NEAR(other.sample().tip.tip.y(), 10, kTiny);
}

TEST(Simulation, EndsAtAnErrorWhenTheMachineGetsThere) {
  const Case error{"M06 T101001\nG1 X100 F6000\nG02 X5\nM02\n"};
  Simulation simulation = error.start();
  simulation.step_block();
  simulation.advance_along(50);
  EXPECT_FALSE(simulation.has_ended());
  simulation.step_block();
  EXPECT_FALSE(simulation.has_ended());
  EXPECT_EQ(simulation.line(), 2u);
  simulation.step_block();
  EXPECT_TRUE(simulation.has_ended());
  EXPECT_EQ(simulation.run().ending, running::Ending::Error);
  EXPECT_EQ(simulation.line(), 2u);
  EXPECT_EQ(simulation.blocks(), 2u);
  EXPECT_NEAR(simulation.sample().tip.tip.x(), 100, kTiny);
}

}  // namespace
}  // namespace isocnc::simulation
