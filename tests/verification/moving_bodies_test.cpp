#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "interpreter/simulation/timed_run.h"
#include "interpreter/verification/body_pairs.h"
#include "tests/support/random.h"
#include "tests/verification/scenes.h"

/// Bodies of the machine on its links, and of the setup on a table that turns, as they move.
namespace isocnc::verification {
namespace {

using geometry::Vec3;
using kinematics::MachineKind;

constexpr double kDegrees = 180 / std::numbers::pi;

SceneBody& on_machine(Shop& shop, std::string name, Link on, BodyShape shape) {
  return shop.scene.machine.emplace_back(
      SceneBody{.name = std::move(name), .role = BodyRole::Machine, .on = on, .shape = std::move(shape)});
}

/// The contacts as text: code, the bodies.
std::string hits(const VerifiedRun& run) {
  std::string text;
  for (const Contact& contact : run.contacts)
    text += fmt::format("{} {} | {}\n", dialect::definition(contact.id).code,
                        contact.who.in(dialect::Language::English), contact.whom.in(dialect::Language::English));
  return text;
}

/// The joints at a moment of the run.
kinematics::Coordinates joints_at(const Shop& shop, const std::string& program, double time) {
  running::RunOptions options;
  options.setup.home = shop.machine.home;
  kinematics::Coordinates joints = kinematics::Coordinates::Zero();
  simulation::run_timed(program, options, shop.machine,
                        {.event = {}, .stretch = [&](const motion::Stretch& stretch, const timing::TimedEvent&) {
                           if (stretch.start <= time) joints = stretch.at(shop.machine.motion.kinematics, time).joints;
                         }});
  return joints;
}

/// An arm along +X, 40 wide, on the C axis, meets a pin of radius 10 at 60 degrees, 200 from the axis.
TEST(MovingBodies, ArmOfAHeadSwingsIntoAPin) {
  const double angle = 60 / kDegrees;
  const solids::Cuboid arm{{0, -20, 200}, {300, 20, 300}};
  const std::string program = "M06 T101001\nG00 X0 Y0 Z0\nG49\nG01 C90 F1000\nM02\n";
  for (const BodyShape& shape : {BodyShape(arm), BodyShape(mesh_of(arm))}) {
    Shop shop(MachineKind::Head);
    shop.scene.clearance = 0;
    on_machine(shop, "arm", Link::C, shape);
    shop.pin("pin", {200 * std::cos(angle), 200 * std::sin(angle), 0}, {0, 0, 1}, 350, 10);
    const VerifiedRun run = shop.run(program);
    EXPECT_EQ(hits(run), "E152 arm | pin\n");
    ASSERT_EQ(run.contacts.size(), 1u);
    // The pin's axis is then 20 + 10 from the middle of the arm. The contact distance is 0.02 mm at most.
    const double touch = 60 - std::asin(30.0 / 200) * kDegrees;
    EXPECT_NEAR(joints_at(shop, program, run.contacts[0].time)[kinematics::kC], touch, 0.021 / 190 * kDegrees);
    const double last = 60 + std::asin(30.0 / 200) * kDegrees;
    EXPECT_NEAR(joints_at(shop, program, run.contacts[0].end_time)[kinematics::kC], last, 0.021 / 190 * kDegrees);
    EXPECT_TRUE(run.certificate->gaps.empty());
  }
}

TEST(MovingBodies, GantryMeetsAPost) {
  for (const MachineKind kind : {MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table}) {
    Shop shop(kind);
    on_machine(shop, "gantry", Link::X, solids::Cuboid{{-20, -100, 50}, {20, 100, 150}});
    on_machine(shop, "post", Link::Machine, solids::Cuboid{{500, 50, 0}, {540, 90, 400}});
    const std::string program = "M06 T101001\nG00 X0 Y0 Z600\nX470\nY500\nY-500\nX479.9\nG01 X490 F1000\nM02\n";
    const VerifiedRun run = shop.run(program);
    EXPECT_EQ(hits(run), "E153 gantry | post\n");
    ASSERT_EQ(run.contacts.size(), 1u);
    EXPECT_EQ(run.contacts[0].line, 6u);
    EXPECT_NEAR(run.contacts[0].distance, -10, 1e-3);
    EXPECT_NEAR(joints_at(shop, program, run.contacts[0].time)[kinematics::kX], 480, 0.021);
  }
}

/// A gantry is as near to its rails as it is made to be. What it only passes near elsewhere is told.
TEST(MovingBodies, GantryPassesNearAPost) {
  Shop shop;
  on_machine(shop, "gantry", Link::X, solids::Cuboid{{-20, -100, 50}, {20, 100, 150}});
  on_machine(shop, "rail", Link::Machine, solids::Cuboid{{-500, -100, 20}, {1000, 100, 49}});
  on_machine(shop, "post", Link::Machine, solids::Cuboid{{500, 50, 60}, {540, 90, 400}});
  EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z600\nX478.5\nX0\nM02\n")), "W154 gantry | post\n");
  EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z600\nX477.9\nX0\nM02\n")), "");
}

/// What moves with the spindle is not compared with itself.
TEST(MovingBodies, OfOneChainAreNotCompared) {
  for (const MachineKind kind : {MachineKind::ThreeAxis, MachineKind::Head}) {
    Shop shop(kind);
    shop.scene.nose.reset();
    for (const Link link : {Link::X, Link::Y, Link::Z, Link::C, Link::B})
      on_machine(shop, "body", link, solids::Cuboid{{480, -20, 100}, {520, 20, 200}});
    EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z60\nX100 Y20 Z80\nM02\n")), "");
  }
}

/// The lower edge of a plate on the cradle, 300 beside the B axis and 10 below, tilts onto a column, 150 below.
TEST(MovingBodies, CradleTiltsIntoAColumn) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.machine.motion.kinematics.c_point = {0, 0, -80};
  on_machine(shop, "plate", Link::B, solids::Cuboid{{-300, -200, -60}, {300, 200, -50}});
  on_machine(shop, "column", Link::Machine, solids::Cuboid{{250, -20, -400}, {400, 20, -200}});
  const std::string program = "M06 T101001\nG00 X0 Y0 Z60\nG49\nG01 B-60 F1000\nM02\n";
  const VerifiedRun run = shop.run(program);
  EXPECT_EQ(hits(run), "E153 plate | column\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  const double touch = (std::asin(150 / std::hypot(300, 10)) - std::atan2(10, 300)) * kDegrees;
  EXPECT_NEAR(joints_at(shop, program, run.contacts[0].time)[kinematics::kB], -touch, 0.021 / 290 * kDegrees);
  EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z60\nG49\nG01 B60 F1000\nM02\n")), "");
}

/// A clamp on a round table is carried around into a column; the spindle's slide meets the clamp as well.
TEST(MovingBodies, TableCarriesTheSetup) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.box("clamp", {250, -20, 0}, {300, 20, 60});
  on_machine(shop, "column", Link::Machine, solids::Cuboid{{-20, 290, 0}, {20, 400, 60}});
  const std::string turns = "M06 T101001\nG00 X0 Y0 Z200\nG49\nG01 C-90 F1000\nM02\n";
  EXPECT_EQ(hits(shop.run(turns)), "E153 clamp | column\n");
  EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z200\nG49\nG01 C-80 F1000\nC80\nM02\n")), "");
  shop.scene.machine.clear();
  on_machine(shop, "slide", Link::Z, solids::Cuboid{{-50, 200, -50}, {50, 300, 200}});
  EXPECT_EQ(hits(shop.run("M06 T101001\nG00 X0 Y0 Z200\nG49\nG01 C-90 F1000\nZ0\nM02\n")), "E152 slide | clamp\n");
}

/// A clamp that C carries comes around into the wall of the cradle: first its side meets the wall's edge, 158.1 from
/// the axis, and then its corners, 161.2 from the axis, go through the wall's face at 150.
TEST(MovingBodies, TableTurnsTheSetupIntoItsCradle) {
  for (const Link carrier : {Link::B, Link::Machine}) {
    Shop shop(MachineKind::Table);
    shop.scene.clearance = 0;
    shop.box("clamp", {-160, -20, 10}, {-120, 20, 60});
    on_machine(shop, "wall", carrier, solids::Cuboid{{150, -50, 0}, {170, 50, 100}});
    const std::string program = "M06 T101001\nG00 X0 Y0 Z200\nG49\nG01 C180 F1000\nM02\n";
    const VerifiedRun run = shop.run(program);
    EXPECT_EQ(hits(run), "E153 clamp | wall\n");
    ASSERT_EQ(run.contacts.size(), 1u);
    EXPECT_NEAR(run.contacts[0].distance, 150 - std::hypot(160, 20), 0.021);
    const double touch = 180 - (std::atan2(50, 150) + std::asin(20 / std::hypot(150, 50))) * kDegrees;
    EXPECT_NEAR(std::abs(joints_at(shop, program, run.contacts[0].time)[kinematics::kC]), touch, 0.021 / 50 * kDegrees);
    shop.scene.machine.clear();
    on_machine(shop, "wall", carrier, solids::Cuboid{{161.3, -50, 0}, {170, 50, 100}});
    EXPECT_EQ(hits(shop.run(program)), "");
  }
}

/// An arm swings over a pin at a gap that is known by construction, with each shape that it can have.
TEST(MovingBodies, KnownGapsAreFoundToTheDigit) {
  for (const std::uint64_t seed : support::seeds(200)) {
    support::Random random(seed);
    Shop shop(MachineKind::Head);
    shop.scene.clearance = 0;
    const double gap = random.real(-0.1, 0.1);
    const double z = random.real(0, 50);
    const double height = random.real(5, 60);
    const solids::Cuboid arm{{0, -20, 200}, {300, 20, 200 + height}};
    const solids::Cylinder bar{.at = {{0, 0, 200 + height}, {1, 0, 0}}, .height = 300, .radius = height};
    const BodyShape shapes[] = {arm, bar, mesh_of(arm)};
    on_machine(shop, "arm", random.one_in(2) ? Link::C : Link::B, shapes[random.below(3)]);
    const double angle = random.real(20, 70) / kDegrees;
    const double radius = random.real(100, 280);
    const Vec3 foot(radius * std::cos(angle), radius * std::sin(angle), 0);
    const double top = z + 100 + 200 - gap;
    if (random.one_in(2)) {
      shop.pin("pin", foot, {0, 0, 1}, top, random.real(1, 10));
    } else {
      const solids::Cuboid post{foot - Vec3(5, 5, 0), foot + Vec3(5, 5, top)};
      shop.box("post", post.minimum, post.maximum).shape = random.one_in(2) ? BodyShape(post) : mesh_of(post);
    }
    const std::string program = fmt::format("M06 T101001\nG00 X0 Y0 Z{:.17g}\nG49\nG01 C90 F1000\nM02\n", z);
    const bool is_found = !shop.run(program).contacts.empty();
    if (gap < kContactDistance / 2 - 1e-5) {
      EXPECT_TRUE(is_found) << seed << " gap " << gap;
    }
    if (gap > kContactDistance + 1e-5) {
      EXPECT_FALSE(is_found) << seed << " gap " << gap;
    }
  }
}

/// A path of the tip or of the joints: a line, a parabola, or a circle.
kinematics::Path any_path(support::Random& random, double tool_length) {
  const auto any = [&](double size, double turn) {
    kinematics::Coordinates result;
    for (int i = 0; i < 5; ++i) result[i] = random.real(-1, 1) * (i < 3 ? size : turn);
    return result;
  };
  kinematics::Path path = kinematics::Path::line(any(500, 180), any(1, random.one_in(3) ? 0 : 2));
  if (random.one_in(3)) path.c[2] = any(0.05, 0.05);
  if (random.one_in(3)) {
    path.kind = kinematics::PathKind::Circle;
    path.c[1] = any(100, 0);
    path.c[2] = any(100, 0);
    path.c[3] = any(1, 1);
    path.omega = random.real(-0.02, 0.02);
  }
  path.is_of_joints = random.one_in(2);
  path.tool_length = tool_length;
  return path;
}

class SpeedBounds : public testing::TestWithParam<MachineKind> {};

/// The corners of a body, seen from the link of an obstacle, never move faster than the pair's bound, which some of
/// them reach.
TEST_P(SpeedBounds, HoldForBodiesOnEveryLink) {
  double fullest = 0;
  std::size_t compared = 0;
  for (const std::uint64_t seed : support::seeds(300)) {
    support::Random random(seed);
    const auto any_point = [&](double size) {
      return Vec3(random.real(-size, size), random.real(-size, size), random.real(-size, size));
    };
    kinematics::Kinematics machine{.kind = GetParam()};
    machine.pivot = random.real(0, 300);
    machine.b_from_c = any_point(200);
    machine.spindle_from_b = any_point(100);
    machine.b_point = any_point(400);
    machine.c_point = any_point(400);
    Scene scene;
    for (const Link link : {Link::Machine, Link::X, Link::Y, Link::Z, Link::C, Link::B}) {
      const Vec3 corner = any_point(500);
      scene.machine.push_back({.name = "body",
                               .role = BodyRole::Machine,
                               .on = link,
                               .shape = solids::Cuboid{corner, corner + Vec3(10, 100, 5)}});
    }
    scene.setup.push_back({.name = "clamp", .shape = solids::Cuboid{{100, 0, 0}, {200, 30, 40}}});
    const MountedTool tool{.bodies = nullptr, .name = "T1", .length = random.real(0, 200)};
    kinematics::Path path = any_path(random, tool.length);
    if (random.one_in(3)) {
      // The nose turns about the axes of the table, close to them, while other links are far from both.
      machine.c_point = machine.b_point + any_point(10);
      path = kinematics::Path::line(path.c[0], any_path(random, 0).c[1]);
      path.c[0].head<3>() = machine.b_point + any_point(10);
      path.c[1].head<3>() *= 0.01;
      path.is_of_joints = true;
      path.tool_length = tool.length;
    }
    const BodyPairs pairs = pairs_of(scene, machine, tool, any_point(300));
    const double from = random.real(-50, 0);
    const double to = random.real(0, 50);
    const MotionBounds bounds = motion_bounds(machine, path, from, to);
    for (const BodyPair& pair : pairs.pairs) {
      const MovingPart& part = pairs.parts[pair.part];
      const Obstacle& obstacle = pairs.obstacles[pair.obstacle];
      ASSERT_NE(part.body, obstacle.body);
      const solids::Cuboid& box = std::get<solids::Cuboid>(part.body->shape);
      ++compared;
      for (int i = 0; i < 20; ++i) {
        constexpr double kStep = 1e-5;
        const double s = random.real(from, to - kStep);
        for (const Vec3& corner : {box.minimum, box.maximum}) {
          const auto at = [&](double where) {
            const kinematics::Coordinates joints = path.joints_at(machine, where).value;
            return Vec3(link_pose(machine, obstacle.on, joints).inverse() * link_pose(machine, part.on, joints) *
                        Vec3(corner + part.shift));
          };
          const double speed = (at(s + kStep) - at(s)).norm() / kStep;
          const double bound = pair.speed(bounds);
          ASSERT_LE(speed, bound * (1 + 1e-6) + 1e-6)
              << seed << " part on " << static_cast<int>(part.on) << " obstacle on " << static_cast<int>(obstacle.on);
          if (bound > 0) fullest = std::max(fullest, speed / bound);
        }
      }
    }
  }
  if (support::kTriesAll) {
    EXPECT_GT(compared, 1000u);
    EXPECT_GT(fullest, 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, SpeedBounds,
                         testing::Values(MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table));

}  // namespace
}  // namespace isocnc::verification
