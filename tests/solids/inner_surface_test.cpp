#include "interpreter/solids/inner_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using scenes::body;
using scenes::prism;
using scenes::Random;
using scenes::upright;
using scenes::Vec3;

constexpr double kDepth = 0.2;
constexpr double kFacetError = 1.036;  ///< Between two facets, an inner edge is deeper by this factor at most.

double distance(const RevolvedBody& tool, const AxisPlacement& at, const std::shared_ptr<const Mesh>& part,
                double depth = kDepth) {
  const Clearance found = clearance(tool, at, InnerSurface(part, depth));
  EXPECT_LE(found.lower, found.upper + 1e-9);
  return found.lower;
}

/// How deep a tool cuts into a slope is measured across the slope, with every tool: for a flat end it is its rim, which
/// is neither `depth` from the end nor from the side of what is cut.
TEST(InnerSurface, OfASlopeIsMeasuredAcrossIt) {
  for (const double degrees : {0.0, 10.0, 30.0, 45.0, 70.0}) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    const auto part = prism({{0, -100}, {200, -100}, {200, 200 * slope}, {0, 0}}, 200);
    const Vec3 normal = Vec3(-slope, 0, 1).normalized();
    for (const RevolvedBody& tool : {body(flat_body(5, 400)), body(bull_body(5, 1, 400)), body(ball_body(5, 400)),
                                     body(cone_body(5, 0, 60, 400)), body(cone_body(3, 0.1, 90, 400))})
      for (const double gouge : {0.0, 0.1, 0.19, 0.21, 0.3, 0.6}) {
        SCOPED_TRACE(testing::Message() << degrees << " degrees, " << gouge);
        const Vec3 lowest = scenes::farthest_point(tool, upright(0, 0, 0), -normal);
        const Vec3 on_slope(100, 100, 100 * slope);
        EXPECT_NEAR(distance(tool, {on_slope - gouge * normal - lowest, {0, 0, 1}}, part), kDepth - gouge, 2e-5);
      }
  }
}

/// Beside an outer edge, the depth is that below the nearer face: above it, the tool may go as far down as it likes.
TEST(InnerSurface, EndsWhereFacesMeetInAnOuterEdge) {
  const auto part = std::make_shared<const Mesh>(scenes::box_triangles({{0, 0, -50}, {100, 100, 0}}));
  const RevolvedBody tool = body(flat_body(5, 60));
  for (const double below : {0.0, 0.1, 0.19, 1.0, 30.0}) {
    // From the edge of what is deep: 0.05 beside it, and above it as far as the tool is less than 0.2 below the top.
    EXPECT_NEAR(distance(tool, upright(-5 + 0.15, 50, -below), part), std::hypot(0.05, std::max(0.0, kDepth - below)),
                2e-5)
        << below;
    // Across the upright edge.
    const double at = 0.15 - 5 / std::numbers::sqrt2;
    EXPECT_NEAR(distance(tool, upright(at, at, -below), part),
                std::hypot(0.05 * std::numbers::sqrt2, std::max(0.0, kDepth - below)), 2e-5);
  }
  EXPECT_LE(distance(tool, upright(-5 + 0.21, 50, -1), part), 0);
  EXPECT_GT(distance(tool, upright(-5 + 0.21, 50, -0.1), part), 0.02);
}

/// In the corner between a floor and a wall the depth is the distance from the corner.
TEST(InnerSurface, IsRoundAboutAnInnerEdge) {
  const auto part = prism({{0, 0}, {0, 50}, {-50, 50}, {-50, -50}, {100, -50}, {100, 0}}, 200);
  const RevolvedBody tool = body(flat_body(5, 100));
  for (int i = 0; i <= 18; ++i) {
    const double angle = i * std::numbers::pi / 36;
    const auto at = [&](double gouge) {
      return distance(tool, upright(5 - gouge * std::sin(angle), 100, -gouge * std::cos(angle)), part);
    };
    EXPECT_GT(at(0.97 * kDepth), 0) << i;
    EXPECT_LE(at(kFacetError * kDepth + 0.001), 1e-6) << i;
  }
}

/// A right angle has three steps of 30 degrees: two facets between its faces. Each ends half a step away from where it
/// touches the round surface, and so do the faces.
TEST(InnerSurface, HasAFacetForEachStepAroundAnInnerEdge) {
  constexpr double kRadius = 2;
  constexpr double kLength = 200;
  const auto part = prism({{0, 0}, {0, 50}, {-50, 50}, {-50, -50}, {100, -50}, {100, 0}}, kLength);
  const InnerSurface inner(part, kRadius);
  const double half = kRadius * std::tan(std::numbers::pi / 12);
  double facets = 0;
  double floor = 0;
  double wall = 0;
  for (const Triangle& face : inner.faces()->triangles()) {
    const Vec3 area = face.area_vector() / 2;
    if (std::abs(area.x()) > 0.1 * area.norm() && std::abs(area.z()) > 0.1 * area.norm()) facets += area.norm();
    if (std::abs(face.highest(Vec3::UnitZ()) + kRadius) < 1e-6 && area.z() > 0.9 * area.norm()) floor += area.norm();
    if (std::abs(face.highest(Vec3::UnitX()) + kRadius) < 1e-6 && area.x() > 0.9 * area.norm()) wall += area.norm();
  }
  EXPECT_NEAR(facets, 2 * 2 * half * kLength, 1e-3);
  EXPECT_NEAR(floor, (100 - kRadius + half) * (kLength - 2 * kRadius), 1);
  EXPECT_NEAR(wall, (50 - kRadius + half) * (kLength - 2 * kRadius), 1);
}

/// Beside a round part a long cutter is deepest where it is nearest to the axis of the part.
TEST(InnerSurface, OfALongCutterIsDeepestBesideThePart) {
  constexpr int kSides = 60;
  constexpr double kHalf = std::numbers::pi / kSides;
  std::vector<geometry::Vec2> outline;
  for (int i = 0; i < kSides; ++i) {
    const double angle = (2 * i + 1) * kHalf;  // The middle of a face is at the outermost X and Z.
    outline.emplace_back(20 * std::cos(angle), 20 * std::sin(angle));
  }
  const auto part = prism(outline, 200);
  for (const RevolvedBody& tool : {body(ball_body(1, 370)), body(flat_body(1, 370)), body(bull_body(1, 0.3, 370))})
    for (const double gouge : {0.21, 0.3, 0.5, 1.0, 2.0}) {
      const double x = 20 * std::cos(kHalf) - gouge + 1;
      for (const double tip : {-200.0, -60.0, -25.0, -5.0}) {
        EXPECT_LE(distance(tool, upright(x, 100, tip), part), 0) << gouge << " from " << tip;
        EXPECT_NEAR(deepest(tool, upright(x, 100, tip), InnerSurface(part, kDepth)).upper, kDepth - gouge, 0.01)
            << gouge << " from " << tip;
      }
    }
}

/// Also of a long cutter that becomes wider upwards, and whose side stands upright beside the part.
TEST(InnerSurface, OfALongTaperedCutterIsDeepestBesideThePart) {
  constexpr int kSides = 60;
  constexpr double kHalf = std::numbers::pi / kSides;
  std::vector<geometry::Vec2> outline;
  for (int i = 0; i < kSides; ++i) {
    const double angle = (2 * i + 1) * kHalf;
    outline.emplace_back(20 * std::cos(angle), 20 * std::sin(angle));
  }
  const auto part = prism(outline, 200);
  const RevolvedBody tool = body(stacked_body(std::vector<StackRow>{{370, 2, 39}}, 10));
  const double lean = std::atan2(18.5, 370);
  const Vec3 axis(std::sin(lean), 0, std::cos(lean));
  const Vec3 aside(std::cos(lean), 0, -std::sin(lean));
  for (const double gouge : {0.21, 0.5, 2.0})
    for (const double low : {-200.0, -60.0, -25.0}) {
      const Vec3 lower_end(20 * std::cos(kHalf) - gouge, 100, low);
      const AxisPlacement at{lower_end + 1 * aside - 10 * axis, axis};
      EXPECT_LE(distance(tool, at, part), 0) << gouge << " from " << low;
      EXPECT_NEAR(distance(tool, at, part), kDepth - gouge, 0.03) << gouge << " from " << low;
    }
}

/// A face with a corner that turns inwards is as deep as any other, all over it: for a tilted tool that reaches into it
/// with its rim alone.
TEST(InnerSurface, CoversAFaceThatTurnsInwards) {
  const auto part = prism({{0, 0}, {0, 50}, {-50, 50}, {-50, 20}, {50, -50}, {100, -50}, {100, 0}}, 200);
  const RevolvedBody tool = body(flat_body(15, 60));
  const Vec3 axis = Vec3(2, -1, 1).normalized();
  const double gouge = 0.5;
  const Vec3 lowest = scenes::farthest_point(tool, {Vec3::Zero(), axis}, Vec3::UnitY());
  int places = 0;
  for (double x = -49; x < 100; x += 3.1)
    for (double z = -49; z < 50; z += 3.1) {
      const bool is_within = part->encloses(Vec3(x - 0.6, 1, z - 0.6)) && part->encloses(Vec3(x + 0.6, 1, z + 0.6));
      if (!is_within) continue;
      ++places;
      ASSERT_NEAR(distance(tool, {Vec3(x, gouge, z) - lowest, axis}, part), kDepth - gouge, 2e-5) << x << ' ' << z;
    }
  EXPECT_GT(places, 300);
}

/// A rib that is thinner than twice the depth has nothing that is deep, and the wall beside it is free to be finished.
TEST(InnerSurface, OfAThinRibIsInNobodysWay) {
  const auto part =
      prism({{-50, -50}, {50, -50}, {50, 0}, {0.15, 0}, {0.15, 30}, {-0.15, 30}, {-0.15, 0}, {-50, 0}}, 200);
  const RevolvedBody tool = body(flat_body(5, 100));
  EXPECT_GT(distance(tool, upright(5.15, 100, 0), part), 0.02);
  EXPECT_GT(distance(tool, upright(5.15, 100, 10), part), 0.02);
  EXPECT_LE(distance(tool, upright(20, 100, -0.21), part), 0);
}

/// A part that is nowhere deep has no inner surface.
TEST(InnerSurface, OfAThinSheetIsEmpty) {
  const auto part = std::make_shared<const Mesh>(scenes::box_triangles({{0, 0, 0}, {0.1, 0.1, 0.1}}));
  EXPECT_GT(distance(body(flat_body(5, 60)), upright(0, 0, 0), part, 1), 0);
}

/// How deep a point is in a mesh, from all of its triangles; negative outside.
double depth_of(const Mesh& mesh, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh.triangles())
    nearest = std::min(nearest, (triangle.nearest(point) - point).norm());
  return mesh.encloses(point) ? nearest : -nearest;
}

/// Points of a tool's surface, close to one another at its end.
std::vector<Vec3> surface_points(const RevolvedBody& tool, const AxisPlacement& at) {
  std::vector<Vec3> points;
  const Vec3 side = at.axis.unitOrthogonal();
  const Vec3 other = at.axis.cross(side);
  for (int i = 0; i < 240; ++i) {
    const double angle = i * std::numbers::pi / 120;
    const Vec3 outwards = std::cos(angle) * side + std::sin(angle) * other;
    for (const BodyPiece& piece : tool.pieces())
      for (int k = 0; k <= 6; ++k) {
        const double tilt = -std::numbers::pi / 2 * k / 6;
        const Vec3 rounded = piece.rounding * (std::cos(tilt) * outwards + std::sin(tilt) * at.axis);
        const double part = k / 6.0;
        const double r = piece.core.bottom_radius + part * (piece.core.top_radius - piece.core.bottom_radius);
        const double z = piece.core.bottom + part * (piece.core.top - piece.core.bottom);
        points.push_back(at.at(piece.core.bottom) + piece.core.bottom_radius * outwards + rounded);
        points.push_back(at.at(z) + r * outwards);
      }
  }
  return points;
}

/// In bumpy parts, too, what goes clearly deeper is found, and what is found is a point of the tool that is so deep.
TEST(InnerSurface, FindsWhatIsDeepAndNothingElse) {
  std::size_t deep = 0;
  for (const std::uint64_t seed : support::seeds(60)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto part = std::make_shared<const Mesh>(scenes::bumpy_ball(Vec3(0, 0, 0), 40, 12, 0.08));
    const double radius = random.real(1, 8);
    const RevolvedBody tool = random.one_in(2)   ? body(flat_body(radius, 60))
                              : random.one_in(2) ? body(bull_body(radius, radius / 3, 60))
                                                 : body(cone_body(radius, 0, 90, 60));
    const scenes::Touch touch = scenes::any_touch(random, *part);
    const Vec3 axis = (touch.normal + 0.7 * scenes::any_direction(random)).normalized();
    const AxisPlacement at = scenes::placed_at_gap(tool, axis, touch, -random.real(0, 0.8));
    const Clearance found = clearance(tool, at, InnerSurface(part, kDepth));
    double deepest = -1;
    for (const Vec3& point : surface_points(tool, at)) {
      if ((point - touch.point).norm() < 15) deepest = std::max(deepest, depth_of(*part, point));
    }
    if (deepest > kFacetError * kDepth + 0.01) {
      ++deep;
      EXPECT_LE(found.upper, 0.02) << deepest;
      EXPECT_LE(solids::deepest(tool, at, InnerSurface(part, kDepth)).upper, kDepth - deepest + 0.05) << deepest;
    }
    if (!(found.upper <= 0)) continue;
    EXPECT_NEAR(depth_of(*part, found.on_body), kDepth - found.upper, 1e-5);
    double off = std::numeric_limits<double>::infinity();
    for (const BodyPiece& piece : tool.pieces())
      off =
          std::min(off, (PlacedFrustum(piece.core, at).nearest(found.on_body) - found.on_body).norm() - piece.rounding);
    EXPECT_LE(off, 1e-5);
  }
  EXPECT_GT(deep, 5U);
}

}  // namespace
}  // namespace isocnc::solids
