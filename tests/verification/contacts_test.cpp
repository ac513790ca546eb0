#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/simulation/timed_run.h"
#include "tests/support/random.h"
#include "tests/support/threads.h"
#include "tests/verification/scenes.h"

namespace isocnc::verification {
namespace {

using geometry::Vec3;
using kinematics::MachineKind;

/// Contacts as text: code, lines from 1, the bodies, and the distance. The machine rounds corners by up to 0.02 mm, so
/// that a tool that goes down and up again turns a little above its deepest point.
std::string told(const std::vector<Contact>& contacts) {
  std::string text;
  for (const Contact& contact : contacts)
    text += fmt::format("{} {}-{} {} | {} {:.1f}\n", dialect::definition(contact.id).code, contact.line + 1,
                        contact.end_line + 1, contact.who.in(dialect::Language::English),
                        contact.whom.in(dialect::Language::English), contact.distance);
  return text;
}

TEST(Contacts, CutterHitsAClampFromFirstTouchToLast) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z10\nG01 X95 F1000\nX120\nX200\nZ50\nM02\n");
  // The edge of the cutter is at X105 on line 3; it leaves on line 5 at X150. 20 mm below the top, 20 to the sides.
  EXPECT_EQ(told(run.contacts), "E152 3-5 the cutter of T101001 | clamp 1 -20.0\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  const Contact& contact = run.contacts.front();
  EXPECT_LT(contact.time, contact.end_time);
  EXPECT_EQ(run.certificate->contacts, 1u);
  EXPECT_EQ(run.certificate->motions, 5u);
  EXPECT_TRUE(run.certificate->gaps.empty());
}

TEST(Contacts, StartAndEndOfATouchAreExact) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  const std::string program = "M06 T101001\nG00 X0 Y0 Z10\nG01 X200 F6000\nM02\n";
  const VerifiedRun run = shop.run(program);
  ASSERT_EQ(run.contacts.size(), 1u);
  std::vector<motion::Stretch> stretches;
  running::RunOptions options;
  options.setup.home = shop.machine.home;
  simulation::run_timed(program, options, shop.machine,
                        {.event = {}, .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) {
                           stretches.push_back(stretch);
                         }});
  const auto x_at = [&](double time) {
    for (const motion::Stretch& stretch : stretches)
      if (time <= stretch.start + stretch.duration) return stretch.at(shop.machine.motion.kinematics, time).tip.tip.x();
    return 200.0;
  };
  EXPECT_NEAR(x_at(run.contacts[0].time), 90, 0.021);
  EXPECT_NEAR(x_at(run.contacts[0].end_time), 150, 0.021);
}

TEST(Contacts, RapidsHitAsWell) {
  Shop shop;
  shop.box("cup 2", {100, -20, 0}, {140, 20, 30});
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X0 Y0 Z10\nX200\nM02\n").contacts),
            "E152 3-3 the cutter of T101001 | cup 2 -20.0\n");
}

/// Where each joint goes at its own speed, Y arrives first, and X goes on beside the line between the ends.
TEST(Contacts, RapidsGoWhereTheirJointsLeadThem) {
  Shop shop;
  shop.box("on the line", {140, 60, 0}, {150, 70, 30});
  shop.box("beside it", {175, 98, 0}, {180, 102, 30});
  const std::string program = "M06 T101001\nG00 X0 Y0 Z10\nX250 Y100\nM02\n";
  for (kinematics::AxisLimits& axis : shop.machine.motion.axes) axis.speed = 1000, axis.acceleration = 5000;
  EXPECT_EQ(told(shop.run(program).contacts), "E152 3-3 the cutter of T101001 | on the line -10.0\n");
  shop.machine.motion.rapid_motion = kinematics::RapidMotion::Independent;
  EXPECT_EQ(told(shop.run(program).contacts), "E152 3-3 the cutter of T101001 | beside it -12.0\n");
  // One after the other they go the same way on both.
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X0 Y0 Z10\nY100\nX250\nM02\n").contacts),
            "E152 4-4 the cutter of T101001 | beside it -12.0\n");
}

TEST(Contacts, HolderAndNoseAreBodiesOfTheirOwn) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("wall", {30, -500, -100}, {60, 500, 200});
  // The cutter passes 15 mm beside the wall; the holder, whose radius is 25, does not.
  const VerifiedRun run = shop.run("M06 T101001\nG00 X5 Y0 Z300\nZ145\nZ300\nM02\n");
  EXPECT_EQ(told(run.contacts), "");
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X10 Y0 Z300\nZ135\nZ300\nM02\n").contacts),
            "E152 3-4 the holder of T101001 | wall -5.0\n");
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X-20 Y0 Z300\nZ90\nZ300\nM02\n").contacts),
            "E152 3-4 the spindle nose | wall -10.0\n");
}

TEST(Contacts, WithoutAShapeTheNoseIsCompared) {
  Shop shop;
  shop.machine.tool_lengths[{1, 1, 2}] = 80;
  shop.box("clamp 1", {-50, -50, 0}, {50, 50, 30});
  EXPECT_EQ(told(shop.run("M06 T101002\nG01 Z-51 F5000 G09\nM02\n").contacts),
            "E152 2-2 the spindle nose | clamp 1 -1.0\n");
  EXPECT_EQ(told(shop.run("M06 T101002\nG00 Z-47\nM02\n").contacts), "");
}

TEST(Contacts, NearMissIsNoContact) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z50\nZ31\nX120\nX200\nM02\n");
  EXPECT_EQ(told(run.contacts), "W154 4-4 the cutter of T101001 | clamp 1 1.0\n");
  EXPECT_EQ(run.certificate->contacts, 0u);
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X0 Y0 Z50\nZ32.1\nX200\nM02\n").contacts), "");
}

/// What comes near and goes back is told where it was nearest, with its line and its distance.
TEST(Contacts, NearMissOfAnApproachIsToldWhereItEnds) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  for (const double gap : {0.1, 1.0, 1.9, 1.98, 1.999}) {
    const VerifiedRun run =
        shop.run(fmt::format("M06 T101001\nG00 X120 Y0 Z50\nG01 Z{} F1000 G09\nG00 Z50\nM02\n", 30 + gap));
    ASSERT_EQ(run.contacts.size(), 1u) << gap;
    EXPECT_EQ(run.contacts[0].line, 2u);
    EXPECT_NEAR(run.contacts[0].distance, gap, 1e-5);
  }
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X120 Y0 Z50\nG01 Z32.001 F1000 G09\nG00 Z50\nM02\n").contacts), "");
}

/// However long a tool passes an obstacle, and however near, a straight pass is proven.
TEST(Contacts, LongPassesAreProven) {
  Shop shop;
  shop.box("rail", {0, -20, 0}, {4000, 20, 30});
  shop.box("", {0, 100, 0}, {4000, 300, 30}, BodyRole::Target).shape = mesh_of({{0, 100, 0}, {4000, 300, 30}});
  const VerifiedRun above = shop.run("M06 T101001\nG00 X-50 Y0 Z30.03\nG01 X3500 F5000\nG00 Z100\nM02\n");
  EXPECT_EQ(told(above.contacts), "W154 3-3 the cutter of T101001 | rail 0.0\n");
  EXPECT_TRUE(above.certificate->gaps.empty());
  const VerifiedRun beside = shop.run("M06 T101001\nG00 X-50 Y90 Z5\nG01 X3500 F5000\nG00 Z100\nM02\n");
  EXPECT_EQ(told(beside.contacts), "");
  EXPECT_TRUE(beside.certificate->gaps.empty());
}

/// How deep a flat cutter goes into a slope is measured across the slope, by its rim.
TEST(Contacts, GougesOfASlopeCountAcrossIt) {
  const auto corner = [](double x, double y) { return Vec3(x, y, x); };
  const Vec3 a = corner(0, 0);
  const Vec3 b = corner(200, 0);
  const Vec3 c = corner(200, 200);
  const Vec3 d = corner(0, 200);
  const Vec3 low(200, 0, 0);
  const Vec3 far(200, 200, 0);
  Shop shop;
  shop.scene.target_tolerance = 0.2;
  shop.box("", {}, {}, BodyRole::Target).shape =
      std::make_shared<const solids::Mesh>(std::vector<solids::Triangle>{{{a, b, c}},
                                                                         {{a, c, d}},
                                                                         {{a, low, b}},
                                                                         {{d, c, far}},
                                                                         {{b, low, far}},
                                                                         {{b, far, c}},
                                                                         {{a, d, far}},
                                                                         {{a, far, low}}});
  const auto run_at = [&](double gouge) {
    // The rim, 10 before the axis, is `gouge` below the plane X = Z.
    const double z = 100 - gouge * std::numbers::sqrt2;
    return shop.run(fmt::format("M06 T101001\nG00 X90 Y50 Z300\nG01 Z{} F1000 G09\nY150 G09\nG00 Z300\nM02\n", z));
  };
  for (const double accepted : {0.0, 0.1, 0.2}) EXPECT_EQ(told(run_at(accepted).contacts), "") << accepted;
  for (const double deep : {0.24, 0.28, 0.32, 0.5, 2.0}) {
    const VerifiedRun run = run_at(deep);
    ASSERT_EQ(run.contacts.size(), 1u) << deep;
    EXPECT_EQ(dialect::definition(run.contacts[0].id).code, "E155");
    EXPECT_NEAR(run.contacts[0].distance, 0.2 - deep, 0.002) << deep;
  }
}

TEST(Contacts, MachineSpoilboardAndPartHaveTheirCodes) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.machine.push_back({.name = "table",
                                .role = BodyRole::Machine,
                                .shape = solids::Cuboid{.minimum = {-500, -500, -200}, .maximum = {500, 500, -100}}});
  shop.box("", {-400, -400, -60}, {400, 400, -20}, BodyRole::Spoilboard);
  shop.box("", {100, 100, -20}, {200, 200, 0}, BodyRole::Target);
  shop.scene.target_tolerance = 0.2;
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X0 Y0 Z5\nZ-21\nZ5\nM02\n").contacts),
            "E153 3-4 the cutter of T101001 | the spoilboard -1.0\n");
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X450 Y0 Z5\nZ-101\nZ5\nM02\n").contacts),
            "E153 3-4 the cutter of T101001 | table -1.0\n");
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X150 Y150 Z5\nZ-1\nZ5\nM02\n").contacts),
            "E155 3-4 the cutter of T101001 | the finished part -0.8\n");
}

TEST(Contacts, FinishingAtTheLimitIsNone) {
  Shop shop;
  shop.box("", {-400, -400, -60}, {400, 400, -20}, BodyRole::Spoilboard);
  shop.box("", {100, 100, -20}, {200, 200, 0}, BodyRole::Target);
  shop.scene.target_tolerance = 0.2;
  EXPECT_EQ(
      told(shop.run("M06 T101001\nG00 X90 Y90 Z5\nZ-20\nG01 X90 Y210 F1000\nX210\nY90\nX90\nG00 Z5\nM02\n").contacts),
      "");
  EXPECT_EQ(told(shop.run("M06 T101001\nG00 X150 Y150 Z5\nG01 Z0 F1000\nX160\nG00 Z5\nM02\n").contacts), "");
}

TEST(Contacts, FrameOfTheSetupIsThatOfTheFirstG92) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  const std::string program =
      "M06 T101001\nG92 X1000 Y500 Z-30\nG00 X0 Y0 Z50\nX120\nZ10\nZ50\nG92 X0 Y0 Z0\nX1120\nM02\n";
  const VerifiedRun run = shop.run(program);
  EXPECT_EQ(told(run.contacts), "E152 5-6 the cutter of T101001 | clamp 1 -20.0\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  // The point is told in the frame in force, and kept in that of the machine.
  EXPECT_NEAR(run.contacts[0].point.x(), 1120, 20);
  shop.scene.is_in_workpiece_frame = false;
  EXPECT_EQ(told(shop.run(program).contacts), "");
}

TEST(Contacts, ToolWithoutShapeOrLengthIsTold) {
  Shop shop;
  shop.machine.tool_lengths[{1, 1, 2}] = 80;
  const VerifiedRun run = shop.run("M06 T101001\nM06 T101002\nM06 T101003\nM06 T101002\nM02\n");
  ASSERT_EQ(run.certificate->gaps.size(), 2u);
  EXPECT_EQ(run.certificate->gaps[0].gap, Gap::ToolWithoutShape);
  EXPECT_EQ(run.certificate->gaps[0].line, 1u);
  EXPECT_EQ(run.certificate->gaps[1].gap, Gap::ToolWithoutLength);
}

TEST(Contacts, HeadSwingsIntoAWallAtRest) {
  Shop shop(MachineKind::Head);
  shop.scene.clearance = 0;
  // With the tip held at 0 and B at 90, the tool lies along +X: holder and nose come to X60 and more.
  shop.box("wall", {70, -300, -20}, {90, 300, 20});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100\nZ0\nG49\nG01 B90 F1000\nB0\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(told(run.contacts).substr(0, 40), "E152 5-6 the holder of T101001 | wall -3");
  // At B90 it must go back by 30 mm; on its way it goes round the corner of the wall.
  EXPECT_LE(run.contacts[0].distance, -29.9);
  EXPECT_GE(run.contacts[0].distance, -45);
}

TEST(Contacts, TableTurnsTheClampIntoTheNose) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.box("clamp", {180, -20, -50}, {200, 20, 150});
  // Seen from the part the tool tilts towards +X, so that the clamp comes towards the nose.
  const std::string program = "M06 T101001\nG00 X0 Y0 Z60\nG49\nG01 B60 F1000\nM02\n";
  EXPECT_EQ(told(shop.run(program).contacts).substr(0, 30), "E152 4-4 the spindle nose | cl");
  // What stands beside the table stays where it is.
  shop.scene.setup.clear();
  shop.scene.machine.push_back({.name = "column",
                                .role = BodyRole::Machine,
                                .shape = solids::Cuboid{.minimum = {180, -20, -50}, .maximum = {200, 20, 150}}});
  EXPECT_EQ(told(shop.run(program).contacts), "");
}

TEST(Contacts, OneSlipIsOneFinding) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  std::string program = "M06 T101001\nG00 X0 Y0 Z10\n";
  for (int i = 0; i < 5; ++i) program += "X200\nX0\n";
  const VerifiedRun run = shop.run(program + "M02\n");
  EXPECT_EQ(run.contacts.size(), 10u);
  std::set<std::int32_t> mistakes;
  for (const simulation::RunFinding& each : run.outcome.findings) mistakes.insert(each.mistake);
  EXPECT_EQ(mistakes.size(), 1u);
}

std::string many_moves(std::uint64_t seed) {
  support::Random random(seed);
  std::string program = "M06 T101001\nG49\nG00 X0 Y0 Z120\n";
  for (int i = 0; i < 1500; ++i)
    program += fmt::format("G0{} X{:.1f} Y{:.1f} Z{:.1f} B{:.1f} C{:.1f}{}\n", random.between(0, 1),
                           random.real(-200, 200), random.real(-200, 200), random.real(20, 200), random.real(-60, 60),
                           random.real(-180, 180), i == 0 ? " F5000" : "");
  return program + "M02\n";
}

/// Not all of many near misses are kept, but none hides what comes after it.
TEST(Contacts, ANewMistakeIsNotLostBehindManyOfAnother) {
  Shop shop;
  shop.box("rib", {100, -20, 0}, {140, 20, 30});
  shop.box("clamp 1", {400, -20, 0}, {440, 20, 30});
  std::string program = "M06 T101001\nG00 X70 Y0 Z31\n";
  constexpr int kPasses = 10'050;
  for (int i = 0; i < kPasses; ++i) program += i % 2 == 0 ? "G01 X170 F60000\n" : "X70\n";
  const VerifiedRun run = shop.run(program + "G00 Z60\nX400\nZ10\nZ60\nM02\n");
  ASSERT_EQ(run.contacts.size(), 10'001u);
  EXPECT_TRUE(run.contacts.front().is_near_miss());
  EXPECT_EQ(told({run.contacts.back()}),
            fmt::format("E152 {0}-{1} the cutter of T101001 | clamp 1 -10.0\n", kPasses + 5, kPasses + 6));
  EXPECT_EQ(run.certificate->contacts, 1u);
  EXPECT_EQ(run.certificate->more_contacts, 50u);
}

TEST(Contacts, AnyNumberOfThreadsFindsTheSame) {
  Shop shop(MachineKind::Head);
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  shop.pin("pin", {-100, 50, 0}, {0, 0, 1}, 60, 12);
  const std::string program = many_moves(7);
  const auto with = [&](WorkTogether together) {
    const VerifiedRun run = shop.run(program, std::move(together));
    std::string text = told(run.contacts);
    for (const Contact& contact : run.contacts) text += fmt::format("{} {}\n", contact.time, contact.end_time);
    return text;
  };
  const std::string alone = with({});
  EXPECT_FALSE(alone.empty());
  EXPECT_EQ(with(support::on_threads(2)), alone);
  EXPECT_EQ(with(support::on_threads(4)), alone);
}

/// What sampling shows: the smallest distance of the solid tool from each obstacle, at many moments and many points of
/// the tool's surface. Above the true one by at most `kCoarse`.
class SampledRun {
 public:
  static constexpr double kCoarse = 5;

  SampledRun(const Shop& shop, const std::string& program) : shop_(shop) {
    nearest_.assign(shop.scene.setup.size(), 1e9);
    running::RunOptions options;
    options.setup.home = shop.machine.home;
    bool has_tool = false;
    simulation::run_timed(program, options, shop.machine,
                          {.event =
                               [&](const timing::TimedEvent& timed) {
                                 has_tool |= std::holds_alternative<running::ToolEvent>(timed.event.what);
                               },
                           .stretch =
                               [&](const motion::Stretch& stretch, const timing::TimedEvent&) {
                                 if (has_tool) sample(stretch);
                               }});
  }
  double nearest(std::size_t obstacle) const { return nearest_[obstacle]; }

 private:
  /// Where the tip is, and the direction from it to the spindle (D28).
  std::pair<Vec3, Vec3> place(const motion::Stretch& stretch, double part) const {
    const kinematics::Kinematics& kinematics = shop_.machine.motion.kinematics;
    const motion::Sample at = stretch.at(kinematics, stretch.start + stretch.duration * part);
    if (kinematics.kind == MachineKind::ThreeAxis) return {at.tip.tip, {0, 0, 1}};
    constexpr double kDegree = std::numbers::pi / 180;
    const double b = at.tip.b * kDegree;
    const double c = at.tip.c * kDegree;
    return {at.tip.tip, {std::sin(b) * std::cos(c), std::sin(b) * std::sin(c), std::cos(b)}};
  }

  void sample(const motion::Stretch& stretch) {
    constexpr int kChords = 16;
    constexpr double kToolLength = 220;
    double travel = 0;
    for (int i = 0; i < kChords; ++i) {
      const auto [from, from_axis] = place(stretch, static_cast<double>(i) / kChords);
      const auto [to, to_axis] = place(stretch, static_cast<double>(i + 1) / kChords);
      travel += (to - from).norm() + kToolLength * (to_axis - from_axis).norm();
    }
    const int steps = std::clamp(static_cast<int>(travel / 3), 1, 1000);
    for (int i = 0; i <= steps; ++i) {
      const std::pair<Vec3, Vec3> at = place(stretch, static_cast<double>(i) / steps);
      const Vec3& tip = at.first;
      const Vec3& axis = at.second;
      const Vec3 u = axis.unitOrthogonal();
      const Vec3 v = axis.cross(u);
      const auto rim = [&](double z, double radius) {
        const int count = radius < 30 ? 24 : 48;
        for (int k = 0; k < count; ++k) {
          const double angle = 2 * std::numbers::pi * k / count;
          take(tip + z * axis + radius * (std::cos(angle) * u + std::sin(angle) * v));
        }
      };
      const auto disc = [&](double z, double radius) {
        for (double r = radius; r > 0; r -= 5) rim(z, r);
      };
      disc(0, 10);
      for (double z = 4; z < 60; z += 4) rim(z, 10);
      disc(60, 25);
      for (double z = 64; z < 100; z += 4) rim(z, 25);
      disc(100, 60);
      for (double z = 106; z < 220; z += 6) rim(z, 60);
      disc(220, 60);
    }
  }

  void take(const Vec3& point) {
    for (std::size_t i = 0; i < nearest_.size(); ++i) {
      const BodyShape& shape = shop_.scene.setup[i].shape;
      double distance = 0;
      if (const auto* const box = std::get_if<solids::Cuboid>(&shape)) {
        distance = (box->minimum - point).cwiseMax(point - box->maximum).cwiseMax(0).norm();
      } else {
        const auto& pin = std::get<solids::Cylinder>(shape);
        const double along = (point - pin.at.origin).dot(pin.at.axis);
        const double across = ((point - pin.at.origin) - along * pin.at.axis).norm();
        distance = std::hypot(std::max({0.0, -along, along - pin.height}), std::max(0.0, across - pin.radius));
      }
      nearest_[i] = std::min(nearest_[i], distance);
    }
  }

  const Shop& shop_;
  std::vector<double> nearest_;
};

class SampledScenes : public testing::TestWithParam<MachineKind> {};

TEST_P(SampledScenes, AgreeWithTheProof) {
  int touched = 0;
  int free = 0;
  for (const std::uint64_t seed : support::seeds(10)) {
    support::Random random(seed * 31 + static_cast<std::uint64_t>(GetParam()));
    Shop shop(GetParam());
    shop.scene.clearance = 30;
    for (int i = 0; i < 4; ++i) {
      const Vec3 at(random.real(-400, 400), random.real(-400, 400), random.real(-200, 100));
      if (random.one_in(2)) {
        shop.box(fmt::format("box {}", i), at, at + Vec3(random.real(5, 80), random.real(5, 80), random.real(5, 150)));
      } else {
        const Vec3 axis = Vec3(random.real(-1, 1), random.real(-1, 1), random.real(0.1, 1)).normalized();
        shop.pin(fmt::format("pin {}", i), at, axis, random.real(5, 150), random.real(3, 40));
      }
    }
    std::string program = "M06 T101001\nG49\nG00 X0 Y0 Z250\n";
    for (int i = 0; i < 5; ++i) {
      program += fmt::format("G0{} X{:.1f} Y{:.1f} Z{:.1f} B{:.1f} C{:.1f} F3000\n", random.between(0, 1),
                             random.real(-400, 400), random.real(-400, 400), random.real(0, 200), random.real(-90, 90),
                             random.real(-180, 180));
      if (random.one_in(3))
        program += fmt::format("G02 X{:.1f} Y{:.1f} R{:.1f} F3000\n", random.real(-400, 400), random.real(-400, 400),
                               random.real(600, 900));
    }
    program += "M02\n";
    const VerifiedRun run = shop.run(program);
    const SampledRun sampled(shop, program);
    for (std::size_t i = 0; i < shop.scene.setup.size(); ++i) {
      const std::string where = fmt::format("seed {} {}\n{}", seed, shop.scene.setup[i].name, program);
      double found = 1e9;
      for (const Contact& contact : run.contacts)
        if (contact.whom.in(dialect::Language::English) == shop.scene.setup[i].name)
          found = std::min(found, contact.distance);
      const double seen = sampled.nearest(i);
      if (seen <= 0) {
        EXPECT_LE(found, 0.02) << where;
      }
      if (found <= 0.02) {
        EXPECT_LE(seen, 0.02 + SampledRun::kCoarse) << where;
      }
      if (found > 0.02 && found < 29) {
        EXPECT_LE(found, seen + 0.11) << where;
        EXPECT_GE(found, seen - SampledRun::kCoarse) << where;
      }
      if (found > 29 && found < 1e8) {
        EXPECT_LE(found, 30) << where;
      }
      if (found > 1e8) {
        EXPECT_GE(seen, 30) << where;
      }
      (found <= 0.02 ? touched : free) += 1;
    }
  }
  if (support::kTriesAll) {
    EXPECT_GT(touched, 3);
    EXPECT_GT(free, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, SampledScenes,
                         testing::Values(MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table));

/// Gaps that are known by construction, to the digit: found if below the contact distance / 2, not if above it.
TEST(KnownGaps, OfTheCutterBesideABox) {
  for (const std::uint64_t seed : support::seeds(300)) {
    support::Random random(seed);
    const double gap = random.real(-0.1, 0.1);
    Shop shop;
    shop.scene.clearance = 0;
    const double y = random.real(-50, 50);
    shop.box("box", {50, y + 10 + gap, 0}, {80, y + 40, 30});
    const std::string program =
        fmt::format("M06 T101001\nG00 X0 Y{:.17g} Z50\nZ10\nG01 X{} F1000\nG00 Z50\nM02\n", y, random.between(40, 200));
    const bool is_found = !shop.run(program).contacts.empty();
    // An X that ends before the box leaves the corner of the box to the side.
    const bool passes = program.find("X40 ") == std::string::npos;
    if (gap < kContactDistance / 2 - 1e-5 && passes && program.find("G01 X4") == std::string::npos) {
      EXPECT_TRUE(is_found) << seed << " gap " << gap << "\n" << program;
    }
    if (gap > kContactDistance + 1e-5) {
      EXPECT_FALSE(is_found) << seed << " gap " << gap << "\n" << program;
    }
  }
}

/// The tool swings about its tip in a plane, up to an angle; a pin across that plane stands beyond.
TEST(KnownGaps, OfATiltingToolBeforeAPin) {
  int found = 0;
  for (const std::uint64_t seed : support::seeds(200)) {
    support::Random random(seed);
    Shop shop(MachineKind::Head);
    shop.scene.clearance = 0;
    shop.scene.nose.reset();
    shop.scene.tools[Shop::kTool].holder.reset();
    const double gap = random.real(-0.1, 0.1);
    const double end = random.real(20, 80);
    const double along = random.real(20, 40);
    const double radius = random.real(2, 5);
    constexpr double kDegree = std::numbers::pi / 180;
    const double b = end * kDegree;
    const Vec3 axis(std::sin(b), 0, std::cos(b));
    const Vec3 ahead(std::cos(b), 0, -std::sin(b));
    const Vec3 middle = along * axis + (10 + radius + gap) * ahead;
    shop.pin("pin", middle - Vec3(0, 100, 0), {0, 1, 0}, 200, radius);
    const std::string program = fmt::format("M06 T101001\nG00 X0 Y0 Z300\nG49\nG01 Z0 B{:.17g} F1000\nM02\n", -5.0);
    const std::string tilts = fmt::format("M06 T101001\nG00 X0 Y0 Z300\nZ0 B-5\nG49\nG01 B{:.17g} F1000\nM02\n", end);
    const bool is_found = !shop.run(tilts).contacts.empty();
    found += is_found ? 1 : 0;
    EXPECT_TRUE(shop.run(program).contacts.empty()) << seed;
    if (gap < kContactDistance / 2 - 1e-4) {
      EXPECT_TRUE(is_found) << seed << " gap " << gap << "\n" << tilts;
    }
    if (gap > kContactDistance + 1e-4) {
      EXPECT_FALSE(is_found) << seed << " gap " << gap << "\n" << tilts;
    }
  }
  EXPECT_GT(found, 5);
}

}  // namespace
}  // namespace isocnc::verification
