#include "interpreter/verification/surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "interpreter/motion/planner.h"
#include "tests/support/random.h"
#include "tests/verification/scenes.h"

namespace isocnc::verification {
namespace {

using dialect::Language;
using geometry::Vec3;
using kinematics::Coordinates;
using kinematics::MachineKind;

BodyPairs bodies_of(const Shop& shop) {
  const MountedTool tool{.bodies = &shop.scene.tools.at(Shop::kTool), .name = "T101001", .length = 100};
  return pairs_of(shop.scene, shop.machine.motion.kinematics, tool, Vec3::Zero());
}

/// Joints of a machine of three axes with the tip of T101001 at a place.
Coordinates joints_of(const Vec3& tip) {
  Coordinates joints = Coordinates::Zero();
  joints.head<3>() = tip + Vec3(0, 0, 100);
  return joints;
}

TEST(Surroundings, ListsTheNearestPartOfEachObstacleNearestFirst) {
  Shop shop;
  shop.box("clamp 1", {100, -20, 0}, {140, 20, 30});
  shop.box("wall", {-300, -500, 0}, {-45, 500, 200});
  // The cutter's edge is at X10: 90 mm from the clamp. The nose has a radius of 60 and starts 100 above the tip.
  const auto found = neighbors_at(bodies_of(shop), shop.machine.motion.kinematics, joints_of({0, 0, 10}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].whom.in(Language::English), "wall");
  EXPECT_EQ(found[0].who.in(Language::English), "the spindle nose");
  EXPECT_NEAR(found[0].distance, -15, 1e-5);
  EXPECT_TRUE(found[0].is_contact());
  EXPECT_EQ(found[1].whom.in(Language::English), "clamp 1");
  EXPECT_EQ(found[1].who.in(Language::Italian), "il portautensile di T101001");
  // The holder, 60 above the tip with a radius of 25: beside it by 75, above it by 40.
  EXPECT_NEAR(found[1].distance, std::hypot(75, 40), 1e-5);
  EXPECT_NEAR(found[1].clearance, found[1].distance, 1e-9);
  EXPECT_NEAR(found[1].point.x(), 100, 1e-5);
  EXPECT_NEAR(found[1].point.z(), 30, 1e-5);
  EXPECT_FALSE(found[1].is_contact());
}

/// A cut as deep into the board as is allowed is no contact, in a verification or here.
TEST(Surroundings, CutterMayReachTheAllowedDepthOfTheSpoilboard) {
  Shop shop;
  shop.scene.nose.reset();
  shop.box("", {-500, -500, -50}, {500, 500, 0}, BodyRole::Spoilboard);
  const auto found = [&](double z) {
    return neighbors_at(bodies_of(shop), shop.machine.motion.kinematics, joints_of({0, 0, z}))[0];
  };
  EXPECT_FALSE(found(0).is_contact());
  EXPECT_NEAR(found(0).distance, 0, 1e-9);
  EXPECT_TRUE(found(-0.05).is_contact());
}

TEST(Surroundings, CutterMayComeNearThePartAndTheSpoilboard) {
  Shop shop;
  shop.scene.nose.reset();
  shop.box("", {-500, -500, -50}, {500, 500, 0}, BodyRole::Spoilboard);
  shop.box("", {-50, -50, 0}, {50, 50, 3}, BodyRole::Target);
  const auto found = neighbors_at(bodies_of(shop), shop.machine.motion.kinematics, joints_of({0, 0, 5}));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].role, BodyRole::Target);
  EXPECT_NEAR(found[0].distance, 2, 1e-5);
  EXPECT_TRUE(std::isinf(found[0].clearance));
  EXPECT_NEAR(found[1].distance, 5, 1e-5);
  EXPECT_NEAR(found[1].clearance, 65, 1e-5);  // The holder.
}

TEST(Surroundings, AlongAMotionIsTheSmallestDistance) {
  Shop shop;
  shop.scene.nose.reset();
  shop.box("clamp 1", {100, 30, 0}, {140, 60, 30});
  shop.box("far", {100, 5000, 0}, {140, 5060, 30});
  const kinematics::Move move{.from = {.tip = {0, 0, 10}}, .to = {.tip = {300, 0, 10}}, .tool_length = 100};
  const auto found = neighbors_along(bodies_of(shop), shop.machine.motion, move, 500);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 20, 0.1);
}

/// The smallest distance along a motion is that of the nearest of many poses on it, within what lies between them.
TEST(Surroundings, AlongAMotionAgreesWithManyPoses) {
  for (const MachineKind kind : {MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table}) {
    support::Random random(7);
    Shop shop(kind);
    shop.box("block", {100, -20, 0}, {140, 20, 30});
    shop.pin("pin", {-80, 40, 0}, {0, 0, 1}, 60, 12);
    const BodyPairs bodies = bodies_of(shop);
    const bool turns = kind != MachineKind::ThreeAxis;
    for (int i = 0; i < 20; ++i) {
      const auto pose = [&] {
        return geometry::Pose{{random.real(-200, 200), random.real(-150, 150), random.real(0, 120)},
                              turns ? random.real(-60, 60) : 0,
                              turns ? random.real(-170, 170) : 0};
      };
      kinematics::Move move{.from = pose(), .to = pose(), .tool_length = 100};
      motion::Planner planner(shop.machine.motion);
      planner.push(move);
      planner.rest();
      std::map<std::uint32_t, double> sampled;
      while (const motion::Stretch* const stretch = planner.next()) {
        constexpr int kPoses = 200;
        for (int k = 0; k <= kPoses; ++k) {
          const auto at = stretch->at(shop.machine.motion.kinematics, stretch->start + stretch->duration * k / kPoses);
          for (const Neighbor& each : neighbors_at(bodies, shop.machine.motion.kinematics, at.joints)) {
            const auto known = sampled.try_emplace(each.whom.number, each.distance).first;
            known->second = std::min(known->second, each.distance);
          }
        }
      }
      for (const Neighbor& each : neighbors_along(bodies, shop.machine.motion, move, 1e4)) {
        const double nearest = sampled.at(each.whom.number);
        if (nearest > 0) {
          EXPECT_NEAR(each.distance, nearest, 1.5) << i;
          EXPECT_LE(each.distance, nearest + 0.11) << i;
        } else {
          EXPECT_LE(each.distance, 0.02) << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace isocnc::verification
