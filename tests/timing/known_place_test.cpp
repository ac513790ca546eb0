// After a tool whose length nobody knows it is not known where the machine is, until the program has led it somewhere.

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/runner.h"
#include "interpreter/timing/timing.h"
#include "tests/support/random.h"

namespace isocnc::timing {
namespace {

using kinematics::MachineKind;

/// A motion or a tool change of a run: where the machine is before and after it, and whether that is known.
struct Step {
  std::size_t line = 0;
  bool is_motion = false;
  bool has_known_length = false;  ///< The mounted tool.
  bool begins_known = true;
  bool ends_known = true;
  kinematics::Coordinates from = kinematics::Coordinates::Zero();  ///< Joints; those of a tool change are not noted.
  kinematics::Coordinates to = kinematics::Coordinates::Zero();
};

/// T101001 and T101002 have a length of 80 and 120 mm. T101003 and T101004 have lengths that nobody has told; in truth
/// they are `third` and `fourth`.
TimedMachine machine_of(MachineKind kind, double third = 0, double fourth = 0) {
  TimedMachine machine{.motion = unbounded_machine()};
  machine.motion.kinematics = {.kind = kind, .pivot = 150, .b_point = {0, 0, -50}, .c_point = {10, 0, -50}};
  machine.tool_lengths = {{execution::tool_code(101001), 80}, {execution::tool_code(101002), 120}};
  if (third > 0) machine.tool_lengths[execution::tool_code(101003)] = third;
  if (fourth > 0) machine.tool_lengths[execution::tool_code(101004)] = fourth;
  machine.home.tip.z() = 400;
  return machine;
}

std::vector<Step> steps_of(const std::string& program, const TimedMachine& machine) {
  std::vector<Step> steps;
  execution::ToolCode tool;
  Timing timing(machine, {.event = [&](const TimedEvent& timed) {
                  if (const auto* const change = std::get_if<running::ToolEvent>(&timed.event.what))
                    tool = change->tool;
                  if (!timed.move && !std::holds_alternative<running::ToolEvent>(timed.event.what)) return;
                  Step step{.line = timed.event.line + 1,
                            .is_motion = timed.move.has_value(),
                            .has_known_length = machine.length_of(tool).is_known,
                            .begins_known = timed.begins_at_known_place,
                            .ends_known = timed.ends_at_known_place};
                  if (timed.move) {
                    const auto joints_at = [&](const geometry::Pose& tip) {
                      return kinematics::inverse(machine.motion.kinematics, kinematics::coordinates(tip),
                                                 timed.move->tool_length);
                    };
                    step.from = joints_at(timed.move->from);
                    step.to = joints_at(timed.move->to);
                  }
                  steps.push_back(step);
                }});
  running::RunOptions options;
  options.setup.home = machine.home;
  running::run(program, options, [&](const running::Event& event) { timing.take(event); });
  timing.finish();
  return steps;
}

/// The lines of motions on which it is not known all the time where the machine is.
std::string unknown_lines(const std::string& program, MachineKind kind = MachineKind::ThreeAxis) {
  std::string lines;
  for (const Step& step : steps_of(program, machine_of(kind)))
    if (step.is_motion && !(step.begins_known && step.ends_known)) lines += fmt::format("{} ", step.line);
  return lines;
}

TEST(KnownPlace, IsLostByAToolWithoutLengthUntilZHasACoordinate) {
  EXPECT_EQ(unknown_lines("M06 T101001\nG00 X1 Y1 Z50\nM06 T000000\nG00 X5\nM06 T101002\nG00 Z60\nM02\n"), "");
  EXPECT_EQ(unknown_lines("M06 T101003\nG00 X1 Y1 Z50\nX2\nM06 T101001\nG00 X3\nY4\nZ60\nX5\nM02\n"), "2 3 5 6 7 ");
  EXPECT_EQ(unknown_lines("M06 T101003\nG00 Z50\nM06 T000000\nG00 X3\nM06 T101001\nG91\nG00 Z5\nG90\nZ60\nX1\nM02\n"),
            "2 4 7 9 ");
}

/// As long as it has not moved along its axis, the spindle is where it was.
TEST(KnownPlace, IsKeptByAToolWithoutLengthThatDoesNotMoveAlongItsAxis) {
  EXPECT_EQ(unknown_lines("M06 T101001\nG00 X1 Y1 Z50\nM06 T101003\nM06 T101002\nG00 X3\nM02\n"), "");
  EXPECT_EQ(unknown_lines("M06 T101001\nG00 X1 Y1 Z50\nM06 T101003\nG00 X7\nM06 T101002\nG00 X3\nM02\n"), "");
}

/// The axis of a tool that is tilted about Y is along X and Z.
TEST(KnownPlace, IsLostAlongTheAxisOfATiltedTool) {
  EXPECT_EQ(unknown_lines("M06 T101003\nG00 X1 Y1 Z50 B30\nM06 T101001\nG00 Z60\nY1\nX2\nY3\nM02\n", MachineKind::Head),
            "2 4 5 6 ");
}

/// Tool changes and motions. The tools without a length are mounted once each, unless `repeats`.
std::string random_program(support::Random& random, MachineKind kind, bool repeats) {
  std::string program;
  for (int i = 0; i < 30; ++i) {
    if (random.one_in(4)) {
      const std::string tool(random.any_of({"T101001", "T101002", "T101003", "T101004", "T000000"}));
      const bool has_no_length = tool == "T101003" || tool == "T101004";
      if (repeats || !has_no_length || program.find(tool) == std::string::npos) program += "M06 " + tool + "\n";
      continue;
    }
    program += random.one_in(5) ? "G91 G00" : "G90 G00";
    for (const char axis : random.any_of({"X", "Y", "Z", "XY", "XZ", "XYZ"}))
      program += fmt::format(" {}{}", axis, random.between(-50, 50));
    if (kind != MachineKind::ThreeAxis && random.one_in(3))
      program += fmt::format(" B{} C{}", random.between(-9, 9) * 10, random.between(-9, 9) * 10);
    program += "\n";
  }
  return program + "M02\n";
}

bool differ(const kinematics::Coordinates& a, const kinematics::Coordinates& b) {
  return (a - b).cwiseAbs().maxCoeff() > 1e-6;
}

/// Whatever the lengths are in truth, the machine is where the run has it as long as that is known. Where it is not
/// known, and the tool that is mounted has a length, it depends on them; not always, if a tool is mounted twice.
TEST(KnownPlaceProperty, IsTheSameForAllLengths) {
  int known = 0;
  int unknown = 0;
  for (const std::uint64_t seed : support::seeds(2000)) {
    support::Random random(seed);
    const auto kind = static_cast<MachineKind>(random.between(0, 2));
    const bool repeats = random.one_in(2);
    const std::string program = random_program(random, kind, repeats);
    const std::vector<Step> told = steps_of(program, machine_of(kind));
    const std::vector<Step> one = steps_of(program, machine_of(kind, 40, 95.5));
    const std::vector<Step> other = steps_of(program, machine_of(kind, 133, 61.25));
    ASSERT_EQ(told.size(), one.size());
    ASSERT_EQ(told.size(), other.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
      if (!told[i].is_motion) continue;
      SCOPED_TRACE(fmt::format("seed {}, line {} of\n{}", seed, told[i].line, program));
      const auto look_at = [&](bool is_known, kinematics::Coordinates Step::*joints) {
        if (is_known) {
          ++known;
          ASSERT_FALSE(differ(one[i].*joints, other[i].*joints));
          ASSERT_FALSE(told[i].has_known_length && differ(told[i].*joints, one[i].*joints));
        } else if (told[i].has_known_length && !repeats) {
          ++unknown;
          ASSERT_TRUE(differ(one[i].*joints, other[i].*joints));
        }
      };
      look_at(told[i].begins_known, &Step::from);
      look_at(told[i].ends_known, &Step::to);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(known, 1000);
  EXPECT_GT(unknown, 50);
}

}  // namespace
}  // namespace isocnc::timing
