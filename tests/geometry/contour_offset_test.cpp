#include "interpreter/geometry/contour_offset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "tests/support/plane_curves.h"
#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

using std::numbers::pi;
using support::arc;
using support::line;
using support::point_on;
using testing::ElementsAre;
using testing::IsEmpty;

/// What becomes of a contour that the cutter enters from a point; tags are places in the contour, from 1.
struct Offset {
  std::vector<OffsetPiece> pieces;
  std::vector<std::uint64_t> gouges;
  std::vector<std::uint64_t> small_arcs;
};

struct OffsetOptions {
  double radius = 5;
  int side = 1;
  bool reduces = false;
  std::uint64_t stop_after = 0;  ///< The tag of an element.
};

void drain(ContourOffset& contour, Offset& offset) {
  while (const auto piece = contour.next_piece()) offset.pieces.push_back(*piece);
  while (const auto flaw = contour.next_flaw())
    (flaw->small_arc ? offset.small_arcs : offset.gouges).push_back(flaw->tag);
}

Offset offset(const std::vector<PlaneCurve>& curves, const Vec2& from, const OffsetOptions& options) {
  ContourOffset contour(options.radius);
  Offset result;
  ContourElement element{.curve = line(from, curves.front().start), .side = options.side, .reduces = options.reduces};
  contour.lead_in(element.curve, element, false);
  for (const PlaneCurve& curve : curves) {
    element.curve = curve;
    ++element.tag;
    contour.add(element);
    if (element.tag == options.stop_after) contour.finish();
    drain(contour, result);
  }
  contour.finish();
  drain(contour, result);
  return result;
}

/// A contour that leads from point to point.
std::vector<PlaneCurve> lines(const std::vector<Vec2>& points) {
  std::vector<PlaneCurve> curves;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) curves.push_back(line(points[i], points[i + 1]));
  return curves;
}

std::vector<std::uint64_t> tags(const Offset& offset) {
  std::vector<std::uint64_t> all;
  for (const OffsetPiece& piece : offset.pieces)
    if (!piece.is_inserted) all.push_back(piece.tag);
  return all;
}

/// A slot 6 mm wide in the upper side of a block.
const std::vector<PlaneCurve> kSlot = lines({{-50, 0}, {0, 0}, {0, -20}, {6, -20}, {6, 0}, {50, 0}});

TEST(ContourOffset, GougesWhereThereIsNoSpace) {
  const Offset kept = offset(kSlot, {-50, 10}, {.radius = 5});
  EXPECT_THAT(tags(kept), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(std::set<std::uint64_t>(kept.gouges.begin(), kept.gouges.end()), testing::IsSupersetOf({2, 4}));
  EXPECT_THAT(offset(kSlot, {-50, 10}, {.radius = 2.9}).gouges, IsEmpty());
}

TEST(ContourOffset, LeavesOutWhatItCannotReach) {
  const Offset reduced = offset(kSlot, {-50, 10}, {.radius = 5, .reduces = true});
  EXPECT_THAT(tags(reduced), ElementsAre(0, 1, 5));
  EXPECT_THAT(reduced.gouges, IsEmpty());
  // Both rounded corners of the slot meet in its middle.
  ASSERT_EQ(reduced.pieces.size(), 5u);
  EXPECT_NEAR(reduced.pieces[2].curve.end.x(), 3, 1e-9);
  EXPECT_NEAR(reduced.pieces[2].curve.end.y(), 4, 1e-9);
}

/// Where directions differ by so little that the offset ends count as one point, too.
TEST(ContourOffset, GoesOnWhereItHasArrived) {
  std::vector<Vec2> points = {{0, 0}};
  for (const double turn : {0.0, 1e-5, -1e-5, 2e-5, 1e-3, -1e-3})
    points.push_back(points.back() + 10 * Vec2(std::cos(turn), std::sin(turn)));
  for (const int side : {1, -1}) {
    const std::vector<OffsetPiece> pieces = offset(lines(points), {-5, 0}, {.radius = 3, .side = side}).pieces;
    for (std::size_t i = 1; i < pieces.size(); ++i) EXPECT_EQ(pieces[i].curve.start, pieces[i - 1].curve.end) << i;
  }
}

/// Pieces wait until no loop can reach back to them, also where many have been emitted already.
TEST(ContourOffset, LeavesOutWhatItCannotReachLateInAContour) {
  std::vector<PlaneCurve> contour;
  for (int x = -150; x < -50; ++x) contour.push_back(line({x, 0}, {x + 1, 0}));
  contour.insert(contour.end(), kSlot.begin(), kSlot.end());
  const Offset reduced = offset(contour, {-150, 10}, {.radius = 5, .reduces = true});
  EXPECT_THAT(reduced.gouges, IsEmpty());
  std::vector<std::uint64_t> expected(102);  // The lead-in, and all before the slot.
  std::iota(expected.begin(), expected.end(), 0);
  expected.push_back(105);
  EXPECT_EQ(tags(reduced), expected);
}

TEST(ContourOffset, LeavesOutAnInsideArcThatIsTooSmall) {
  const std::vector<PlaneCurve> corner = {line({0, 0}, {30, 0}), arc({30, 0}, {30, 4}, pi / 2),
                                          line({34, 4}, {34, 40})};
  const Offset kept = offset(corner, {0, 20}, {.radius = 5});
  EXPECT_THAT(kept.small_arcs, ElementsAre(2));
  EXPECT_THAT(kept.gouges, IsEmpty()) << "the arc reports them";
  const Offset reduced = offset(corner, {0, 20}, {.radius = 5, .reduces = true});
  EXPECT_THAT(reduced.small_arcs, ElementsAre(2));
  EXPECT_THAT(tags(reduced), ElementsAre(0, 1, 3));
  EXPECT_NEAR(reduced.pieces[1].curve.end.x(), 29, 1e-9);
  EXPECT_NEAR(reduced.pieces[1].curve.end.y(), 5, 1e-9);
}

TEST(ContourOffset, FitsIntoAnArcOfItsOwnSize) {
  const Offset fits =
      offset({line({0, 0}, {30, 0}), arc({30, 0}, {30, 5}, pi / 2), line({35, 5}, {35, 40})}, {0, 20}, {.radius = 5});
  EXPECT_THAT(fits.small_arcs, IsEmpty());
  EXPECT_THAT(fits.gouges, IsEmpty());
}

/// Two chambers that a neck 6 mm wide connects; its walls are lines 5 and 11 of the contour.
const std::vector<PlaneCurve> kNeck = lines({{40, 0},
                                             {60, 0},
                                             {60, 40},
                                             {43, 40},
                                             {43, 60},
                                             {60, 60},
                                             {60, 100},
                                             {20, 100},
                                             {20, 60},
                                             {37, 60},
                                             {37, 40},
                                             {20, 40},
                                             {20, 0},
                                             {40, 0}});

TEST(ContourOffset, GougesTheFarWallOfANeck) {
  const std::set<std::uint64_t> walls = {4, 10};
  const std::vector<std::uint64_t> reported = offset(kNeck, {40, 20}, {.radius = 5}).gouges;
  EXPECT_THAT(std::set<std::uint64_t>(reported.begin(), reported.end()), testing::IsSupersetOf(walls));
  EXPECT_THAT(offset(kNeck, {40, 20}, {.radius = 2.9}).gouges, IsEmpty());
  const Offset reduced = offset(kNeck, {40, 20}, {.radius = 5, .reduces = true});
  EXPECT_THAT(reduced.gouges, IsEmpty());
  EXPECT_THAT(tags(reduced), ElementsAre(0, 1, 2, 3, 11, 12, 13)) << "the far chamber is left out";
}

/// What goes along where another pass of the contour was takes away what that has left.
TEST(ContourOffset, MayGoWhereAnEarlierPassWas) {
  const auto square = [](double reach) {
    return std::vector<Vec2>{{0, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}, {-reach, -reach}};
  };
  std::vector<Vec2> roughing_and_finishing = square(28);
  for (const Vec2& point : square(30)) roughing_and_finishing.push_back(point);
  roughing_and_finishing.emplace_back(0, -30);
  EXPECT_THAT(offset(lines(roughing_and_finishing), {0, 0}, {.radius = 5}).gouges, IsEmpty());
}

/// Lines that lead onto a closed contour, and off it where it began, come as near to each other as they like.
TEST(ContourOffset, MayLeadOffBesideWhereItHasLedOn) {
  const std::vector<Vec2> points = {{-60, 40}, {-40, 30}, {0, 50}, {0, 100}, {200, 100},
                                    {200, 0},  {0, 0},    {0, 60}, {-40, 60}};
  EXPECT_THAT(offset(lines(points), {-80, 60}, {.radius = 8}).gouges, IsEmpty());
}

/// A way off the contour leads across its start; in the air that does not matter.
TEST(ContourOffset, ForgetsWhatItHasCutWhenRaised) {
  for (const bool raised : {false, true}) {
    ContourOffset contour(5);
    const ContourElement element{.curve = line({0, 0}, {50, 0}), .tag = 1};
    contour.lead_in(line({0, 20}, {0, 0}), element, false);
    contour.add(element);
    contour.finish();
    if (raised) contour.forget();
    contour.lead_out(line({50, 5}, {20, -10}), 2);
    Offset result;
    drain(contour, result);
    EXPECT_EQ(result.gouges.empty(), raised);
  }
}

TEST(ContourOffset, IsAValue) {
  ContourOffset contour(5);
  const ContourElement first{.curve = line({0, 0}, {50, 0}), .tag = 1};
  contour.lead_in(line({0, 20}, {0, 0}), first, false);
  contour.add(first);
  ContourOffset copy = contour;
  copy.add({.curve = line({50, 0}, {50, -50}), .tag = 2});
  contour.finish();
  Offset ends;
  drain(contour, ends);
  ASSERT_EQ(ends.pieces.size(), 2u);
  EXPECT_NEAR(ends.pieces[1].curve.end.x(), 50, 1e-9);
  copy.finish();
  Offset continues;
  drain(copy, continues);
  EXPECT_EQ(continues.pieces.size(), 4u);
}

/// Round a convex contour a stop changes nothing; into an inside corner the cutter has then gone too far.
TEST(ContourOffset, GoesOnFromWhereItHasStopped) {
  const std::vector<PlaneCurve> convex = {line({0, 0}, {50, 0}), line({50, 0}, {80, 0}),
                                          arc({80, 0}, {80, -20}, -pi / 2), line({100, -20}, {100, -50}),
                                          line({100, -50}, {0, -50})};
  const Offset at_once = offset(convex, {0, 10}, {});
  for (std::uint64_t tag = 1; tag <= convex.size(); ++tag) {
    const Offset stopped = offset(convex, {0, 10}, {.stop_after = tag});
    ASSERT_EQ(stopped.pieces.size(), at_once.pieces.size()) << tag;
    for (std::size_t i = 0; i < at_once.pieces.size(); ++i) {
      EXPECT_EQ(stopped.pieces[i].curve.end, at_once.pieces[i].curve.end) << tag;
      EXPECT_EQ(stopped.pieces[i].curve.sweep, at_once.pieces[i].curve.sweep) << tag;
    }
    EXPECT_THAT(stopped.gouges, IsEmpty()) << tag;
  }
  const Offset corner = offset(lines({{0, 0}, {50, 0}, {50, 40}}), {0, 10}, {.stop_after = 1});
  ASSERT_EQ(corner.pieces.size(), 4u);
  EXPECT_NEAR(corner.pieces[1].curve.end.x(), 50, 1e-9);
  EXPECT_FALSE(corner.pieces[2].curve.is_arc());
  EXPECT_NEAR((corner.pieces[2].curve.end - Vec2(45, 0)).norm(), 0, 1e-9);
  EXPECT_THAT(corner.gouges, testing::Contains(1));
}

/// Lines and arcs, tangent or not, some of them back and forth.
std::vector<PlaneCurve> random_contour(support::Random& random) {
  std::vector<PlaneCurve> curves;
  Vec2 at = Vec2::Zero();
  double heading = random.real(-pi, pi);
  const int count = random.between(1, 24);
  for (int i = 0; i < count; ++i) {
    if (!random.one_in(3)) heading += random.one_in(3) ? random.real(-pi, pi) : random.real(-1, 1);
    const double length = random.one_in(4) ? random.real(0.1, 3) : random.real(3, 60);
    const Vec2 way = support::turned(Vec2::UnitX(), heading);
    if (random.one_in(2)) {
      curves.push_back(line(at, at + length * way));
    } else {
      const double radius = random.real(1, 30);
      const double sweep = std::min(length / radius, 6.0) * (random.one_in(2) ? 1 : -1);
      curves.push_back(arc(at, at + std::copysign(radius, sweep) * left_of(way), sweep));
      heading += sweep;
    }
    at = curves.back().end;
  }
  return curves;
}

/// Whether both are lines that lead in opposite directions, within 45 degrees.
bool are_facing_lines(const PlaneCurve& a, const PlaneCurve& b) {
  return !a.is_arc() && !b.is_arc() && a.direction_at_start().dot(b.direction_at_start()) < -std::sqrt(0.5);
}

/// Which elements farther away in the contour than its neighbors count: those that a piece surely has to spare, or all
/// that it may have to.
enum class Others { Sure, All };

/// From a point of a piece to the nearest element that it has to spare.
double nearest_to(const Vec2& point, const OffsetPiece& piece, const std::vector<PlaneCurve>& contour, Others others) {
  double minimum = 1e9;
  const auto continues = [&](std::uint64_t first) {
    return first > 0 && (contour[first - 1].direction_at_end() - contour[first].direction_at_start()).norm() < 1e-3;
  };
  for (std::uint64_t tag = 1; tag <= contour.size(); ++tag) {
    const std::uint64_t apart = std::max(tag, piece.tag) - std::min(tag, piece.tag);
    if (apart == 1 && continues(std::min(tag, piece.tag))) continue;
    if (apart > ContourOffset::kNeighbors && others == Others::Sure &&
        (piece.tag == 0 || !are_facing_lines(piece.curve, contour[tag - 1])))
      continue;
    minimum = std::min(minimum, support::distance_from(point, contour[tag - 1]));
  }
  return minimum;
}

/// The cutter's center is never nearer to the contour than its radius, but on motions that are reported; it is where
/// the piece before has left it; and a reported gouge can be found.
TEST(ContourOffsetProperty, SparesTheContourOrReportsAGouge) {
  constexpr int kPoints = 10;
  int clean = 0;
  int reported = 0;
  for (const std::uint64_t seed : support::seeds(100)) {
    support::Random random(seed);
    const std::vector<PlaneCurve> contour = random_contour(random);
    const OffsetOptions options{.radius = random.real(0.5, 8),
                                .side = random.one_in(2) ? 1 : -1,
                                .reduces = random.one_in(2),
                                .stop_after = static_cast<std::uint64_t>(random.between(0, 24))};
    const Vec2 beside =
        contour.front().start + 3 * options.radius * options.side * left_of(contour.front().direction_at_start());
    const Offset result = offset(contour, beside, options);
    ++(result.gouges.empty() && result.small_arcs.empty() ? clean : reported);
    Vec2 at = beside;
    std::set<std::uint64_t> gouging;
    for (const OffsetPiece& piece : result.pieces) {
      EXPECT_NEAR((piece.curve.start - at).norm(), 0, 1e-9) << seed;
      at = piece.curve.end;
      EXPECT_NEAR((point_on(piece.curve, 1) - at).norm(), 0, 2e-4) << seed;
      for (int i = 0; i <= kPoints; ++i)
        if (nearest_to(point_on(piece.curve, 1.0 * i / kPoints), piece, contour, Others::Sure) +
                (piece.tag == 0 ? options.radius / 2 : 0) <
            options.radius - ContourOffset::kGouge - 3e-4)
          gouging.insert(piece.tag);
    }
    for (const std::uint64_t tag : gouging) {
      const bool is_reported = std::find(result.gouges.begin(), result.gouges.end(), tag) != result.gouges.end();
      const bool is_explained = std::any_of(result.small_arcs.begin(), result.small_arcs.end(), [&](std::uint64_t arc) {
        return std::max(arc, tag) - std::min(arc, tag) <= 2;
      });
      EXPECT_TRUE(is_reported || is_explained) << seed << " element " << tag;
    }
    for (const std::uint64_t tag : result.gouges) {
      double minimum = options.radius;
      for (const OffsetPiece& piece : result.pieces)
        for (int i = 0; piece.tag == tag && i <= 6 * kPoints; ++i)
          minimum =
              std::min(minimum, nearest_to(point_on(piece.curve, i / (6.0 * kPoints)), piece, contour, Others::All));
      EXPECT_LT(minimum, options.radius - ContourOffset::kGouge / 2) << seed << " element " << tag;
    }
  }
  EXPECT_GT(clean, static_cast<int>(support::often(20)));
  EXPECT_GT(reported, static_cast<int>(support::often(20)));
}

}  // namespace
}  // namespace isocnc::geometry
