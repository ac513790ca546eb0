#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "interpreter/stock/stock_file.h"
#include "interpreter/verification/verification_report.h"
#include "interpreter/verification/verifier_queue.h"
#include "tests/support/random.h"
#include "tests/support/threads.h"
#include "tests/verification/scenes.h"

namespace isocnc::verification {
namespace {

using dialect::Language;
using kinematics::MachineKind;
using std::numbers::pi;

/// A block of 100 x 100 x 40 mm, its upper face at Z40, and the tool T101001: a
/// flat cutter of radius 10 and length 60 in a holder of diameter 50.
struct Bench : Shop {
  explicit Bench(MachineKind kind = MachineKind::ThreeAxis) : Shop(kind) {
    scene.nose.reset();
    box("", {300, 100, 0}, {400, 200, 40}, BodyRole::Stock);
    scene.resolution = 0.5;
  }

  /// The tool with a shank above its cutter, and above that its holder.
  void set_tool(double radius, double cutter, const solids::StackRow& shank) {
    ToolBodies& tool = scene.tools[kTool];
    tool.cutter = body(solids::flat_body(radius, cutter));
    tool.shank = body(solids::stacked_body({&shank, 1}, cutter));
    set_holder(cutter + shank.height);
  }
  /// The holder, from a height above the tip to the spindle.
  void set_holder(double from) {
    const solids::StackRow holder{.height = 100 - from, .lower_diameter = 50, .upper_diameter = 50};
    scene.tools[kTool].holder = body(solids::stacked_body({&holder, 1}, from));
  }

  VerifiedRun cut(const std::string& moves, WorkTogether together = {}) const {
    return run("M06 T101001\nS12000 M03\n" + moves + "M02\n", std::move(together));
  }
};

/// What a run shows of a code.
std::vector<simulation::RunFinding> findings_with(const VerifiedRun& run, std::string_view code) {
  std::vector<simulation::RunFinding> found;
  for (const simulation::RunFinding& each : run.outcome.findings)
    if (dialect::definition(each.finding.id).code == code) found.push_back(each);
  return found;
}

/// `E150 5 40.00 @ 350 150 30`: code, line from 1, depth or distance, place in
/// the frame in force.
std::vector<std::string> told(const VerifiedRun& run) {
  std::vector<std::string> all;
  for (const Contact& each : run.contacts) {
    if (each.is_hint()) continue;
    all.push_back(
        fmt::format("{} {} {:.1f}", dialect::definition(each.id).code, each.line + 1, std::abs(each.distance)));
    if (each.enough) all.back() += fmt::format(" Z{:.1f}", *each.enough);
  }
  return all;
}

using Lines = std::vector<std::string>;

double removed(const VerifiedRun& run) { return run.material->blank_volume - run.material->stock.volume(); }

TEST(Material, SlotsHaveTheVolumeOfTheirClosedForm) {
  // A stadium of radius 10 whose ends are 40 mm apart, 5 mm deep, at eight
  // angles.
  for (int i = 0; i < 8; ++i) {
    const double angle = i * pi / 8 + 0.1;
    const double x = 20 * std::cos(angle);
    const double y = 20 * std::sin(angle);
    const VerifiedRun run = Bench().cut(fmt::format(
        "G00 X{:.4f} Y{:.4f} Z50\nG01 Z35 F1000\nX{:.4f} Y{:.4f}\nG00 Z50\n", 350 - x, 150 - y, 350 + x, 150 + y));
    EXPECT_EQ(told(run), Lines());
    const double exact = (pi * 100 + 2 * 10 * 40) * 5;
    EXPECT_NEAR(removed(run), exact, 0.003 * exact);
    ASSERT_EQ(run.material->by_tool.size(), 1u);
    EXPECT_NEAR(run.material->by_tool[0].removed.depth, 5, 0.001);
    EXPECT_NEAR(run.material->by_tool[0].removed.width, 20, 0.3);
  }
}

TEST(Material, RapidsThroughIt) {
  // Across, 35 mm below its face.
  EXPECT_EQ(told(Bench().cut("G00 X250 Y150 Z50\nZ5\nX500\nZ50\n")), Lines{"E150 5 35.0 Z40.0"});
  // Down into it.
  EXPECT_EQ(told(Bench().cut("G00 X350 Y150 Z50\nZ30\nZ50\n")), Lines{"E150 4 10.0 Z40.0"});
  // On it, beside it and above it.
  EXPECT_EQ(told(Bench().cut("G00 X250 Y150 Z50\nZ40\nX500\nZ50\n")), Lines());
  EXPECT_EQ(told(Bench().cut("G00 X250 Y89.9 Z50\nZ5\nX500\nZ50\n")), Lines());
}

/// What a rapid goes through is removed with the tool that goes through it, and as wide as that is.
TEST(Material, WhatARapidLeavesIsRemovedByItsOwnTool) {
  Bench bench;
  constexpr execution::ToolCode kThin{1, 2, 1};
  bench.scene.tools[kThin] = bench.scene.tools[Shop::kTool];
  bench.scene.tools[kThin].cutter = Shop::body(solids::flat_body(2, 60));
  bench.machine.tool_lengths[kThin] = 100;
  const std::string through = "G00 X250 Y150 Z50\nZ5\nX450\n";
  const double exact = 20 * 100 * 35;
  const std::string with_next = "\nG00 X250 Z60\nG01 X260 F1000\n";
  for (const std::string& end : {std::string(), std::string("G01 Z60 F1000\n"), std::string("G00 X460\n"),
                                 "M06 T102001" + with_next, "M06 T101003" + with_next}) {
    const VerifiedRun run = bench.cut(through + end);
    EXPECT_NEAR(removed(run), exact, 0.001 * exact) << end;
    ASSERT_EQ(run.material->by_tool.size(), 1u) << end;
    EXPECT_NEAR(run.material->by_tool[0].removed.volume, exact, 0.001 * exact) << end;
  }
}

/// After a tool whose length is not known it is not known where the next one
/// is, until Z has a coordinate.
TEST(Material, IsNotMetWhereItIsNotKnownWhereTheToolIs) {
  const VerifiedRun run = Bench().run(
      "M06 T101002\nG00 X250 Y150 Z20\nM06 T101001\nS12000 "
      "M03\nG00 X500\nX350\nZ50\n"
      "G01 Z30 F1000\nG00 Z50\nM02\n");
  EXPECT_EQ(told(run), Lines());
  const double exact = pi * 100 * 10;
  EXPECT_NEAR(removed(run), exact, 0.005 * exact);
}

/// X is so slow that Z has arrived before the cutter comes to the block.
TEST(Material, RapidsGoWhereTheirJointsLeadThem) {
  Bench bench;
  bench.machine.motion.axes[kinematics::kX].speed = 100;
  const std::string up = "G00 X250 Y150 Z5\nX500 Z50\n";
  const std::string down = "G00 X250 Y150 Z50\nX500 Z5\n";
  EXPECT_EQ(told(bench.cut(up)).size(), 1u);
  EXPECT_NE(told(bench.cut(down)), Lines{"E150 4 35.0 Z40.0"});
  bench.machine.motion.rapid_motion = kinematics::RapidMotion::Independent;
  EXPECT_EQ(told(bench.cut(up)), Lines());
  EXPECT_EQ(told(bench.cut(down)), Lines{"E150 4 35.0 Z40.0"});
}

/// However many phases a rapid has: its depth is that below the material before
/// all of it.
TEST(Material, RapidsInPhasesAreAsDeepAsTheyGo) {
  Bench bench;
  for (const auto motion : {kinematics::RapidMotion::Interpolated, kinematics::RapidMotion::Independent})
    for (const std::optional<double> jerk : {std::optional<double>(), std::optional<double>(20'000)}) {
      bench.machine.motion.rapid_motion = motion;
      for (kinematics::AxisLimits& axis : bench.machine.motion.axes)
        axis.speed = 100, axis.acceleration = 1000, axis.jerk = jerk;
      EXPECT_EQ(told(bench.cut("G00 X350 Y150 Z90\nZ30\nZ90\n")), Lines{"E150 4 10.0 Z40.0"});
      EXPECT_EQ(told(bench.cut("G00 X250 Y150 Z90\nX250 Z5\nX350\nZ90\n")), Lines{"E150 5 35.0 Z40.0"});
      EXPECT_EQ(told(bench.cut("G00 X285 Y150 Z90\nX315 Z30\nZ90\n")), Lines{"E150 4 10.0 Z40.0"});
    }
}

TEST(Material, RapidsAndStoppedSpindlesAreFoundOnShortMotions) {
  // Each motion is shorter than what the cutter counts as thinner.
  const auto steps = [](const std::string& start) {
    std::string moves = start;
    for (double x = 286.05; x < 320; x += 0.05) moves += fmt::format("X{:.2f}\n", x);
    return moves;
  };
  const VerifiedRun rapids = Bench().cut(steps("G00 X286 Y150 Z50\nZ5\n") + "Z50\n");
  ASSERT_EQ(rapids.contacts.size(), 1u);
  EXPECT_NEAR(rapids.contacts[0].distance, -35, 0.001);
  EXPECT_NEAR(rapids.contacts[0].enough.value(), 40, 0.1);
  // The same as in one motion, to within a dexel.
  const VerifiedRun one = Bench().cut("G00 X286 Y150 Z50\nZ5\nX320\nZ50\n");
  EXPECT_NEAR(removed(rapids), removed(one), 0.02 * removed(one));
  // Down in steps, too: each goes as deep as it is long, and what would have
  // been enough is above all of them.
  std::string down = "G00 X350 Y150 Z40\n";
  for (double z = 39.95; z > 35; z -= 0.05) down += fmt::format("Z{:.2f}\n", z);
  const VerifiedRun plunge = Bench().cut(down + "Z50\n");
  ASSERT_EQ(plunge.contacts.size(), 1u);
  EXPECT_NEAR(plunge.contacts[0].enough.value(), 40, 0.11);
  const VerifiedRun standing =
      Bench().run("M06 T101001\n" + steps("G00 X286 Y150 Z50\nZ35\nG01 X286.01 F1000\n") + "G00 Z50\nM02\n");
  ASSERT_EQ(standing.contacts.size(), 1u);
  EXPECT_EQ(dialect::definition(standing.contacts[0].id).code, "E158");
}

/// The Z that is told, typed into the line of the finding, is enough: else the machine would crash there, with a
/// finding that says it would not. Of motions that go down, up, level and with a turning axis, alone and together.
TEST(Material, TheZThatIsToldIsEnough) {
  struct Way {
    std::string to;      // Before Z.
    double height = 0;   // The Z of its line.
    std::string before;  // The lines before it.
    bool is_level = false;
  };
  const std::string over = "G00 X250 Y150 Z90\n";
  const Way ways[] = {
      {"G00 X350", 30, over},                                            // Down into it.
      {"G00 X500", 5, over},                                             // Through it.
      {"G00 X390", 35, "G00 X250 Y150 Z90\nG00 X280 Z45\n"},             // A little into it.
      {"G00 X500 B30", 44, "G00 X250 Y150 Z90 B0 C0\nG00 Z44\n", true},  // The tip dips while B turns.
      {"G00 X500 B60", 45, "G00 X250 Y150 Z90 B0 C0\nG00 Z45\n", true},
      {"G00 X500", 30, "G00 X200 Y150 Z90 B30 C0\nG00 Z30\n",
       true},  // The edge of a tilted tool is lower than its tip.
  };
  for (const auto motion : {kinematics::RapidMotion::Interpolated, kinematics::RapidMotion::Independent})
    for (const Way& way : ways) {
      Bench bench(MachineKind::Head);
      bench.scene.tools[Shop::kTool].holder.reset();
      bench.machine.motion.rapid_motion = motion;
      for (kinematics::AxisLimits& axis : bench.machine.motion.axes) axis.acceleration = 2000, axis.speed = 400;
      const auto with = [&](double z) {
        const std::string before =
            way.is_level ? way.before.substr(0, way.before.rfind('Z')) + fmt::format("Z{:.2f}\n", z) : way.before;
        return bench.cut(before + way.to + fmt::format(" Z{:.2f}\nG00 Z200\n", z));
      };
      const VerifiedRun run = with(way.height);
      ASSERT_FALSE(run.contacts.empty()) << way.to;
      ASSERT_TRUE(run.contacts[0].enough.has_value()) << way.to;
      const double enough = *run.contacts[0].enough;
      EXPECT_GT(enough, way.height) << way.to;
      EXPECT_EQ(told(with(enough)), Lines()) << way.to << " at " << enough;
      // The axes alone are higher on their way than what is looked at.
      if (motion == kinematics::RapidMotion::Independent) continue;
      EXPECT_FALSE(with(enough - 0.5).contacts.empty()) << way.to << " at " << enough;
    }
}

/// A flat holder goes down in three motions and out in one, on which it meets the most.
TEST(Material, TheWayOutSaysNothingOfTheZ) {
  Bench bench;
  const solids::StackRow flange{.height = 8, .lower_diameter = 50, .upper_diameter = 50};
  bench.scene.tools[Shop::kTool].holder = Shop::body(solids::stacked_body({&flange, 1}, 60));
  const VerifiedRun run = bench.cut("G00 X350 Y150 Z90\nG01 Z-25 F1000\nZ-35\nZ-45\nG00 Z90\n");
  ASSERT_FALSE(run.contacts.empty());
  // The holder is 60 mm above the tip, and the face at Z40.
  for (const Contact& each : run.contacts) EXPECT_NEAR(each.enough.value_or(-20), -20, 0.2) << each.line;
}

TEST(Material, NoZIsToldWhereTheStartIsTooLow) {
  // Up through the edge of the block, from beside it.
  const VerifiedRun run = Bench().cut("G00 X250 Y150 Z90\nZ30\nX500 Z60\nG00 Z90\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_FALSE(run.contacts[0].enough.has_value());
  // Down from beside it, where the edge is at Z40: an end so high that the way there leads over it helps nobody.
  const VerifiedRun down = Bench().cut("G00 X250 Y150 Z90\nZ36\nX500 Z20\nG00 Z90\n");
  ASSERT_EQ(down.contacts.size(), 1u);
  EXPECT_FALSE(down.contacts[0].enough.has_value());
}

TEST(Material, RapidsThroughWhatIsCutMeetNothing) {
  // Back through a slot, an arc, a ramp and a rounded corner, out of a hole.
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z30 F1000\nX380\nG00 X320\nZ50\n")), Lines());
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z30 F1000\nG02 X380 Y150 "
                             "I350 J150\nG00 Z50\n")),
            Lines());
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z40 F1000\nX380 Z25\nG00 X320 Z40\nZ50\n")), Lines());
  EXPECT_EQ(told(Bench().cut("G48\nG00 X320 Y120 Z50\nG01 Z30 "
                             "F9000\nX380\nY180\nX320\nG00 Z50\n")),
            Lines());
  EXPECT_EQ(told(Bench().cut("G00 X350 Y150 Z50\nG01 Z10 F1000\nG00 Z50\n")), Lines());
}

TEST(Material, OneFindingForOneContact) {
  const VerifiedRun run = Bench().cut("G00 X250 Y150 Z50\nZ5\nX320\nX380\nX500\nZ50\n");
  ASSERT_EQ(told(run), Lines{"E150 5 35.0 Z40.0"});
  EXPECT_EQ(run.contacts[0].end_line + 1, 7u);
  ASSERT_EQ(run.outcome.findings.size(), 1u);
  EXPECT_EQ(run.outcome.findings[0].last_line, 6u);
}

TEST(Material, TheFirstTouchIsToldAtItsTime) {
  // At 60 m/min, the cutter's rim reaches the block after 40 of 250 mm.
  const VerifiedRun run = Bench().cut("G00 X250 Y150 Z50\nZ5\nG04 P1\nX500\nZ50\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  Bench without;
  without.scene.setup.clear();
  without.box("wall", {300, 100, 0}, {400, 200, 40});
  const VerifiedRun hard = without.cut("G00 X250 Y150 Z50\nZ5\nG04 P1\nX500\nZ50\n");
  ASSERT_GE(hard.contacts.size(), 1u);
  EXPECT_NEAR(run.contacts[0].time, hard.contacts[0].time, 0.005);
}

TEST(Material, TheFrameInForceGivesPlaceAndHeight) {
  const VerifiedRun run = Bench().cut("G92 X300 Y100 Z40\nG00 X-50 Y50 Z10\nZ-35\nX200\nZ10\n");
  // The setup's frame is that of the first G92.
  EXPECT_EQ(told(run), Lines());
  Bench bench;
  bench.scene.is_in_workpiece_frame = false;
  const VerifiedRun in_machine = bench.cut("G92 X300 Y100 Z40\nG00 X-50 Y50 Z10\nZ-35\nX200\nZ10\n");
  EXPECT_EQ(told(in_machine), Lines{"E150 6 35.0 Z0.0"});
}

TEST(Material, HolderInIt) {
  // The holder's face is 60 mm above the tip.
  EXPECT_EQ(told(Bench().cut("G00 X350 Y150 Z50\nG01 Z-25 F1000\nG00 Z50\n")), Lines{"E151 4 5.0 Z-20.0"});
  // 1 mm above it: nearer than the clearance of 2 mm.
  EXPECT_EQ(told(Bench().cut("G00 X350 Y150 Z50\nG01 Z-19 F1000\nG00 Z50\n")), Lines{"W154 4 1.0"});
  EXPECT_EQ(told(Bench().cut("G00 X350 Y150 Z50\nG01 Z-17.9 F1000\nG00 Z50\n")), Lines());
  // Beside the block, the holder reaches over it.
  EXPECT_EQ(told(Bench().cut("G00 X280 Y150 Z50\nG01 Z-25 F1000\nG00 Z50\n")), Lines{"E151 4 5.0 Z-20.0"});
  EXPECT_EQ(told(Bench().cut("G00 X272 Y150 Z50\nG01 Z-25 F1000\nG00 Z50\n")), Lines());
}

/// Whoever accepts that the holder rubs has not accepted that it is driven in.
TEST(Material, AHolderThatGoesMuchDeeperIsToldThereAsWell) {
  Bench bench;
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(10, 20));
  bench.set_holder(20);
  const VerifiedRun run = bench.cut(
      "G00 X350 Y150 Z50\nG01 Z19.8 F1000\nX352 "
      "Z19.7\nX354 Z10\nX356\nG00 Z50\n");
  std::vector<std::size_t> lines;
  for (const simulation::RunFinding& each : findings_with(run, "E151")) lines.push_back(each.line + 1);
  EXPECT_EQ(lines, (std::vector<std::size_t>{4, 6}));
}

/// From the first touch of any of them to the last; the deepest is named.
TEST(Material, ShankAndHolderAreOneContact) {
  Bench bench;
  bench.set_tool(10, 10, {.height = 15, .lower_diameter = 12, .upper_diameter = 12});
  // Down, the holder goes 3 mm deep; across, the shank meets the 15 mm between
  // cutter and holder.
  const VerifiedRun run = bench.cut("G00 X350 Y150 Z50\nG01 Z12 F1000\nX370\nG00 Z50\n");
  const auto of_body = std::find_if(run.contacts.begin(), run.contacts.end(),
                                    [](const Contact& each) { return dialect::definition(each.id).code == "E151"; });
  ASSERT_NE(of_body, run.contacts.end());
  EXPECT_EQ(of_body->line, 3u);
  EXPECT_GE(of_body->worst_line, 4u);
  EXPECT_EQ(of_body->who.in(Language::English), "the shank of T101001");
  EXPECT_NEAR(of_body->distance, -15, 0.1);
  const VerifiedRun plunge = bench.cut("G00 X350 Y150 Z50\nG01 Z12 F1000\nG00 Z50\n");
  ASSERT_FALSE(plunge.contacts.empty());
  EXPECT_NEAR(plunge.contacts.front().time, of_body->time, 0.001);
  EXPECT_EQ(plunge.contacts.front().who.in(Language::English), "the holder of T101001");
}

TEST(Material, APartThatFollowsIsToldWithItsOwnDepth) {
  Bench bench;
  bench.set_tool(10, 10, {.height = 15, .lower_diameter = 12, .upper_diameter = 12});
  // Across, the shank meets 13 mm; then the holder goes 0.5 mm down.
  const VerifiedRun run = bench.cut("G00 X350 Y150 Z50\nG01 Z17 F1000\nX370\nZ14.5\nG00 Z50\n");
  Lines bodies;
  for (const simulation::RunFinding& each : findings_with(run, "E151"))
    bodies.push_back(fmt::format("{} {} {:.1f}", each.line + 1, each.finding.names[0].in(Language::English),
                                 each.finding.values[0]));
  EXPECT_EQ(bodies, (Lines{"5 the shank of T101001 13.0", "6 the holder of T101001 0.5"}));
}

/// A short shank meets on each motion what it passes: on the way up all that it
/// has passed before.
TEST(Material, AWayOutIsNoDeeperThanTheWayIn) {
  Bench bench;
  bench.set_tool(3, 8, {.height = 7, .lower_diameter = 12, .upper_diameter = 12});
  bench.scene.tools[Shop::kTool].holder.reset();
  const auto lines = [&](const std::string& moves) {
    const VerifiedRun run = bench.cut("G00 X350 Y150 Z50\n" + moves + "G00 Z100\n");
    Lines all;
    for (const simulation::RunFinding& each : findings_with(run, "E151"))
      all.push_back(fmt::format("{} {:.0f} at {}", each.line + 1, each.finding.values[0],
                                each.worst_line.value_or(each.line) + 1));
    return all;
  };
  EXPECT_EQ(lines("G01 Z5 F1000\n"), Lines{"4 27 at 4"});
  EXPECT_EQ(lines("G01 Z14 F1000\nZ5\n"), (Lines{"4 27 at 5", "5 27 at 5"}));
  EXPECT_EQ(lines("G01 Z14 F1000\nZ5\nX360\n"), (Lines{"4 27 at 6", "5 27 at 6"}));
}

TEST(Material, ARapidOutOfWhereTheShankIsBelongsToItsContact) {
  Bench bench;
  bench.set_tool(10, 30, {.height = 30, .lower_diameter = 20, .upper_diameter = 20});
  for (const char* const last_plunge : {"", "Z0\n"}) {
    const VerifiedRun run =
        bench.cut("G00 X350 Y150 Z60\nG01 Z5 F1000\nX370\n" + std::string(last_plunge) + "G00 Z60\n");
    ASSERT_EQ(told(run).size(), 1u) << last_plunge;
    EXPECT_EQ(told(run)[0].substr(0, 10), "E151 5 5.0") << last_plunge;
  }
  // What the cutter takes on the way out is no other cut.
  bench.scene.tools[Shop::kTool].max_depth = 10;
  bench.scene.setup[0].shape = solids::Cuboid{.minimum = {0, 0, -60}, .maximum = {400, 300, 40}};
  bench.scene.resolution = 0.25;
  bench.machine.motion = timing::TimedMachine().motion;
  const Lines found = told(bench.cut("G00 X100 Y100 Z60\nG01 Z-22 F1000\nX120\nZ-22.5\nG00 Z60\n"));
  ASSERT_EQ(found.size(), 2u) << fmt::format("{}", fmt::join(found, "\n"));
  EXPECT_TRUE(found[0].starts_with("W157 4 "));
  EXPECT_TRUE(found[1].starts_with("E151 4 ")) << found[1];
}

TEST(Material, HolderOverWhatIsCutAway) {
  // The same depth, where the block has been lowered before.
  EXPECT_EQ(told(Bench().cut("G00 X250 Y100 Z50\nG01 Z30 "
                             "F9000\nX450\nY110\nX250\nY120\nX450\nY130\nX250\nY140\nX450\nY150\n"
                             "X250\nY160\nX450\nY170\nX250\nY180\nX450\nY190\nX250\nY200\nX450\nG0"
                             "0 Z50\nX350 Y150\nG01 Z-25 F1000\n"
                             "G00 Z50\n")),
            Lines());
}

TEST(Material, AHolderThatPloughsIsToldWhereItBegins) {
  // The holder goes 5 mm deep into the block; the retract, in rapid, takes the
  // cutter through where it was.
  const std::string plough = "G00 X350 Y150 Z50\nG01 Z-25 F1000\nX380\n";
  EXPECT_EQ(told(Bench().cut(plough + "G01 Z50\n")), Lines{"E151 4 5.0 Z-20.0"});
  EXPECT_EQ(told(Bench().cut(plough + "G00 Z50\n")), Lines{"E151 4 5.0 Z-20.0"});
  // Farther into the block in rapid, the cutter meets what the holder does not,
  // and Z is that of the cut.
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z-25 F1000\nG00 X360\nZ50\n")),
            (Lines{"E151 4 5.0 Z-20.0", "E150 5 40.0"}));  // Raised on the rounded corner, in the holder's
                                                           // 5 mm, too.
  // Both begin with the same rapid: the cutter's tells all.
  EXPECT_EQ(told(Bench().cut("G00 X250 Y150 Z50\nZ-25\nX500\nZ50\n")), Lines{"E150 5 35.0 Z40.0"});
}

TEST(Material, RoundedCornersLeaveLessThanTheProgramSays) {
  for (const double tolerance : {0.02, 0.05, 0.2}) {
    Bench bench;
    bench.scene.resolution = 0.1;
    bench.machine.motion.corner_tolerance = tolerance;
    // Out of the end of a slot at an angle, and back to the bottom of a hole.
    EXPECT_EQ(told(bench.cut("G00 X320 Y130 Z50\nG01 Z34 F1000\nX350 Y150 F8000\nG00 Z50\n")), Lines());
    EXPECT_EQ(told(bench.cut("G00 X330 Y150 Z50\nG01 Z35 F1000\nG00 "
                             "Z43\nZ35\nG01 Z30\nG00 Z50\n")),
              Lines());
    // A little more is found. The rapid turns back on a corner, too, which
    // begins twice as far above its end.
    const std::string below = fmt::format("G00 Z43\nZ{:.2f}\nZ50\n", 35 - 0.06 - 3 * tolerance);
    EXPECT_EQ(told(bench.cut("G00 X330 Y150 Z50\nG01 Z35 F1000\n" + below)).size(), 1u) << tolerance;
  }
}

TEST(Material, AToolThatIsMountedInIt) {
  Bench bench;
  constexpr execution::ToolCode kLonger{1, 1, 2};
  bench.scene.tools[kLonger] = bench.scene.tools[Shop::kTool];
  bench.scene.tools[kLonger].length = bench.machine.tool_lengths[kLonger] = 110;
  const std::string before = "G00 X350 Y150 Z50\nG01 Z32 F1000\nX370\nM05\n";
  const std::string after = "S9000 M03\nG01 X380 F1000\nG00 Z50\n";
  EXPECT_EQ(told(bench.cut(before + "M06 T101002\n" + after)), Lines{"E150 7 10.0"});
  EXPECT_EQ(told(bench.cut(before + "M06 T101001\n" + after)), Lines());
  // Beside the block, the longer tool brings its holder lower: not into it. A
  // shorter cutter brings it there.
  bench.scene.tools[kLonger].length = bench.machine.tool_lengths[kLonger] = 100;
  bench.scene.tools[kLonger].cutter = Shop::body(solids::flat_body(10, 50));
  const solids::StackRow holder{.height = 50, .lower_diameter = 50, .upper_diameter = 50};
  bench.scene.tools[kLonger].holder = Shop::body(solids::stacked_body({&holder, 1}, 50));
  EXPECT_EQ(told(bench.cut("G00 X280 Y150 Z50\nZ-17\nM05\nM06 T101002\nG00 Z50\n")), Lines{"E151 6 7.0"});
}

TEST(Material, WhereNoHeightHelpsNoneIsTold) {
  // Up out of the material with a wider tool above the slot's bottom, and
  // sideways from where a cut has ended.
  Bench bench;
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::disc_body(10, 4));
  bench.scene.tools[Shop::kTool].holder.reset();
  EXPECT_EQ(told(bench.cut("G00 X250 Y150 Z50\nZ20\nG01 X350 F1000\nG00 Z50\n")), Lines{"E150 6 16.0"});
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z30 F1000\nG00 X350\nZ50\n")), Lines{"E150 5 10.0"});
  // From a height that a rapid has chosen, another one helps.
  EXPECT_EQ(told(Bench().cut("G00 X320 Y150 Z50\nG01 Z30 F1000\nG00 Z35\nX350\nZ50\n")), Lines{"E150 6 5.0 Z40.0"});
}

TEST(Material, TimesAreThoseOfTheContact) {
  // 8 s for the tool and 2 s for the spindle; 18 mm down take 1.1 s, 90 mm to the block 10.8 s, and rapids half a one.
  Bench bench;
  bench.scene.tools[Shop::kTool].max_depth = 5;
  const VerifiedRun cut = bench.cut("G00 X200 Y150 Z50\nG01 Z32 F1000\nX350 F500\n");
  ASSERT_EQ(cut.contacts.size(), 1u);
  EXPECT_NEAR(cut.contacts[0].time, 22.4, 0.5);
  // The holder, 60 mm above the tip, is in the block on the last 5 of 140 mm.
  const VerifiedRun holder = Bench().cut("G00 X350 Y150 Z115\nG01 Z-25 F1000\nG00 Z50\n");
  ASSERT_EQ(holder.contacts.size(), 1u);
  EXPECT_NEAR(holder.contacts[0].time, 10 + 135 * 0.06 + 0.5, 0.5);
  EXPECT_NEAR(holder.contacts[0].worst_time - holder.contacts[0].time, 5 * 0.06, 0.05);
}

/// The whole height of a plate: what counts of a body is thinner, but the plate is not thicker.
TEST(Material, NothingIsDeeperThanThePlate) {
  Bench bench;
  bench.scene.setup.clear();
  bench.box("", {300, 100, 20}, {400, 200, 40}, BodyRole::Stock);
  const VerifiedRun run = bench.cut("G00 X350 Y150 Z50\nG01 Z-35 F900\nZ-41\nZ-90\nG00 Z50\n");
  for (const simulation::RunFinding& each : findings_with(run, "E151"))
    EXPECT_NEAR(each.finding.values[0], 20, 0.001) << each.line;
  EXPECT_EQ(told(run), Lines{"E151 4 20.0 Z-20.0"});
}

TEST(Material, SpindleStopped) {
  const auto stopped = [](const std::string& program) { return told(Bench().run(program)); };
  EXPECT_EQ(stopped("M06 T101001\nG00 X350 Y150 Z50\nG01 Z35 F1000\nG00 Z50\nM02\n"), Lines{"E158 3 5.0"});
  EXPECT_EQ(stopped("M06 T101001\nS9000 M03\nG00 X350 Y150 Z50\nG01 Z35 "
                    "F1000\nM05\nX370\nG00 Z50\nM02\n"),
            Lines{"E158 6 5.0"});
  // It stands, but cuts nothing.
  EXPECT_EQ(stopped("M06 T101001\nG00 X350 Y150 Z50\nG01 Z40 F1000\nG00 Z50\nM02\n"), Lines());
  EXPECT_EQ(stopped("M06 T101001\nS9000 M04\nG00 X350 Y150 Z50\nG01 Z35 "
                    "F1000\nG00 Z50\nM02\n"),
            Lines());
}

TEST(Material, OneStoppedSpindleIsOneMistake) {
  const VerifiedRun run = Bench().run(
      "M06 T101001\nG00 X320 Y150 Z50\nG01 Z35 F1000\nG00 "
      "Z50\nX370\nG01 Z35\nG00 Z50\nM02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  EXPECT_EQ(run.contacts[0].mistake, run.contacts[1].mistake);
}

TEST(Material, DeeperThanTheToolAllows) {
  Bench bench;
  bench.scene.tools[Shop::kTool].max_depth = 8;
  EXPECT_EQ(told(bench.cut("G00 X250 Y150 Z50\nG01 Z31.9 F1000\nX450\nG00 Z50\n")), Lines{"W157 5 8.1"});
  EXPECT_EQ(told(bench.cut("G00 X250 Y150 Z50\nG01 Z32.1 F1000\nX450\nG01 "
                           "Z25\nX250\nG00 Z50\n")),
            Lines());
}

TEST(Material, WallsThatWereCutBeforeAreNoDeepCut) {
  Bench bench;
  ToolBodies& tool = bench.scene.tools[Shop::kTool];
  tool.max_depth = 8;
  tool.cutter = Shop::body(solids::flat_body(10.659, 60));
  for (const double resolution : {0.1, 0.5}) {
    bench.scene.resolution = resolution;
    const auto is_free = [&](const std::string& moves, double depth) {
      const VerifiedRun run = bench.cut("G00 X363.007 Y150 Z50\nG01 Z40 F1000\n" + moves + "G00 Z50\n");
      EXPECT_EQ(told(run), Lines()) << moves;
      ASSERT_EQ(run.material->by_tool.size(), 1u);
      // Of a helix, what each of its chords takes.
      EXPECT_LE(run.material->by_tool[0].removed.depth, depth + 0.01) << moves;
      EXPECT_GE(run.material->by_tool[0].removed.depth, depth - 0.3) << moves;
    };
    std::string helix;
    for (int turn = 1; turn <= 8; ++turn)
      helix += fmt::format("G02 X363.007 Y150 Z{:.2f} I350 J150\n", 40 - 3.1 * turn);
    is_free(helix + "G02 X363.007 Y150 I350 J150\n", 3.1);
    std::string ramps;
    for (int level = 1; level <= 6; ++level)
      ramps += fmt::format("X{} Y{} Z{}\n", level % 2 == 1 ? 333 : 363.007, level % 2 == 1 ? 130 : 150, 40 - 3 * level);
    // Back and forth on a ramp, each pass is up to twice as deep as the way is
    // high.
    is_free(ramps + "X333 Y130\nX363.007 Y150\n", 6);
    // Three levels, and a pass along the wall that takes 0.1 mm.
    std::string walls;
    for (const int z : {34, 28, 22}) walls += fmt::format("G00 Z50\nX250 Y150\nZ{}\nG01 X450 F3000\n", z);
    is_free(walls + "G00 Z50\nX250 Y150.1\nZ22\nG01 X450\n", 6);
    // A pass that takes 2 mm of the whole wall is deep.
    EXPECT_EQ(told(bench.cut(walls + "G00 Z50\nX250 Y152\nZ22\nG01 X450\nG00 Z50\n")), Lines{"W157 18 18.0"});
  }
}

TEST(Material, WallsThatWereCutBeforeAreNoDeepCutWhileTheAxisTurns) {
  Bench bench(MachineKind::Head);
  bench.scene.tools[Shop::kTool].max_depth = 8;
  std::string walls = "G49\n";
  for (const int z : {34, 28, 22}) walls += fmt::format("G00 Z50\nX250 Y150 B0 C0\nZ{}\nG01 X450 F3000\n", z);
  // Along the wall, 0.1 mm farther, while B turns a little about Y, in the
  // plane of the way.
  const VerifiedRun pass = bench.cut(walls + "G00 Z50\nX250 Y150.1\nZ22.2\nG01 X450 B0.5 F3000\nG00 Z50 B0\n");
  EXPECT_EQ(told(pass), Lines());
  // 2 mm of it are a deep cut.
  EXPECT_EQ(told(bench.cut(walls + "G00 Z50\nX250 Y152\nZ22.2\nG01 X450 B0.5 F3000\nG00 Z50 B0\n")).size(), 1u);
}

TEST(Material, CornersWhereTheAxisTurnsLeaveMoreTheFartherFromTheTip) {
  const auto depth_of = [](const std::string& moves) {
    return *Bench(MachineKind::Head).cut("G00 X350 Y150 Z150\n" + moves).certificate->soft_depth;
  };
  const double at_rest = 0.5 / 8 + 0.002 + 0.02 + double{stock::Tile::kTouch};
  EXPECT_NEAR(depth_of("X300\n"), at_rest, 1e-9);
  EXPECT_NEAR(depth_of("X300 B5\n"), at_rest + std::hypot(60, 10) * 0.05 * pi / 180, 1e-9);
}

TEST(Material, ShortMotionsAreAsDeepAsLongOnes) {
  Bench bench;
  bench.scene.tools[Shop::kTool].max_depth = 8;
  for (const double step : {0.05, 0.3, 2.0}) {
    std::string slot = "G00 X285 Y150 Z50\nZ31.5\nG01 X287 F1000\n";
    for (double x = 287 + step; x < 310; x += step) slot += fmt::format("X{:.2f}\n", x);
    const VerifiedRun run = bench.cut(slot + "G00 Z50\n");
    ASSERT_EQ(run.contacts.size(), 1u) << step;
    EXPECT_NEAR(run.contacts[0].distance, -8.5, 0.001) << step;
  }
}

TEST(Material, EdgeThatIsTooShort) {
  Bench bench;
  ToolBodies& tool = bench.scene.tools[Shop::kTool];
  tool.cutter = Shop::body(solids::flat_body(10, 20));
  const auto shank = [&](double radius) {
    const solids::FormPoint points[] = {{20, radius}, {60, radius}};
    tool.shank = Shop::body(solids::form_body(points));
  };
  const std::string slot = "G00 X250 Y150 Z50\nG01 Z25 F1000\nX450\nZ{}\nX250\nG00 Z50\n";
  shank(10);
  const VerifiedRun rubs = bench.cut(fmt::format(fmt::runtime(slot), 12));
  EXPECT_EQ(told(rubs), Lines{"W157 7 28.0"});
  EXPECT_EQ(rubs.contacts[0].limit, 20);
  EXPECT_EQ(told(bench.cut(fmt::format(fmt::runtime(slot), 21))), Lines());
  // A thinner shank stands clear of the walls.
  shank(8);
  EXPECT_EQ(told(bench.cut(fmt::format(fmt::runtime(slot), 12))), Lines());
  // A thicker one is in them.
  shank(12);
  EXPECT_EQ(told(bench.cut(fmt::format(fmt::runtime(slot), 12))), Lines{"E151 7 8.0 Z20.0"});
}

TEST(Material, FeedThatMeetsNothing) {
  const VerifiedRun run = Bench().cut("G00 X350 Y150 Z60\nG01 X500 F1000\nG00 Z70\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].line, 3u);
  EXPECT_NEAR(run.contacts[0].distance, -150, 0.1);  // The corners are rounded.
  EXPECT_TRUE(Bench().cut("G00 X350 Y150 Z60\nG01 X390 F1000\nG00 Z70\n").contacts.empty());
  EXPECT_TRUE(Bench().cut("G00 X250 Y150 Z60\nG01 Z38 F1000\nX450\nG00 Z70\n").contacts.empty());
}

TEST(Material, LeftOnTheTarget) {
  Bench bench;
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(60, 60));
  bench.scene.tools[Shop::kTool].holder.reset();
  bench.box("", {300, 100, 0}, {400, 200, 30}, BodyRole::Target);
  bench.scene.target_tolerance = 0.1;
  EXPECT_EQ(told(bench.cut("G00 X200 Y150 Z50\nG01 Z30 F1000\nX500\nG00 Z50\n")), Lines());
  EXPECT_EQ(told(bench.cut("G00 X200 Y150 Z50\nG01 Z30.09 F1000\nX500\nG00 Z50\n")), Lines());
  EXPECT_EQ(told(bench.cut("G00 X200 Y150 Z50\nG01 Z30.2 F1000\nX500\nG00 Z50\n")), Lines{"W156 5 0.1"});
  const VerifiedRun strip = bench.cut("G00 X200 Y120 Z50\nG01 Z30 F1000\nX500\nG00 Z50\n");
  EXPECT_EQ(told(strip), Lines{"W156 5 9.9"});
  // From Y180 to Y200, without what the tolerance takes.
  EXPECT_NEAR(*strip.contacts[0].volume, 100 * 20 * 10, 800);
}

TEST(Material, LeftOnTheTargetIsToldBeyondItsTolerance) {
  Bench bench;
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(60, 60));
  bench.scene.tools[Shop::kTool].holder.reset();
  bench.box("", {300, 100, 0}, {400, 200, 30}, BodyRole::Target);
  bench.scene.target_tolerance = 0.3;
  const VerifiedRun run = bench.cut("G00 X200 Y150 Z50\nG01 Z30.5 F1000\nX500\nG00 Z50\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  const std::string english = in_words(run.contacts[0], Language::English);
  EXPECT_NE(english.find(": up to 0.2 mm beyond its tolerance of 0.3 mm, at X"), std::string::npos) << english;
  const std::string italian = in_words(run.contacts[0], Language::Italian);
  EXPECT_NE(italian.find(": fino a 0.2 mm oltre la tolleranza di 0.3 mm, in X"), std::string::npos) << italian;
}

TEST(Material, WhatIsCutOffIsNotLeft) {
  Bench bench;
  bench.box("", {320, 120, 0}, {380, 180, 40}, BodyRole::Target);
  bench.scene.target_tolerance = 0.1;
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(5, 60));
  const std::string around = "G00 X315 Y115 Z50\nG01 Z-0.1 F1000\nX385\nY185\nX315\n";
  EXPECT_EQ(told(bench.cut(around + "Y115\nG00 Z50\n")), Lines());
  // A tab of 10 mm holds the frame: all of it stands on the part.
  EXPECT_EQ(told(bench.cut(around + "Y135\nG00 Z50\n")).size(), 1u);
}

TEST(Material, PiecesThatNothingHolds) {
  const std::string around = "G00 X315 Y120 Z50\nG01 Z-0.1 F1000\nX385\nY180\nX315\n";
  Bench bench;
  bench.box("clamp", {280, 95, 0}, {300, 105, 40});
  const VerifiedRun run = bench.cut(around + "Y120\nG00 Z50\n");
  EXPECT_EQ(told(run), Lines{"W161 8 40.0"});
  EXPECT_NEAR(*run.contacts[0].volume, 50 * 40 * 40, 1000);
  EXPECT_GT(run.contacts[0].time, 0);
  // A tab of 10 mm holds it.
  EXPECT_EQ(told(bench.cut(around + "Y150\nG00 Z50\n")), Lines());
  // It comes free once, whatever comes after.
  EXPECT_EQ(told(bench.cut(around + "Y120\nG00 Z50\nM06 T102001\nG00 X0 Y0\n")).size(), 1u);
  // A cup below it holds it.
  bench.box("cup", {340, 140, -60}, {360, 160, 0});
  EXPECT_EQ(told(bench.cut(around + "Y120\nG00 Z50\n")), Lines());
  // Where nothing is described that holds, nothing is said.
  EXPECT_EQ(told(Bench().cut(around + "Y120\nG00 Z50\n")), Lines());
}

/// As many motions as several batches hold, each a little deeper than those
/// before, with tools in between.
TEST(Material, ThreadsChangeNothing) {
  constexpr int kMotions = 9000;
  support::Random random(3);
  std::string moves = "G00 X350 Y150 Z50\nG01 Z45 F6000\n";
  for (int i = 0; i < kMotions; ++i) {
    if (i % 1700 == 1699) moves += "G00 Z60\nM06 T101001\nS12000 M03\nG00 X350 Y150 Z50\nG01 Z45\n";
    const int code = i % 500 == 0 ? 0 : 1;  // Rapids meet material.
    const double ceiling = 44 - 60.0 * i / kMotions;
    moves += fmt::format("G0{} X{:.2f} Y{:.2f} Z{:.2f}\n", code, random.real(295, 405), random.real(95, 205),
                         random.real(ceiling - 4, ceiling));
  }
  const auto all_of = [&](WorkTogether together) {
    const VerifiedRun run = Bench().cut(moves, std::move(together));
    std::vector<std::string> all = told(run);
    for (const removal::RemovedByTool& each : run.material->by_tool)
      all.push_back(fmt::format("{} {} {}", each.removed.volume, each.removed.depth, each.seconds));
    for (const simulation::RemovedOnLine& each : run.material->by_line)
      all.push_back(fmt::format("{} {} {}", each.line, each.volume, each.depth));
    all.push_back(stock::write_stock(run.material->stock));
    return all;
  };
  const std::vector<std::string> alone = all_of({});
  EXPECT_GT(alone.size(), 1000u);
  EXPECT_TRUE(all_of(support::on_threads(2)) == alone);
  EXPECT_TRUE(all_of(support::on_threads(3)) == alone);
}

/// How a run of a machine with a head is listened to.
struct Listening {
  double interval = 0;  ///< Of the moments at which somebody looks at the stock,
                        ///< s; 0 for none.
  Alongside alongside = {};
  WorkTogether together = {};
};

/// What the run finds and leaves.
std::vector<std::string> told_to(const Listening& listening, const std::string& program,
                                 const Bench& bench = Bench(MachineKind::Head)) {
  running::RunOptions options;
  options.setup.home = bench.machine.home;
  Verifier verifier(bench.scene, bench.machine, geometry::Vec3::Zero(), listening.together);
  int looks = 0;
  if (listening.interval > 0)
    verifier.material()->watch([&](const stock::Stock&, double time) {
      ++looks;
      return time + listening.interval;
    });
  VerifierQueue queue(verifier, listening.alongside);
  timing::Timing timing(bench.machine,
                        {.event = [&](const timing::TimedEvent& timed) { queue.take(timed); },
                         .stretch = [&](const motion::Stretch& stretch,
                                        const timing::TimedEvent& timed) { queue.take(stretch, timed); }});
  running::run(program, options, [&](const running::Event& event) { timing.take(event); });
  timing.finish();
  queue.finish();
  verifier.finish();
  EXPECT_EQ(looks > 10, listening.interval > 0);
  std::vector<std::string> all;
  for (const Contact& each : verifier.contacts())
    all.push_back(fmt::format("{} {} {} {}", dialect::definition(each.id).code, each.line, each.distance, each.time));
  for (const simulation::RemovedOnLine& each : verifier.material()->removed_by_line())
    all.push_back(fmt::format("{} {} {}", each.line, each.volume, each.depth));
  all.push_back(stock::write_stock(verifier.material()->stock()));
  return all;
}

/// Short motions that turn the axis, with a rapid now and then.
std::string walk_in_four_axes(int motions) {
  support::Random random(7);
  std::string program = "M06 T101001\nS12000 M03\nG49\nG00 X300 Y150 Z50 B10 C0\nG01 Z38 F2000\n";
  double heading = 0;
  double x = 300;
  double y = 150;
  for (int i = 0; i < motions; ++i) {
    heading += random.real(-0.1, 0.15);
    x += std::cos(heading);
    y += std::sin(heading);
    if (i % 1500 == 1499) program += "G00 Z60\nM05\nM06 T101001\nS9000 M03\nG90 G00 Z39\n";
    program += fmt::format("{} X{:.3f} Y{:.3f} Z{:.3f} B{:.3f}\n", i % 100 == 99 ? "G00" : "G01", x, y,
                           38 + random.real(-0.05, 0.05), 10 + random.real(-0.1, 0.1));
  }
  return program + "M02\n";
}

/// Pieces of a motion are cut at once, whoever looks meanwhile.
TEST(Material, WhoLooksMeanwhileChangesNothing) {
  const std::string program = walk_in_four_axes(support::kTriesAll ? 600 : 200);
  const std::vector<std::string> alone = told_to({}, program);
  EXPECT_GT(alone.size(), 30u);
  EXPECT_TRUE(told_to({.interval = 0.05}, program) == alone);
  EXPECT_TRUE(told_to({.interval = 0.003}, program) == alone);
}

/// Whatever comes after it, and whoever looks at the stock meanwhile.
TEST(Material, TheStopOfTheSpindleIsTheOneBeforeTheCut) {
  const std::string moves = "G00 X320 Y150 Z50\nM05\nG01 Z37 F1000\nX330\nM03\nG01 X370\nM05\nG01 X380\nG00 Z50\nM05\n";
  const VerifiedRun run = Bench().cut(moves);
  ASSERT_EQ(run.contacts.size(), 2u);
  EXPECT_EQ(run.contacts[0].shaped_by, 3u);
  EXPECT_EQ(run.contacts[1].shaped_by, 8u);
  EXPECT_NE(run.contacts[0].mistake, run.contacts[1].mistake);
  const std::string program = "M06 T101001\nS12000 M03\n" + moves + "M02\n";
  EXPECT_EQ(told_to({.interval = 0.01}, program), told_to({}, program));
}

/// A full circle is two pieces of one stretch: the first one cuts, and the second one, past the block, may be open when
/// somebody looks.
TEST(Material, WhoLooksWithinACircleChangesNothing) {
  std::string program = "M06 T101001\nS12000 M03\nG00 X315 Y100 Z50 B0 C0\n";
  const int circles = support::kTriesAll ? 10 : 2;
  for (int i = 0; i < circles; ++i) program += fmt::format("G01 Z{} F4000\nG02 X315 Y100 I350 J100 F4000\n", 39 - i);
  program += "M02\n";
  const std::vector<std::string> alone = told_to({}, program);
  EXPECT_TRUE(told_to({.interval = 0.01}, program) == alone);
  EXPECT_TRUE(told_to({.interval = 0.003}, program) == alone);
}

/// A rapid in several phases through the block: its depth is that below the material before all of it.
TEST(Material, WhoLooksWithinARapidChangesNothing) {
  const std::string program =
      "M06 T101001\nS12000 M03\nG00 X310 Y150 Z60 B0 C0\nZ30\nX390 Z50\nX310 Z25\nY190 Z20 B20\nM02\n";
  Bench bench(MachineKind::Head);
  bench.machine.motion.rapid_motion = kinematics::RapidMotion::Independent;
  for (kinematics::AxisLimits& axis : bench.machine.motion.axes) {
    axis.speed = 100;
    axis.acceleration = 1000;
    axis.jerk = 20'000;
  }
  const std::vector<std::string> alone = told_to({}, program, bench);
  EXPECT_GT(alone.size(), 4u);
  EXPECT_TRUE(told_to({.interval = 0.05}, program, bench) == alone);
  EXPECT_TRUE(told_to({.interval = 0.003}, program, bench) == alone);
}

TEST(Material, VerifyingWhileTheRunGoesOnChangesNothing) {
  const std::string program = walk_in_four_axes(9000);
  const std::vector<std::string> alone = told_to({}, program);
  std::thread thread;
  const auto wait = [&] {
    if (thread.joinable()) thread.join();
  };
  const auto start = [&](const std::function<void()>& task) {
    wait();
    thread = std::thread(task);
  };
  const Alongside alongside{.start = start, .wait = wait};
  EXPECT_TRUE(told_to({.alongside = alongside}, program) == alone);
  EXPECT_TRUE(told_to({.alongside = alongside, .together = support::on_threads(2)}, program) == alone);
}

TEST(Material, TiltedToolsCutTheVolumeOfTheirClosedForm) {
  // A plunge through the block at 30 degrees.
  Bench bench(MachineKind::Head);
  bench.scene.tools[Shop::kTool].holder.reset();
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(10, 90));
  const double sine = 0.5;
  const double cosine = std::sqrt(0.75);
  const auto at = [&](double along) { return fmt::format("X{:.5f} Z{:.5f}", 350 + along * sine, 20 + along * cosine); };
  const VerifiedRun run =
      bench.cut("G00 Y150 Z400 B30\nG00 " + at(60) + "\nG01 " + at(-45) + " F1000\nG00 " + at(60) + "\nG00 Z300\n");
  EXPECT_EQ(told(run), Lines());
  const double exact = pi * 100 * 40 / cosine;
  EXPECT_NEAR(removed(run), exact, 0.003 * exact);
}

TEST(Material, ToolsThatLie) {
  // A slot of 15 mm into the front face, at half its height, and a rapid 10 mm
  // into it.
  Bench bench(MachineKind::Head);
  bench.scene.tools[Shop::kTool].cutter = Shop::body(solids::flat_body(8, 60));
  const std::string side =
      "G00 X350 Y-100 Z20 B0 C0\nB90 C-90\nG29 X300 Y100 "
      "Z40 C-90 B90\nG00 X20 Y30 Z50\n";
  const VerifiedRun slot = bench.cut(side + "Z5\nG01 Z-15 F1000\nY70\nG00 Z50\n");
  EXPECT_EQ(told(slot), Lines());
  ASSERT_EQ(slot.material->by_tool.size(), 1u);
  EXPECT_NEAR(slot.material->by_tool[0].removed.depth, 15, 0.5);
  EXPECT_NEAR(slot.material->by_tool[0].removed.width, 16, 0.5);
  EXPECT_NEAR(removed(slot), (pi * 64 + 16 * 40) * 15, 100);
  const VerifiedRun rapid = bench.cut(side + "Z-10\nZ50\n");
  ASSERT_EQ(rapid.contacts.size(), 1u);
  // Across the dexels, material is known to within their spacing.
  EXPECT_NEAR(rapid.contacts[0].distance, -10, 0.3);
  EXPECT_NEAR(rapid.contacts[0].enough.value(), 0.2, 0.2);
}

TEST(Material, ALyingToolIsAsDeepAsItMustRise) {
  // The tip goes 50 mm into the side of the block. The tool lies along X, its
  // lower edge 30 and 40 mm below the face.
  Bench bench(MachineKind::Head);
  bench.scene.tools[Shop::kTool].holder.reset();
  const std::string beside = "G00 X450 Y150 Z200 B90 C0\n";
  EXPECT_EQ(told(bench.cut(beside + "Z20\nX350\nX450\n")), Lines{"E150 5 30.0 Z50.0"});
  EXPECT_EQ(told(bench.cut(beside + "Z10\nX350\nX450\n")), Lines{"E150 5 40.0 Z50.0"});
}

TEST(Material, AShankThatRubsOnALyingToolToldByItsDepth) {
  // 25 mm deep into the front face, with an edge of 20 mm.
  Bench bench(MachineKind::Head);
  ToolBodies& tool = bench.scene.tools[Shop::kTool];
  tool.cutter = Shop::body(solids::flat_body(8, 20));
  const solids::FormPoint points[] = {{20, 8}, {60, 8}};
  tool.shank = Shop::body(solids::form_body(points));
  const std::string side =
      "G00 X350 Y-100 Z20 B0 C0\nB90 C-90\nG29 X300 Y100 "
      "Z40 C-90 B90\nG00 X20 Y30 Z50\n";
  const VerifiedRun run = bench.cut(side + "G01 Z-15 F1000\nZ-25\nG00 Z50\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_TRUE(run.contacts[0].is_of_edge);
  EXPECT_EQ(run.contacts[0].line + 1, 8u);
  EXPECT_NEAR(run.contacts[0].distance, -25, 0.5);
}

TEST(Material, WithoutAToolOrAStockNothingIsCut) {
  EXPECT_EQ(removed(Bench().run("G00 X250 Y150 Z5\nX500\nM02\n")), 0);
  Bench bench;
  bench.scene.setup.clear();
  EXPECT_FALSE(bench.cut("G00 X250 Y150 Z5\nX500\n").material.has_value());
}

TEST(Material, AResolutionThatNobodyAskedForIsARoundOne) {
  const auto resolution = [](double side) {
    Shop shop;
    shop.box("", {0, 0, 0}, {side, side, 20}, BodyRole::Stock);
    return shop.run("M06 T101001\nG00 X0\nM02\n").material->stock.spacing();
  };
  EXPECT_NEAR(resolution(50), 0.1, 1e-9);
  EXPECT_NEAR(resolution(200), 0.2, 1e-9);
  EXPECT_NEAR(resolution(300), 0.25, 1e-9);
  EXPECT_NEAR(resolution(370), 0.5, 1e-9);
  EXPECT_NEAR(resolution(1000), 0.5, 1e-9);
  // What would fit is round as well.
  Bench bench;
  bench.scene.setup.clear();
  bench.box("", {0, 0, 0}, {3000, 1500, 20}, BodyRole::Stock);
  bench.scene.resolution = 0.01;
  const VerifiedRun run = bench.cut("G00 X0\n");
  ASSERT_EQ(run.certificate->gaps.size(), 1u);
  EXPECT_NEAR(run.certificate->gaps[0].spacing, 0.2, 1e-9);
}

TEST(Material, TotalsHaveThePointOfProgramsInBothLanguages) {
  const VerifiedRun run = Bench().cut("G00 X250 Y150 Z50\nG01 Z35 F1000\nX450\nG00 Z50\n");
  EXPECT_TRUE(in_words(*run.material, Language::English).starts_with("material: 10.0 cm3 removed of 400.0 cm3, "));
  EXPECT_TRUE(in_words(*run.material, Language::Italian).starts_with("materiale: asportati 10.0 cm3 di 400.0 cm3, "));
  Bench large;
  large.scene.setup.clear();
  large.box("", {0, 0, 0}, {800, 600, 18}, BodyRole::Stock);
  const VerifiedRun panel = large.cut("G00 X0\n");
  EXPECT_TRUE(in_words(*panel.material, Language::English).starts_with("material: 0.0 cm3 removed of 8,640.0 cm3, "));
  EXPECT_TRUE(
      in_words(*panel.material, Language::Italian).starts_with("materiale: asportati 0.0 cm3 di 8 640.0 cm3, "));
}

TEST(Material, AResolutionThatDoesNotFitIsRefused) {
  Bench bench;
  bench.scene.resolution = 0.001;
  const VerifiedRun run = bench.cut("G00 X250 Y150 Z50\nZ5\nX500\nZ50\n");
  EXPECT_FALSE(run.material.has_value());
  ASSERT_EQ(run.certificate->gaps.size(), 1u);
  EXPECT_EQ(run.certificate->gaps[0].gap, Gap::ResolutionTooFine);
  EXPECT_GT(run.certificate->gaps[0].spacing, 0.001);
}

}  // namespace
}  // namespace isocnc::verification
