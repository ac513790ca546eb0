#include "interpreter/motion/planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/geometry/frame.h"
#include "tests/motion/programs.h"
#include "tests/support/random.h"

namespace isocnc::motion {
namespace {

using geometry::Vec3;

const Vec3 kOrigin = Vec3::Zero();

double time_of(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves) {
  return cycle_time(plan(machine, moves));
}

/// From rest to rest over `length` with speed v and acceleration a.
double trapezoid(double length, double v, double a) {
  return v * v / a <= length ? length / v + v / a : 2 * std::sqrt(length / a);
}

TEST(Planner, OneMoveIsATrapezoid) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  const auto stretches = plan(machine, {line(kOrigin, {100, 0, 0}, speed(100))});
  ASSERT_EQ(stretches.size(), 1U);
  EXPECT_NEAR(cycle_time(stretches), 1 + 0.05, 1e-12);
  ASSERT_EQ(stretches[0].phase_count, 3);
  EXPECT_NEAR(stretches[0].phases[0].duration, 0.05, 1e-12);
  EXPECT_NEAR(stretches[0].phases[1].speed, 100, 1e-12);
  const Sample middle = stretches[0].at(machine.kinematics, 1.05 / 2);
  EXPECT_NEAR(middle.tip.tip.x(), 50, 1e-9);
  EXPECT_NEAR(middle.speed, 100, 1e-9);
  EXPECT_EQ(middle.acceleration, 0);
}

TEST(Planner, AShortMoveIsATriangle) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  const auto stretches = plan(machine, {line(kOrigin, {0, 2, 0}, speed(100))});
  EXPECT_NEAR(cycle_time(stretches), 2 * std::sqrt(2 / 2000.0), 1e-12);
  EXPECT_EQ(stretches[0].phase_count, 2);
}

TEST(Planner, TheSlowestAxisLimitsALine) {
  kinematics::Machine machine = uniform_machine(1000, 2000);
  machine.axes[kinematics::kY].acceleration = 300;
  machine.axes[kinematics::kZ].speed = 50;
  // Along (2, 1, 2) / 3: Y allows 3 * 300 along the path, Z a speed of 75.
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {40, 20, 40}, kRapid)}), trapezoid(60, 75, 900), 1e-12);
}

TEST(Planner, CollinearMovesAreOne) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  std::vector<kinematics::Move> moves;
  const Vec3 step = Vec3(3, -2, 1) / 7;
  for (int i = 0; i < 5000; ++i) moves.push_back(line(i * step, (i + 1) * step, speed(300)));
  const double one = time_of(machine, {line(kOrigin, 5000 * step, speed(300))});
  EXPECT_NEAR(time_of(machine, moves), one, 1e-9);
}

TEST(Planner, ExactStopsStopOnThePoint) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  std::vector<kinematics::Move> moves = {line(kOrigin, {10, 0, 0}, speed(100)),
                                         line({10, 0, 0}, {10, 10, 0}, speed(100))};
  moves[0].exact_stop = true;
  const auto stretches = plan(machine, moves);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_NEAR(cycle_time(stretches), 2 * trapezoid(10, 100, 2000), 1e-12);
  const Sample corner = stretches[0].at(machine.kinematics, stretches[1].start);
  EXPECT_NEAR((corner.tip.tip - Vec3(10, 0, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(corner.speed, 0, 1e-9);
}

TEST(Planner, ARestTakesItsTime) {
  const std::vector<kinematics::Move> moves = {line(kOrigin, {10, 0, 0}, speed(100)),
                                               line({10, 0, 0}, {20, 0, 0}, speed(100))};
  for (const kinematics::Machine& machine :
       {uniform_machine(1000, 2000), with_jerk(uniform_machine(1000, 2000), 20000)}) {
    const double one = time_of(machine, {moves[0]});
    Planner planner(machine);
    planner.push(moves[0]);
    planner.rest(2.5);
    planner.push(moves[1]);
    planner.rest();
    double end_of_first = 0;
    double start_of_second = 0;
    while (const Stretch* stretch = planner.next()) {
      if (stretch->path.value_at(0).x() < 10) end_of_first = stretch->start + stretch->duration;
      if (start_of_second == 0 && stretch->start > end_of_first + 1) start_of_second = stretch->start;
    }
    EXPECT_NEAR(start_of_second, one + 2.5, 1e-9);
    EXPECT_NEAR(planner.time(), 2 * one + 2.5, 1e-9);
  }
}

/// A parabola that cuts d = 4 tolerance / |e2 - e1| from both sides, at v^2 = 2 d a / |e2 - e1| by axis.
TEST(Planner, ARightAngleIsRoundedWithinTheTolerance) {
  kinematics::Machine machine = uniform_machine(1000, 2000);
  machine.corner_tolerance = 0.05;
  std::vector<kinematics::Move> moves = {line(kOrigin, {50, 0, 0}, speed(500)),
                                         line({50, 0, 0}, {50, 50, 0}, speed(500))};
  moves[1].tag = 1;
  const auto stretches = plan(machine, moves);
  const double cut = 4 * 0.05 / std::sqrt(2);
  const double corner_speed = std::sqrt(2 * cut * 2000);
  ASSERT_EQ(stretches.size(), 4U);
  const Sample middle = stretches[1].at(machine.kinematics, stretches[2].start);
  EXPECT_NEAR((middle.tip.tip - Vec3(50, 0, 0)).norm(), 0.05, 1e-9);
  EXPECT_NEAR(stretches[1].phases[0].speed, corner_speed, 1e-9);
  EXPECT_NEAR(stretches[1].duration + stretches[2].duration, 2 * cut / corner_speed, 1e-12);
  // Speeds up over 50 - cut to a peak, and down to the corner's.
  const double peak = std::sqrt(corner_speed * corner_speed / 2 + 2000 * (50 - cut));
  const double side = (2 * peak - corner_speed) / 2000;
  EXPECT_NEAR(cycle_time(stretches), 2 * side + 2 * cut / corner_speed, 1e-9);
  EXPECT_EQ(stretches[1].tag, 0U);
  EXPECT_TRUE(stretches[1].ends_move);
  EXPECT_EQ(stretches[2].tag, 1U);
  EXPECT_FALSE(stretches[2].ends_move);
}

/// docs/motion.md: a slow feed needs less of a parabola than the tolerance permits: d = w |q2' - q1'| / 2 A.
TEST(Planner, ACornerIsNoLongerThanTheFeedNeeds) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  const double turn = 10 * std::numbers::pi / 180;
  std::vector<kinematics::Move> moves = {line(kOrigin, {20, 0, 0}, speed(50))};
  moves.push_back(line({20, 0, 0}, Vec3(20, 0, 0) + 20 * Vec3(std::cos(turn), std::sin(turn), 0), speed(50)));
  moves[1].tag = 1;
  const auto stretches = plan(machine, moves);
  ASSERT_EQ(stretches.size(), 4U);
  EXPECT_NEAR(stretches[1].phases[0].speed, 50, 1e-9);
  EXPECT_NEAR(stretches[1].duration + stretches[2].duration, 50 * std::sin(turn) / 2000, 1e-12);
}

/// The same where B and C turn: the corner is passed at the feed, and takes nearly all that an axis has.
TEST(Planner, ACornerInFiveAxesIsNoLongerThanTheFeedNeeds) {
  for (const kinematics::Machine& machine : {kinematics::head_router(), kinematics::table_router()}) {
    std::vector<kinematics::Move> moves = {line(kOrigin, {20, 0, 0}, speed(40)),
                                           line({20, 0, 0}, {40, 5, 0}, speed(40))};
    moves[0].to.b = moves[1].from.b = 1;
    moves[1].to.b = 4;
    moves[1].to.c = 3;
    moves[1].tag = 1;
    for (kinematics::Move& move : moves) move.tool_length = 100;
    const auto stretches = plan(machine, moves);
    double fullest = 0;
    int corners = 0;
    for (const Stretch& stretch : stretches) {
      if (stretch.path.c[2].isZero(0)) continue;
      ++corners;
      EXPECT_NEAR(stretch.phases[0].speed, 40, 1e-9);
      for (int i = 0; i <= 10; ++i) {
        const Sample sample = stretch.at(machine.kinematics, stretch.start + stretch.duration * i / 10);
        for (int axis = 0; axis < kinematics::kAxisCount; ++axis)
          fullest = std::max(fullest, std::abs(sample.joint_accelerations[axis]) /
                                          machine.axes[static_cast<std::size_t>(axis)].acceleration);
      }
    }
    EXPECT_EQ(corners, 2);
    EXPECT_GT(fullest, 0.97);
    EXPECT_LE(fullest, 1);
  }
}

/// docs/motion.md: where an element is too short for the tolerance, a corner takes a quarter d of it from each end, and
/// comes as near to the programmed point as d |e2 - e1| / 4.
TEST(Planner, ACornerTakesAQuarterOfAShortElement) {
  constexpr double kLength = 0.05;
  const Vec3 corner(kLength, 0, 0);
  const auto stretches =
      plan(uniform_machine(1000, 2000),
           {line(kOrigin, corner, speed(1000)), line(corner, corner + Vec3(0, kLength, 0), speed(1000)),
            line(corner + Vec3(0, kLength, 0), corner + Vec3(1, kLength, 0), speed(1000))});
  double nearest = kLength;
  for (const Stretch& stretch : stretches)
    for (const double part : {0.0, 0.5, 1.0})
      nearest = std::min(nearest, (stretch.at({}, stretch.start + part * stretch.duration).tip.tip - corner).norm());
  EXPECT_NEAR(nearest, kLength / 4 * std::numbers::sqrt2 / 4, 1e-9);
}

/// What is left of each line between two corners is enough to speed up and to slow down on.
TEST(Planner, AChainOfShortLinesIsNearlyAsFastAsItsCurve) {
  const kinematics::Machine machine = uniform_machine(1000, 3000);
  const double arc = time_of(machine, {arc_xy({100, 0, 0}, kOrigin, 360, 0, speed(1000))});
  constexpr int kChords = 6000;
  std::vector<kinematics::Move> chords;
  const auto at = [](int i) {
    const double angle = 2 * std::numbers::pi * i / kChords;
    return Vec3(100 * std::cos(angle), 100 * std::sin(angle), 0);
  };
  for (int i = 0; i < kChords; ++i) chords.push_back(line(at(i), at(i + 1), speed(1000)));
  EXPECT_LT(time_of(machine, chords), 1.5 * arc);
}

TEST(Planner, ACircleBelowTheCentripetalLimitKeepsItsFeed) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  // 20^2 / 50 = 8 mm/s^2 leaves nearly all for speeding up.
  const double length = 100 * std::numbers::pi;
  const double time = time_of(machine, {arc_xy(kOrigin, {50, 0, 0}, 360, 0, speed(20))});
  EXPECT_NEAR(time, trapezoid(length, 20, 2000), 1e-4 * time);
  EXPECT_GE(time, trapezoid(length, 20, 2000));
}

/// All axes alike: where an axis takes all of the centripetal acceleration, v = sqrt(a r), as in the closed form; and
/// between them, v reaches up to the fourth root of 2 times that.
TEST(Planner, ACircleBeyondTheCentripetalLimitGoesAsFastAsItAllows) {
  const kinematics::Machine machine = uniform_machine(10000, 2000);
  const auto stretches = plan(machine, {arc_xy({-20, 0, 0}, kOrigin, 3600, 0, speed(5000))});
  const double closed = std::sqrt(2000.0 * 20);
  double fastest = 0;
  for (const Stretch& stretch : stretches) {
    const Sample sample = stretch.at(machine.kinematics, stretch.start);
    fastest = std::max(fastest, sample.speed);
    const Vec3& p = sample.tip.tip;
    const bool is_at_axis = std::min(std::abs(p.x()), std::abs(p.y())) < 1e-6;
    const bool is_far_from_ends = stretch.start > 0.5 && stretch.start < cycle_time(stretches) - 0.5;
    if (is_at_axis && is_far_from_ends) {
      EXPECT_NEAR(sample.speed, closed, 0.005 * closed);
    }
  }
  EXPECT_GT(fastest, closed * 1.05);
  EXPECT_LE(fastest, closed * std::pow(2, 0.25) * (1 + 1e-6));
}

TEST(Planner, InverseTimeSetsTheSpeedUnlessTheAxesForbid) {
  const kinematics::Machine machine = uniform_machine(100, 2000);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {40, 0, 0}, duration(1))}), 1 + 40 / 2000.0, 1e-12);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {400, 0, 0}, duration(1))}), trapezoid(400, 100, 2000), 1e-12);
}

TEST(Planner, RotaryAxesAloneMoveInDegrees) {
  for (kinematics::Machine machine : {kinematics::three_axis_router(), kinematics::head_router()}) {
    machine.axes[kinematics::kB].acceleration = 500;
    machine.axes[kinematics::kC].acceleration = 500;
    kinematics::Move move;
    move.to.c = 30;
    move.to.b = 40;
    move.controls_tool_point = false;
    move.feed = speed(10);
    const double maximum = 500 / 0.8;  // B takes 4/5 of it.
    if (machine.kinematics.kind == kinematics::MachineKind::ThreeAxis) {
      EXPECT_NEAR(time_of(machine, {move}), trapezoid(50, 10, maximum), 1e-12);
    } else {
      EXPECT_NEAR(time_of(machine, {move}), trapezoid(50, 10, maximum), 0.05);
    }
  }
}

/// The carrier has to run around a tip that rests: it takes its limits as well.
TEST(Planner, APivotThatSwingsIsLimitedByTheLinearAxes) {
  kinematics::Machine machine = uniform_machine(100, 1000);
  machine.kinematics.kind = kinematics::MachineKind::Head;
  machine.kinematics.pivot = 200;
  kinematics::Move move;
  move.to.c = 90;
  move.from.b = move.to.b = 90;
  const auto stretches = plan(machine, {move});
  double fastest = 0;
  for (const Stretch& stretch : stretches)
    fastest = std::max(
        fastest, stretch.at(machine.kinematics, stretch.start + stretch.duration / 2).joint_speeds.head<3>().norm());
  EXPECT_LE(fastest, 100 * std::sqrt(2) * (1 + 1e-6));
  EXPECT_GT(fastest, 100);
}

/// From rest to rest, while the tip rests: B turns, and X swings the arm of 180 + 100 mm. However short, it has a peak.
TEST(Planner, AShortTurnOfTheHeadIsATriangle) {
  const kinematics::Machine machine = kinematics::head_router();
  const double by_swing = machine.axes[kinematics::kX].acceleration / (280 * std::numbers::pi / 180);
  for (const double degrees : {1e-7, 1e-5, 4e-4, 1e-3, 0.01, 0.1}) {
    kinematics::Move move = line(kOrigin, kOrigin, speed(1000));
    move.to.b = degrees;
    move.tool_length = 100;
    const double expected = 2 * std::sqrt(degrees / std::min(machine.axes[kinematics::kB].acceleration, by_swing));
    EXPECT_NEAR(time_of(machine, {move}), expected, 0.001 * expected) << degrees;
  }
}

TEST(Planner, SplitArcsStayWithinTheChordTolerance) {
  kinematics::Machine machine = uniform_machine(1000, 2000);
  machine.chord_tolerance = 0.02;
  machine.corner_tolerance = 0.001;
  kinematics::Move arc = arc_xy(kOrigin, {30, 0, 0}, -180, 0, speed(50));
  arc.splits_arcs = true;
  double minimum = 100;
  double maximum = 0;
  for (const Stretch& stretch : plan(machine, {arc})) {
    ASSERT_EQ(stretch.path.kind, kinematics::PathKind::Polynomial);
    const double middle =
        (stretch.at(machine.kinematics, stretch.start + stretch.duration / 2).tip.tip - arc.center).norm();
    minimum = std::min(minimum, middle);
    maximum = std::max(maximum, middle);
  }
  EXPECT_NEAR(maximum, 30, 0.001);
  EXPECT_LT(minimum, 30 - 0.01);
  EXPECT_GE(minimum, 30 - 0.021);
}

TEST(Planner, AMoveThatGoesNowhereHasNoStretch) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  kinematics::Move nowhere = line({10, 0, 0}, {10, 0, 0}, speed(100));
  const auto through =
      plan(machine, {line(kOrigin, {10, 0, 0}, speed(100)), nowhere, line({10, 0, 0}, {20, 0, 0}, speed(100))});
  EXPECT_EQ(through.size(), 2U);
  EXPECT_NEAR(cycle_time(through), trapezoid(20, 100, 2000), 1e-12);
  nowhere.exact_stop = true;
  const auto stopped =
      plan(machine, {line(kOrigin, {10, 0, 0}, speed(100)), nowhere, line({10, 0, 0}, {20, 0, 0}, speed(100))});
  EXPECT_NEAR(cycle_time(stopped), 2 * trapezoid(10, 100, 2000), 1e-12);
}

TEST(Planner, AGapIsAStop) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  const double time =
      time_of(machine, {line(kOrigin, {10, 0, 0}, speed(100)), line({11, 0, 0}, {21, 0, 0}, speed(100))});
  EXPECT_NEAR(time, 2 * trapezoid(10, 100, 2000), 1e-12);
}

bool equal(const Stretch& a, const Stretch& b) {
  if (a.tag != b.tag || a.ends_move != b.ends_move || a.start != b.start || a.duration != b.duration) return false;
  if (a.phase_count != b.phase_count || a.path.c != b.path.c) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.phase_count); ++i)
    if (a.phases[i].from != b.phases[i].from || a.phases[i].acceleration != b.phases[i].acceleration ||
        a.phases[i].jerk != b.phases[i].jerk)
      return false;
  return true;
}

/// A caller that asks for stretches late, or continues with a copy, gets the same.
class Reading : public testing::TestWithParam<kinematics::Machine> {};

TEST_P(Reading, CopiesAndLateReadersGetTheSame) {
  const kinematics::Machine& machine = GetParam();
  for (const std::uint64_t seed : support::seeds(10)) {
    const std::vector<kinematics::Move> moves = random_moves(seed, 300);
    const std::vector<Stretch> expected = plan(machine, moves);
    std::vector<Stretch> stretches;
    Planner planner(machine);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      planner.push(moves[i]);
      const std::size_t some = (i * 7 + seed) % 40;
      for (std::size_t k = 0; k < some; ++k)
        if (const Stretch* stretch = planner.next()) stretches.push_back(*stretch);
      Planner copy = planner;
      planner = Planner(kinematics::three_axis_router());
      planner = copy;
    }
    planner.rest();
    while (const Stretch* stretch = planner.next()) stretches.push_back(*stretch);
    ASSERT_EQ(stretches.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      ASSERT_TRUE(equal(stretches[i], expected[i])) << seed << " " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Planner, Reading,
                         testing::Values(kinematics::head_router(), with_jerk(kinematics::head_router(), 30000)));

/// The maximum number of moves that the planner holds back.
std::size_t max_lag(const kinematics::Machine& machine, double step, std::size_t count, kinematics::Feed feed) {
  Planner planner(machine);
  std::size_t out = 0;
  std::size_t maximum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) * step;
    planner.push(line({x, 0, 0}, {x + step, 0, 0}, feed));
    while (planner.next()) ++out;
    maximum = std::max(maximum, i + 1 - out);
  }
  return maximum;
}

TEST(Planner, HoldsBackNoMoreThanTheStoppingDistance) {
  // 10 mm to stop from 200 mm/s.
  EXPECT_LE(max_lag(uniform_machine(1000, 2000), 1, 20000, speed(200)), 300U);
  EXPECT_LE(max_lag(uniform_machine(1000, 2000), 0.01, 20000, speed(200)), 2100U);
}

/// Moves of a micron, faster than the machine can stop in all that is looked at: it goes slower, and within its limits.
TEST(Planner, HoldsBackNoMoreThanItsWindow) {
  const kinematics::Machine machine = uniform_machine(1000, 2000);
  EXPECT_LE(max_lag(machine, 0.001, 60000, speed(500)), 16400U);
  std::vector<kinematics::Move> moves;
  for (int i = 0; i < 60000; ++i) moves.push_back(line({i * 0.001, 0, 0}, {(i + 1) * 0.001, 0, 0}, speed(500)));
  double before = 0;
  double fastest = 0;
  for (const Stretch& stretch : plan(machine, moves)) {
    const Phase& first = stretch.phases[0];
    EXPECT_NEAR(first.speed, before, 1e-9);
    for (int i = 0; i < stretch.phase_count; ++i) {
      const Phase& phase = stretch.phases[static_cast<std::size_t>(i)];
      EXPECT_LE(std::abs(phase.acceleration), 2000 * (1 + 1e-6));
      before = phase.speed + phase.duration * phase.acceleration;
    }
    fastest = std::max(fastest, before);
  }
  EXPECT_NEAR(before, 0, 1e-9);
  EXPECT_GT(fastest, std::sqrt(2 * 2000 * 8.0) * 0.99);
}

/// Half a window more, of all that the machine could go in it.
TEST(Planner, HoldsBackNoMoreWhereJerkIsLimited) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 40000);
  EXPECT_LE(max_lag(machine, 1, 5000, speed(200)), 1500U);
  EXPECT_LE(max_lag(machine, 0.01, 40000, speed(200)), 30000U);
}

TEST(Planner, CountsTheMemoryOfWhatIsNotRead) {
  for (const kinematics::Machine& machine :
       {uniform_machine(1000, 2000), with_jerk(uniform_machine(1000, 2000), 40000)}) {
    Planner planner(machine);
    for (int i = 0; i < 5000; ++i) planner.push(line({1.0 * i, 0, 0}, {i + 1.0, 0, 0}, speed(100)));
    const std::size_t unread = planner.memory();
    std::size_t stretches = 0;
    while (planner.next()) ++stretches;
    planner.forget_handed_out();
    EXPECT_GT(stretches, 4000U);
    EXPECT_GE(unread, planner.memory() + stretches * sizeof(Piece));
    EXPECT_LT(unread, 5000U * 2000);
  }
}

/// A thread of ten thousand turns is cut as it is needed.
void expect_long_helix_to_come_out(const kinematics::Machine& machine) {
  Planner planner(machine);
  planner.push(arc_xy({-5, 0, 0}, {0, 0, 0}, 360.0 * 10000, 100, speed(50)));
  double length = 0;
  const auto take = [&] {
    while (const Stretch* stretch = planner.next()) length += stretch->duration * 50;
  };
  take();
  EXPECT_GT(length, 1e5) << "nothing came out before the end";
  planner.rest();
  take();
  EXPECT_NEAR(length, std::hypot(2 * std::numbers::pi * 5 * 10000, 100), 10);
}

double fastest_of(const kinematics::Machine& machine, const std::vector<Stretch>& stretches, std::uint64_t tag) {
  double fastest = 0;
  for (const Stretch& stretch : stretches)
    for (int i = 0; stretch.tag == tag && i <= 20; ++i)
      fastest = std::max(fastest, stretch.at(machine.kinematics, stretch.start + stretch.duration * i / 20).speed);
  return fastest;
}

/// The nose stands still while B turns: the tip goes on in the direction of the feed move before, and the feed move
/// behind in that of the swing; on the way it is faster than s, which counts the chord.
class Swinging : public testing::TestWithParam<bool> {};

TEST_P(Swinging, FeedHoldsInCornersToRapids) {
  kinematics::Machine machine = kinematics::head_router();
  for (kinematics::AxisLimits& axis : machine.axes) axis.acceleration = axis.speed = 1e7;
  if (GetParam()) machine = with_jerk(machine, 1e11);
  const kinematics::Move feed = line({310, 100, 200}, {300, 100, 200}, speed(50));
  kinematics::Move rapid;
  rapid.tag = 1;
  rapid.from = feed.to;
  kinematics::Coordinates joints = kinematics::inverse(machine.kinematics, kinematics::coordinates(rapid.from), 0);
  joints[kinematics::kB] = 80;
  rapid.to = kinematics::pose(kinematics::forward(machine.kinematics, joints, 0));
  rapid.controls_tool_point = false;
  const Vec3 onward = geometry::axes_from_angles(80, 0) * Vec3(-10, 0, 0);
  kinematics::Move back = line(rapid.to.tip, rapid.to.tip + onward, speed(40));
  back.tag = 2;
  back.from.b = back.to.b = 80;
  const auto stretches = plan(machine, {feed, rapid, back});
  EXPECT_LE(fastest_of(machine, stretches, 0), 50 * (1 + 1e-6));
  EXPECT_LE(fastest_of(machine, stretches, 2), 40 * (1 + 1e-6));
  EXPECT_GT(fastest_of(machine, stretches, 1), 1000);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutJerk, Swinging, testing::Bool());

TEST(Planner, FeedMovesKeepToTheSpeedsOfFeedMoves) {
  kinematics::Machine machine = uniform_machine(1000, 2000);
  machine.feed_speed = 20;
  machine.feed_turn = 30;
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {100, 0, 0}, speed(100))}), trapezoid(100, 20, 2000), 1e-12);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {100, 0, 0}, duration(0.1))}), trapezoid(100, 20, 2000), 1e-12);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {100, 0, 0}, kRapid)}), trapezoid(100, 1000, 2000), 1e-12);
  kinematics::Move turning = line(kOrigin, {100, 0, 0}, speed(1000));
  turning.to.c = 200;  // 2 degrees/mm: 15 mm/s.
  EXPECT_NEAR(time_of(machine, {turning}), trapezoid(100, 15, 1000), 1e-12);
  turning.to.tip = kOrigin;
  EXPECT_NEAR(time_of(machine, {turning}), trapezoid(200, 30, 2000), 1e-12);
  turning.feed = kRapid;
  EXPECT_NEAR(time_of(machine, {turning}), trapezoid(200, 1000, 2000), 1e-12);
}

TEST(Planner, ALongHelixIsNotHeldAsAWhole) {
  expect_long_helix_to_come_out(uniform_machine(1000, 2000));
  expect_long_helix_to_come_out(with_jerk(uniform_machine(1000, 2000), 40000));
}

/// From rest to rest over `length` with speed v, acceleration a and jerk j: from 0 to v it takes v/a + a/j, or
/// 2 sqrt(v/j) where a is not reached, and v half of that.
double s_curve(double length, double v, double a, double j) {
  const auto ramp = [&](double speed) { return speed >= a * a / j ? speed / a + a / j : 2 * std::sqrt(speed / j); };
  double minimum = 0;
  double maximum = v;
  for (int i = 0; i < 100 && v * ramp(v) > length; ++i) {
    const double middle = (minimum + maximum) / 2;
    (middle * ramp(middle) > length ? maximum : minimum) = middle;
  }
  return length / maximum + ramp(maximum);
}

TEST(Planner, OneMoveIsAnSCurve) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  for (const double length : {0.001, 0.1, 1.0, 10.0, 100.0, 1000.0})
    for (const double v : {5.0, 50.0, 200.0, 700.0}) {
      const double closed = s_curve(length, v, 2000, 20000);
      const double time = time_of(machine, {line(kOrigin, {length, 0, 0}, speed(v))});
      EXPECT_GE(time, closed * (1 - 1e-9)) << length << " " << v;
      EXPECT_LE(time, closed * (1 + 1e-3)) << length << " " << v;
    }
}

TEST(Planner, TheWeakestAxisLimitsALine) {
  kinematics::Machine machine = uniform_machine(1000, 2000);
  machine.axes[kinematics::kY].jerk = 5000;
  // Along (3, 4, 0) / 5: Y allows 5000 / 0.8, and 2000 / 0.8 of acceleration.
  const double closed = s_curve(100, 300, 2500, 6250);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {60, 80, 0}, speed(300))}), closed, 1e-3 * closed);
  EXPECT_NEAR(time_of(machine, {line(kOrigin, {60, 0, 80}, speed(300))}), trapezoid(100, 300, 2500), 0.1);
}

/// In a circle at a constant speed the jerk is v^3 / r^2; two fifths of the limit are left for changes of the speed.
TEST(Planner, ACircleGoesAsFastAsItsJerkAllows) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 3000), 20000);
  double fastest = 0;
  for (const Stretch& stretch : plan(machine, {arc_xy({-5, 0, 0}, kOrigin, 3600, 0, speed(1000))}))
    fastest = std::max(fastest, stretch.at(machine.kinematics, stretch.start).speed);
  const double maximum = std::cbrt(20000.0 * 25);
  EXPECT_LE(fastest, maximum);
  EXPECT_GE(fastest, maximum * std::cbrt(0.59));
}

/// An arc that leaves a line along its tangent is entered without a stop, through a curve that gathers the bend.
TEST(Planner, TangentialArcsAreNotStops) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  std::vector<kinematics::Move> moves = {line({-50, 0, 0}, kOrigin, speed(40)),
                                         arc_xy(kOrigin, {0, 20, 0}, 180, 0, speed(40)),
                                         line({0, 40, 0}, {-50, 40, 0}, speed(40))};
  const double closed = s_curve(100 + 20 * std::numbers::pi, 40, 2000, 20000);
  EXPECT_NEAR(time_of(machine, moves), closed, 0.01 * closed);
}

/// docs/motion.md: the blend counts as long as the lines that it replaces. Where the axes could turn faster than the
/// feed, it takes no longer than these, but for the bound of the tip's speed: 1 + |e2 - e1| / 64 on two of its three
/// cubics.
TEST(Planner, ASlowCornerCostsLittleWhereJerkIsLimited) {
  kinematics::Machine machine = with_jerk(uniform_machine(1000, 1e5), 1e7);
  machine.corner_tolerance = 1;
  const double time =
      time_of(machine, {line(kOrigin, {20, 0, 0}, speed(10)), line({20, 0, 0}, {20, 20, 0}, speed(10))});
  const double depth = 72.0 / 13 / std::numbers::sqrt2;
  const double straight = s_curve(40, 10, 1e5, 1e7);
  EXPECT_GE(time, straight);
  EXPECT_LE(time, 1.001 * straight + 2 * depth / 10 * 2 / 3 * std::numbers::sqrt2 / 64);
}

/// Feed and then a rapid that swings the tip along an arc of 300 degrees, of which s counts the chord. Each of the four
/// parts of the corner makes a quarter of its turn, and its fastest place keeps to the feed: so in the middle of the
/// corner the tip is slower by the ratio of its rates there and at three quarters.
TEST(Planner, ACornerToASwingIsAsFastAsTheFeedPermitsWhereJerkIsLimited) {
  kinematics::Machine machine = with_jerk(uniform_machine(1e7, 1e7), 1e11);
  machine.kinematics = {.kind = kinematics::MachineKind::Head, .pivot = 200};
  kinematics::Move feed = line({0, 10, 0}, kOrigin, speed(50));
  feed.from.b = feed.to.b = 90;
  kinematics::Move rapid;
  rapid.tag = 1;
  rapid.from = feed.to;
  kinematics::Coordinates joints = kinematics::inverse(machine.kinematics, kinematics::coordinates(rapid.from), 0);
  joints[kinematics::kC] = 300;
  rapid.to = kinematics::pose(kinematics::forward(machine.kinematics, joints, 0));
  rapid.controls_tool_point = false;
  double middle = 0;
  for (const Stretch& stretch : plan(machine, {feed, rapid}))
    if (stretch.tag == 0 && stretch.ends_move)
      middle = stretch.at(machine.kinematics, stretch.start + stretch.duration).speed;
  const double swing = std::numbers::pi * 300 / 180 / (2 * std::sin(std::numbers::pi * 150 / 180));
  EXPECT_NEAR(middle, 50 * (0.5 + 0.5 * swing) / (0.25 + 0.75 * swing), 0.01 * 50);
}

/// However short a move is: its end is reported, even where the way before it leaves it no digits.
TEST(Planner, EveryMoveEndsWhereJerkIsLimited) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  const Vec3 step(2e-9, 0, 0);
  for (const double length : {10.0, 1e5, 1e9}) {
    const Vec3 far(-length, 0, 0);
    const auto stretches = plan(machine, {line(far, kOrigin, speed(100)), line(kOrigin, step, speed(100)),
                                          line(step, 2 * step, speed(100)), line(2 * step, kOrigin, speed(100))});
    EXPECT_EQ(std::count_if(stretches.begin(), stretches.end(), [](const Stretch& each) { return each.ends_move; }), 4)
        << length;
  }
}

/// Chains of short lines are as fast as one long line where they are straight.
TEST(Planner, CollinearMovesAreOneWhereJerkIsLimited) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  std::vector<kinematics::Move> moves;
  for (int i = 0; i < 1000; ++i) moves.push_back(line({i * 0.1, 0, 0}, {(i + 1) * 0.1, 0, 0}, speed(100)));
  EXPECT_NEAR(time_of(machine, moves), s_curve(100, 100, 2000, 20000), 0.01);
}

}  // namespace
}  // namespace isocnc::motion
