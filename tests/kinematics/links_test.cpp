#include "interpreter/kinematics/links.h"

#include <gtest/gtest.h>

#include "interpreter/geometry/frame.h"
#include "tests/support/random.h"

namespace isocnc::kinematics {
namespace {

using Eigen::Isometry3d;
using geometry::Vec3;

constexpr double kSame = 1e-9;  ///< mm

Vec3 any_offset(support::Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

Kinematics any_machine(support::Random& random, MachineKind kind) {
  return {.kind = kind,
          .pivot = random.real(0, 300),
          .b_from_c = any_offset(random, 300),
          .spindle_from_b = any_offset(random, 100),
          .b_point = any_offset(random, 500),
          .c_point = any_offset(random, 500)};
}

Coordinates any_joints(support::Random& random) {
  Coordinates joints;
  joints << any_offset(random, 2000), random.real(-180, 180), random.real(-360, 360);
  return joints;
}

/// The tip and the tool's axis in the frame of the workpiece, link by link.
struct Tool {
  Vec3 tip;
  Vec3 axis;
};

Tool tool_on_workpiece(const Kinematics& machine, const Coordinates& joints, double length) {
  const Isometry3d spindle = link_pose(machine, spindle_link(machine), joints);
  const Isometry3d place = link_pose(machine, workpiece_link(machine), joints).inverse() * spindle;
  return {place * Vec3(0, 0, -length), place.linear() * Vec3::UnitZ()};
}

class Links : public testing::TestWithParam<MachineKind> {};

TEST_P(Links, BringTheToolWhereForwardKinematicsDoes) {
  for (const std::uint64_t seed : support::seeds(400)) {
    support::Random random(seed);
    const Kinematics machine = any_machine(random, GetParam());
    const Coordinates joints = any_joints(random);
    const double length = random.real(0, 200);
    const Tool tool = tool_on_workpiece(machine, joints, length);
    EXPECT_LT((tool.tip - forward(machine, joints, length).head<3>()).norm(), kSame) << seed;
    const Vec3 axis = GetParam() == MachineKind::ThreeAxis
                          ? Vec3(Vec3::UnitZ())
                          : Vec3(geometry::axes_from_angles(joints[kB], joints[kC]).col(2));
    EXPECT_LT((tool.axis - axis).norm(), kSame) << seed;
  }
}

TEST_P(Links, BringTheTipWhereInverseKinematicsWantsIt) {
  for (const std::uint64_t seed : support::seeds(400)) {
    support::Random random(seed);
    const Kinematics machine = any_machine(random, GetParam());
    const Coordinates tip = any_joints(random);
    const double length = random.real(0, 200);
    const Tool tool = tool_on_workpiece(machine, inverse(machine, tip, length), length);
    EXPECT_LT((tool.tip - tip.head<3>()).norm(), kSame) << seed;
  }
}

TEST_P(Links, AreAtTheirPlacesWithAllJointsAtZero) {
  support::Random random(1);
  const Kinematics machine = any_machine(random, GetParam());
  for (const Link link : {Link::Machine, Link::X, Link::Y, Link::Z, Link::C, Link::B})
    EXPECT_LT((link_pose(machine, link, Coordinates::Zero()).matrix() - Isometry3d::Identity().matrix()).norm(), kSame);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, Links,
                         testing::Values(MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table));

TEST(LinkPoses, LinearOnesFollowTheJointsThatCarryThem) {
  Coordinates joints;
  joints << 1, 2, 3, 40, 50;
  for (const MachineKind kind : {MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table}) {
    support::Random random(1);
    const Kinematics machine = any_machine(random, kind);
    const auto place = [&](Link link) { return Vec3(link_pose(machine, link, joints) * Vec3(10, 20, 30)); };
    EXPECT_EQ(place(Link::Machine), Vec3(10, 20, 30));
    EXPECT_EQ(place(Link::X), Vec3(11, 20, 30));
    EXPECT_EQ(place(Link::Y), Vec3(11, 22, 30));
    EXPECT_EQ(place(Link::Z), Vec3(11, 22, 33));
  }
}

/// A head's C link turns with C alone, and its C axis keeps its place whatever C and B are. A table's B link is the
/// cradle, on which the C axis rests.
TEST(LinkPoses, KeepTheAxesThatTurnThem) {
  for (const std::uint64_t seed : support::seeds(100)) {
    support::Random random(seed);
    const Kinematics head = any_machine(random, MachineKind::Head);
    Coordinates joints = any_joints(random);
    const Vec3 b_axis = Vec3(0, 0, head.pivot) - head.spindle_from_b;
    const Vec3 c_axis = b_axis - head.b_from_c;
    const Isometry3d turned = link_pose(head, Link::C, joints);
    EXPECT_LT((turned * c_axis - (c_axis + joints.head<3>())).norm(), kSame) << seed;
    EXPECT_LT((turned * b_axis - link_pose(head, Link::B, joints) * b_axis).norm(), kSame) << seed;
    joints[kB] += 30;
    EXPECT_LT((link_pose(head, Link::C, joints).matrix() - turned.matrix()).norm(), kSame) << seed;

    const Kinematics table = any_machine(random, MachineKind::Table);
    const Isometry3d cradle = link_pose(table, Link::B, joints);
    EXPECT_LT((cradle * table.b_point - table.b_point).norm(), kSame) << seed;
    EXPECT_LT((cradle * table.c_point - link_pose(table, Link::C, joints) * table.c_point).norm(), kSame) << seed;
    joints[kC] += 30;
    EXPECT_LT((link_pose(table, Link::B, joints).matrix() - cradle.matrix()).norm(), kSame) << seed;
  }
}

}  // namespace
}  // namespace isocnc::kinematics
