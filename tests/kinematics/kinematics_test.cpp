#include "interpreter/kinematics/kinematics.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "interpreter/geometry/frame.h"
#include "tests/support/random.h"

namespace isocnc::kinematics {
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

/// Turns counterclockwise about an axis, seen from its positive end.
Vec3 rotated(const Vec3& vector, const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis) * vector;
}

/// A head as docs/machine.md describes it, link by link from the joints down to the tip.
Vec3 tip_of_head(const Kinematics& head, const Coordinates& joints, double tool_length) {
  const auto as_turned = [&](const Vec3& beyond_b) {
    return rotated(rotated(beyond_b, Vec3::UnitY(), joints[kB]), Vec3::UnitZ(), joints[kC]);
  };
  const Vec3 nose_from_b = head.spindle_from_b + Vec3(0, 0, -head.pivot);
  // X, Y and Z say where the nose would be with B = C = 0; B and C do not move the C axis.
  const Vec3 c_axis = joints.head<3>() - nose_from_b - head.b_from_c;
  const Vec3 b_axis = c_axis + rotated(head.b_from_c, Vec3::UnitZ(), joints[kC]);
  const Vec3 nose = b_axis + as_turned(nose_from_b);
  return nose + as_turned(Vec3(0, 0, -tool_length));
}

/// A table as docs/machine.md describes it: the place on the workpiece, as it lies with B = C = 0, that a tool reaches.
/// The table turns the other way than a head, C first: B carries the C axis.
Vec3 tip_at_table(const Kinematics& table, const Coordinates& joints, double tool_length) {
  const Vec3 in_machine = joints.head<3>() - Vec3(0, 0, tool_length);
  const Vec3 untilted = table.b_point + rotated(in_machine - table.b_point, Vec3::UnitY(), joints[kB]);
  return table.c_point + rotated(untilted - table.c_point, Vec3::UnitZ(), joints[kC]);
}

class RandomKinematics {
 public:
  explicit RandomKinematics(std::uint64_t seed) : random_(seed) {}

  Vec3 offset(double maximum) { return {real(maximum), real(maximum), real(maximum)}; }
  Kinematics head() {
    return {.kind = MachineKind::Head,
            .pivot = random_.real(0, 300),
            .b_from_c = offset(300),
            .spindle_from_b = offset(100)};
  }
  Kinematics table() { return {.kind = MachineKind::Table, .b_point = offset(500), .c_point = offset(500)}; }
  Coordinates pose() {
    const Vec3 place = offset(2000);
    return at(place.x(), place.y(), place.z(), real(180), real(360));
  }
  double tool_length() { return random_.real(0, 200); }

 private:
  double real(double maximum) { return random_.real(-maximum, maximum); }

  support::Random random_;
};

/// The example of docs/machine.md.
TEST(Kinematics, AHeadIsEnteredAsItIsMeasured) {
  const Kinematics kinematics{
      .kind = MachineKind::Head, .pivot = 100, .b_from_c = {20, 0, 0}, .spindle_from_b = {0, 7, 0}};
  EXPECT_LT((inverse(kinematics, at(0, 0, 0, 0, 90), 50) - at(27, -13, 50, 0, 90)).norm(), 1e-9);
  EXPECT_LT((inverse(kinematics, at(0, 0, 0, 0, 0), 50) - at(0, 0, 50, 0, 0)).norm(), 1e-9);
}

TEST(Kinematics, HeadsAreWhatIsDescribed) {
  for (const std::uint64_t seed : support::seeds(400)) {
    RandomKinematics random(seed);
    const Kinematics head = random.head();
    const Coordinates joints = random.pose();
    const double length = random.tool_length();
    Coordinates tip = joints;
    tip.head<3>() = tip_of_head(head, joints, length);
    EXPECT_LT((forward(head, joints, length) - tip).norm(), 1e-9) << seed;
    EXPECT_LT((inverse(head, tip, length) - joints).norm(), 1e-9) << seed;
  }
}

TEST(Kinematics, TablesAreWhatIsDescribed) {
  for (const std::uint64_t seed : support::seeds(400)) {
    RandomKinematics random(seed);
    const Kinematics table = random.table();
    const Coordinates joints = random.pose();
    const double length = random.tool_length();
    Coordinates tip = joints;
    tip.head<3>() = tip_at_table(table, joints, length);
    EXPECT_LT((forward(table, joints, length) - tip).norm(), 1e-9) << seed;
    EXPECT_LT((inverse(table, tip, length) - joints).norm(), 1e-9) << seed;
  }
}

/// docs/machine.md: the C axis is a vertical line, the B axis one along Y, and it does not matter where on them.
TEST(Kinematics, HeadsHaveLinesForAxes) {
  for (const std::uint64_t seed : support::seeds(100)) {
    RandomKinematics random(seed);
    const Kinematics head = random.head();
    const Coordinates tip = random.pose();
    Kinematics other = head;
    other.b_from_c.z() += 30;
    other.b_from_c.y() += 11;
    other.spindle_from_b.y() -= 11;
    other.spindle_from_b.z() += 5;
    other.pivot += 5;
    EXPECT_LT((inverse(head, tip, 80) - inverse(other, tip, 80)).norm(), 1e-9) << seed;
  }
}

/// While the tip rests, a radian of B or C moves no linear joint by more than the lever.
TEST(Kinematics, TheLeverBoundsWhatTurningMoves) {
  constexpr double kStep = 1e-3;
  double fullest = 0;
  for (const std::uint64_t seed : support::seeds(400)) {
    RandomKinematics random(seed);
    const Coordinates tip = random.pose();
    const double length = random.tool_length();
    for (const Kinematics& kinematics : {random.head(), random.table()}) {
      for (const MachineAxis axis : {kB, kC}) {
        Coordinates more = tip;
        more[axis] += kStep;
        const Vec3 moved = (inverse(kinematics, more, length) - inverse(kinematics, tip, length)).head<3>();
        const double by_radian = moved.norm() / (kStep * std::numbers::pi / 180);
        const double maximum = lever(kinematics, tip.head<3>(), length);
        EXPECT_LE(by_radian, maximum * (1 + 1e-6)) << seed << " axis " << axis;
        if (kinematics.kind == MachineKind::Head) fullest = std::max(fullest, by_radian / maximum);
      }
    }
  }
  if (support::kTriesAll) {
    EXPECT_GT(fullest, 0.95) << "a bound that is never reached may be a wrong one";
  }
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
}  // namespace isocnc::kinematics
