#include "interpreter/plot/toolpath.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/running/runner.h"

namespace isocnc::plot {
namespace {

using testing::ElementsAre;

/// A step that outlives the telling.
struct KeptStep {
  ToolpathStep step;
  std::vector<ToolpathPoint> points;
};

struct Recorded {
  std::vector<KeptStep> steps;
  std::vector<motion::Stretch> stretches;
  std::vector<ToolpathFrame> frames;
  std::size_t tool_count = 0;
};

Recorded record(std::string_view program, const timing::TimedMachine& machine) {
  Recorded recorded;
  Toolpath path(machine, {}, [&](const ToolpathStep& step) {
    recorded.steps.push_back({step, {step.points.begin(), step.points.end()}});
  });
  timing::Timing timing(machine, {.event = [&](const timing::TimedEvent& timed) { path.add(timed); },
                                  .stretch =
                                      [&](const motion::Stretch& stretch, const timing::TimedEvent&) {
                                        recorded.stretches.push_back(stretch);
                                        path.add(stretch);
                                      }});
  const running::RunResult result = running::run(program, {}, [&](const running::Event& event) { timing.take(event); });
  EXPECT_EQ(result.ending, running::Ending::ProgramEnd) << result.line_text;
  timing.finish();
  recorded.frames = path.frames();
  recorded.tool_count = path.tools().size();
  return recorded;
}

/// Arcs and lines of three and of five axes, rapids that turn B and C, corners of every kind, stops.
constexpr std::string_view kProgram =
    "M06 T101001\n"
    "G00 X200 Y100 Z50 B60 C170\n"
    "G00 X-50 B-30 C-100\n"
    "G01 X-40 F9000\n"
    "X-39 Y100.5\n"
    "X-38 Y101.5 Z49\n"
    "G02 X10 Y60 R80 F6000\n"
    "G49\n"
    "G01 X100 Y0 Z10 B20 C90\n"
    "X0 Y50 B0 G09\n"
    "G03 X0 Y50 I20 J50 C-90\n"
    "G01 B30\n"
    "G48\n"
    "M06 T101002\n"
    "G29 X10 B90\n"
    "G00 Z20\n"
    "G27\n"
    "G00 Z100 B0 C0\n"
    "M02\n";

std::vector<timing::TimedMachine> machines() {
  std::vector<timing::TimedMachine> all(3);
  all[0].motion = kinematics::three_axis_router();
  all[1].motion = kinematics::head_router();
  all[2].motion = kinematics::table_router();
  for (timing::TimedMachine& machine : all) machine.tool_lengths[{1, 1, 1}] = 120;
  return all;
}

/// Where who reads the points has the tool, by the rule of ToolpathPoint.
geometry::Pose pose_at(const Recorded& recorded, double time) {
  for (const KeptStep& kept : recorded.steps)
    for (std::size_t i = 1; i < kept.points.size(); ++i) {
      const ToolpathPoint& from = kept.points[i - 1];
      const ToolpathPoint& to = kept.points[i];
      if (time >= to.time) continue;  // At the moment of a jump the tool is past it.
      const double u = std::clamp((time - from.time) / (to.time - from.time), 0.0, 1.0);
      const double sum = from.speed + to.speed;
      const double part = sum > 0 ? (u * from.speed + u * u * (to.speed - from.speed) / 2) / (sum / 2) : u;
      return {from.pose.tip + part * (to.pose.tip - from.pose.tip), from.pose.b + part * (to.pose.b - from.pose.b),
              from.pose.c + part * (to.pose.c - from.pose.c)};
    }
  return recorded.steps.back().points.back().pose;
}

TEST(Toolpath, IsWhereTheMachineIs) {
  for (const timing::TimedMachine& machine : machines()) {
    const Recorded recorded = record(kProgram, machine);
    ASSERT_GT(recorded.stretches.size(), 20u);
    for (const motion::Stretch& stretch : recorded.stretches)
      for (int i = 0; i <= 8; ++i) {
        const double time = stretch.start + stretch.duration * i / 8;
        const geometry::Pose expected = stretch.at(machine.motion.kinematics, time).tip;
        const geometry::Pose found = pose_at(recorded, time);
        ASSERT_LT((found.tip - expected.tip).norm(), 0.06) << time;
        ASSERT_NEAR(found.b, expected.b, 0.06) << time;
        ASSERT_NEAR(found.c, expected.c, 0.06) << time;
      }
  }
}

TEST(Toolpath, HasNoMorePointsThanItTakes) {
  const Recorded recorded =
      record("M06 T101001\nG01 X10 F600\nX20\nX30\nG04 P1\nG03 X30 Y0 I30 J10\nM02\n", machines().front());
  std::vector<std::size_t> counts;
  for (const KeptStep& kept : recorded.steps) counts.push_back(kept.points.size() - 1);
  ASSERT_EQ(counts.size(), 6u);
  EXPECT_LE(counts[1], 2u);
  EXPECT_EQ(counts[2], 1u);
  EXPECT_LE(counts[3], 2u);
  // Chords that are off a circle of 10 mm by 0.005 mm turn by 3.6 degrees.
  EXPECT_GE(counts[5], 90u);
  EXPECT_LE(counts[5], 220u);
}

TEST(Toolpath, ReportsLinesKindsToolsAndFeeds) {
  const Recorded recorded =
      record("M06 T101001\nG01 X10 F600\nM06 T101002\nG00 Y5\nG00 Y5\nG02 X20 I15 J5 F900\nM02\n", machines().front());
  std::vector<std::string> shown;
  for (const KeptStep& kept : recorded.steps)
    shown.push_back(std::to_string(kept.step.line) + " " + "rfaw"[static_cast<std::size_t>(kept.step.kind)] + " " +
                    std::to_string(kept.step.tool) + " " + std::to_string(static_cast<int>(kept.step.feed)));
  EXPECT_THAT(shown, ElementsAre("0 w 1 0", "1 f 1 600", "2 w 2 0", "3 r 2 0", "4 r 2 0", "5 a 2 900"));
  EXPECT_EQ(recorded.steps[4].points.size(), 1u);  // It goes nowhere.
  EXPECT_EQ(recorded.tool_count, 3u);
}

TEST(Toolpath, RemembersEachFrameOnce) {
  const Recorded recorded =
      record("M06 T101001\nG92 X10 Y20 Z30\nG29 X1 B90\nG27\nG29 X1 B90\nG27\nG92 X0 Y0 Z0\nM02\n", machines().front());
  ASSERT_EQ(recorded.frames.size(), 3u);
  EXPECT_EQ(recorded.frames[1].line, 2u);
  EXPECT_TRUE(recorded.frames[1].frame.origin.isApprox(geometry::Vec3(11, 20, 30)));
  EXPECT_TRUE(recorded.frames[1].frame.axes.col(2).isApprox(geometry::Vec3::UnitX()));
}

}  // namespace
}  // namespace isocnc::plot
