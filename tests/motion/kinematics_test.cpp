#include "interpreter/motion/kinematics.h"

#include <gtest/gtest.h>

#include <random>

#include "interpreter/geometry/frame.h"

namespace isocnc::motion {
namespace {

using geometry::Vec3;

Kinematics head() {
  return {.kind = MachineKind::Head, .pivot = 180, .b_from_c = {12, -7, -30}, .spindle_from_b = {3, 5, -20}};
}

Kinematics table() { return {.kind = MachineKind::Table, .b_point = {100, 50, 20}, .c_point = {110, 45, 60}}; }

Coordinates at(double x, double y, double z, double b, double c) {
  Coordinates result;
  result << x, y, z, b, c;
  return result;
}

/// Over the whole range of B and C, ends, quarter turns and the singular B = 0 included.
template <typename Check>
void for_poses(Check&& check) {
  for (const double b : {-120.0, -90.0, -37.3, -1e-9, 0.0, 1e-9, 12.7, 90.0, 119.9, 180.0})
    for (const double c : {-360.0, -270.0, -123.4, -1e-9, 0.0, 45.0, 90.0, 359.9, 360.0})
      for (const Vec3& tip : {Vec3(0, 0, 0), Vec3(3200, 1600, 500), Vec3(-17.5, 812.25, -40)})
        check(at(tip.x(), tip.y(), tip.z(), b, c));
}

TEST(Kinematics, ForwardUndoesInverse) {
  for (const Kinematics& kinematics : {Kinematics{}, head(), table()}) {
    for_poses([&](const Coordinates& tip) {
      const Coordinates joints = inverse(kinematics, tip, 83.5);
      EXPECT_LT((forward(kinematics, joints, 83.5) - tip).cwiseAbs().maxCoeff(), 1e-9) << tip.transpose();
      EXPECT_LT((inverse(kinematics, forward(kinematics, tip, 83.5), 83.5) - tip).cwiseAbs().maxCoeff(), 1e-9);
    });
  }
}

TEST(Kinematics, UprightToolsStandAboveTheirTip) {
  for (const Kinematics& kinematics : {Kinematics{}, head(), table()})
    EXPECT_LT((inverse(kinematics, at(1, 2, 3, 0, 0), 80) - at(1, 2, 83, 0, 0)).norm(), 1e-12);
}

/// B90: the tool lies along +X, its tip towards -X; the nose is a pivot and a tool further in X, and a pivot lower than
/// upright.
TEST(Kinematics, ATiltedHeadReachesOverThePivot) {
  const Kinematics kinematics{.kind = MachineKind::Head, .pivot = 180};
  EXPECT_LT((inverse(kinematics, at(0, 0, 0, 90, 0), 80) - at(260, 0, -180, 90, 0)).norm(), 1e-9);
  EXPECT_LT((inverse(kinematics, at(0, 0, 0, 90, 90), 80) - at(0, 260, -180, 90, 90)).norm(), 1e-9);
}

/// A longer tool moves the nose back along its axis, which is that of G29's frame.
TEST(Kinematics, TheToolPointsAlongTheFaceNormal) {
  for_poses([&](const Coordinates& tip) {
    const Vec3 back = (inverse(head(), tip, 101) - inverse(head(), tip, 100)).head<3>();
    EXPECT_LT((back - geometry::axes_from_angles(tip[kB], tip[kC]).col(2)).norm(), 1e-9);
  });
}

/// The table turns what is normal to the face up to the tool: a point further out along it is higher by as much.
TEST(Kinematics, TheTableTurnsTheFaceUp) {
  for_poses([&](const Coordinates& tip) {
    Coordinates out = tip;
    out.head<3>() += geometry::axes_from_angles(tip[kB], tip[kC]).col(2);
    const Vec3 rise = (inverse(table(), out, 80) - inverse(table(), tip, 80)).head<3>();
    EXPECT_LT((rise - Vec3::UnitZ()).norm(), 1e-9);
  });
}

TEST(Kinematics, TheTableKeepsItsAxes) {
  const Coordinates on_b = at(100, 777, 20, 0, 0);
  Coordinates tilted = on_b;
  tilted[kB] = 63;
  EXPECT_LT((inverse(table(), on_b, 0) - inverse(table(), tilted, 0)).head<3>().norm(), 1e-9);
  const Coordinates on_c = at(110, 45, -99, 0, 0);
  Coordinates turned = on_c;
  turned[kC] = -212;
  EXPECT_LT((inverse(table(), on_c, 0) - inverse(table(), turned, 0)).head<3>().norm(), 1e-9);
}

/// Derivatives against differences, of values and of first derivatives.
TEST(Kinematics, JetsAreDerivatives) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<> between(-1, 1);
  const auto coordinates = [&](double size) {
    return Coordinates(size * at(between(random), between(random), between(random), between(random), between(random)));
  };
  for (const Kinematics& kinematics : {Kinematics{}, head(), table()}) {
    for (int i = 0; i < 100; ++i) {
      const Coordinates c[] = {coordinates(200), coordinates(2), coordinates(1)};
      const auto path = [&](double s) { return Jet{c[0] + s * c[1] + s * s * c[2], c[1] + 2 * s * c[2], 2 * c[2]}; };
      for (const auto& map : {+[](const Kinematics&k, const Jet&jet) { return inverse(k, jet, 80); },
                              +[](const Kinematics&k, const Jet&jet) { return forward(k, jet, 80); }}) {
        constexpr double kStep = 1e-4;
        const Jet a = map(kinematics, path(-kStep));
        const Jet b = map(kinematics, path(0));
        const Jet d = map(kinematics, path(kStep));
        EXPECT_LT(((d.value - a.value) / (2 * kStep) - b.first).norm(), 1e-5);
        EXPECT_LT(((d.first - a.first) / (2 * kStep) - b.second).norm(), 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace isocnc::motion
