#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "cuts.h"
#include "tests/support/random.h"

/// Random sweeps against points: whether a point is within a body somewhere on its path, by another calculation, in
/// long double, from the definition of the body and the path alone.
namespace isocnc::stock::cuts {
namespace {

using support::Random;
using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;

struct RealPlacement {
  RealVec origin;
  RealVec axis;
};
using RealPath = std::function<RealPlacement(Real share)>;

Real distance_to_segment(Real x, Real y, Real x0, Real y0, Real x1, Real y1) {
  const Real dx = x1 - x0;
  const Real dy = y1 - y0;
  const Real square = dx * dx + dy * dy;
  const Real share = square > 0 ? std::clamp<Real>(((x - x0) * dx + (y - y0) * dy) / square, 0, 1) : 0;
  return std::hypot(x - x0 - share * dx, y - y0 - share * dy);
}

/// Negative within the piece.
Real signed_distance(const solids::BodyPiece& piece, const RealPlacement& at, const RealVec& point) {
  const RealVec w = point - at.origin;
  const Real z = w.dot(at.axis);
  const Real r = (w - z * at.axis).norm();
  const solids::Frustum& core = piece.core;
  // The outline of the core in the half plane of the axis: lower disc, side, upper disc.
  Real distance = distance_to_segment(z, r, core.bottom, core.bottom_radius, core.top, core.top_radius);
  distance = std::min(distance, distance_to_segment(z, r, core.bottom, 0, core.bottom, core.bottom_radius));
  distance = std::min(distance, distance_to_segment(z, r, core.top, 0, core.top, core.top_radius));
  const Real height = core.top - core.bottom;
  const bool is_inside = height > 0 && z >= core.bottom && z <= core.top &&
                         r <= core.bottom_radius + (core.top_radius - core.bottom_radius) * (z - core.bottom) / height;
  return (is_inside ? -distance : distance) - Real(piece.rounding);
}

/// The minimum of the signed distance from any piece on the way: by samples, then by golden sections around the best of
/// them. Along a straight line the distance from a piece is convex.
Real signed_distance(const RevolvedBody& body, const RealPath& path, const RealVec& point, int samples) {
  Real nearest = 1e9L;
  for (const solids::BodyPiece& piece : body.pieces()) {
    const auto at = [&](Real share) { return signed_distance(piece, path(share), point); };
    Real best = 1e9L;
    int where = 0;
    for (int i = 0; i <= samples; ++i) {
      const Real found = at(Real(i) / samples);
      if (found >= best) continue;
      best = found;
      where = i;
    }
    Real low = Real(std::max(0, where - 1)) / samples;
    Real high = Real(std::min(samples, where + 1)) / samples;
    for (int i = 0; i < 26; ++i) {
      const Real one = low + (high - low) * 0.382L;
      const Real other = low + (high - low) * 0.618L;
      const Real of_one = at(one);
      const Real of_other = at(other);
      best = std::min({best, of_one, of_other});
      if (of_one < of_other) {
        high = other;
      } else {
        low = one;
      }
    }
    nearest = std::min(nearest, best);
  }
  return nearest;
}

RealVec real(const Vec3& vector) { return vector.cast<Real>(); }

RealPath path_of(const SweepPath& path) {
  if (const auto* straight = std::get_if<StraightPath>(&path)) {
    return [straight](Real share) {
      return RealPlacement{real(straight->from.origin) + share * (real(straight->to) - real(straight->from.origin)),
                           real(straight->from.axis)};
    };
  }
  if (const auto* helix = std::get_if<HelixPath>(&path)) {
    return [helix](Real share) {
      const geometry::Helix& h = helix->helix;
      const Real angle = share * Real(h.sweep);
      return RealPlacement{
          real(h.center) + std::cos(angle) * real(h.out) + std::sin(angle) * real(h.side) + share * real(h.rise),
          real(helix->axis)};
    };
  }
  const auto* turning = std::get_if<TurningPath>(&path);
  return [turning](Real share) {
    const RealVec from = real(turning->from.axis);
    const RealVec to = real(turning->to.axis);
    const Real angle = std::acos(std::clamp<Real>(from.dot(to), -1, 1));
    const RealVec aside = (to - to.dot(from) * from).normalized();
    return RealPlacement{real(turning->from.origin) + share * (real(turning->to.origin) - real(turning->from.origin)),
                         std::cos(share * angle) * from + std::sin(share * angle) * aside};
  };
}

RevolvedBody any_body(Random& random) {
  const double radius = random.real(1, 12);
  const double length = 2 * radius + random.real(5, 40);
  switch (random.between(0, 8)) {
    case 0:
      return flat(radius, length);
    case 1:
      return ball(radius, length);
    case 2:
      return body(solids::bull_body(radius, random.real(0.05, 0.95) * radius, length));
    case 3:
      return body(solids::cone_body(radius, random.real(0, 1) * radius, random.real(20, 160), length));
    case 4:
      return body(solids::drill_body(radius, random.real(60, 150), length + 20));
    case 5:
      return body(solids::disc_body(radius + 5, random.real(0.5, 6)));
    case 6: {
      // A holder, grown by a clearance.
      const std::vector<solids::StackRow> rows = {{random.real(2, 10), 2 * radius, radius},
                                                  {random.real(2, 10), 3 * radius, 3 * radius},
                                                  {random.real(2, 10), 2 * radius, 4 * radius}};
      std::vector<solids::BodyPiece> pieces;
      const RevolvedBody stack = body(solids::stacked_body(rows, random.real(-5, 10)));
      for (solids::BodyPiece piece : stack.pieces()) {
        piece.rounding = radius / 4;
        pieces.push_back(piece);
      }
      return RevolvedBody(pieces);
    }
    case 7: {
      const std::vector<solids::FormPoint> points = {
          {0, 0},          {0, radius / 3}, {2, radius},       {5, radius / 2},
          {5, radius / 4}, {9, radius / 4}, {9, radius / 1.5}, {length, radius}};
      return body(solids::form_body(points));
    }
    default: {  // A T slot cutter with its shank.
      const std::vector<solids::FormPoint> points = {{0, radius}, {3, radius}, {3, radius / 2}, {length, radius / 2}};
      return body(solids::form_body(points));
    }
  }
}

Vec3 any_point(Random& random) { return {random.real(-20, 20), random.real(-20, 20), random.real(-25, 10)}; }

Vec3 any_axis(Random& random) {
  const double tilt = random.real(0, pi);
  const double around = random.real(0, 2 * pi);
  return {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)};
}

/// Checks that every point that is surely within the sweep has been removed, and none that is surely outside.
void expect_as_sampled(const Sweep& sweep, Random& random, double tolerance, int samples, std::string what) {
  for (const solids::BodyPiece& piece : sweep.body->pieces()) {
    const solids::Frustum& core = piece.core;
    for (const double number : {core.bottom, core.bottom_radius, core.top, core.top_radius, piece.rounding})
      what += ' ' + std::to_string(number);
    what += ';';
  }
  const RealPath shown = path_of(sweep.path);
  for (const Real share : {0.0L, 0.5L, 1.0L})
    for (const RealVec& vector : {shown(share).origin, shown(share).axis})
      for (const Real number : vector) what += ' ' + std::to_string(number);
  Stock stock(box({-30, -30, -30}, {30, 30, 15}), 1);
  stock.apply(std::span(&sweep, 1));
  const RealPath path = path_of(sweep.path);
  const DexelGrid& grid = stock.grid();
  for (int i = 0; i < 60; ++i) {
    const double x = grid.x(random.between(0, grid.columns - 1));
    const double y = grid.y(random.between(0, grid.rows - 1));
    const std::vector<HeightInterval> left = stock.intervals_at(x, y);
    // Points anywhere, and just above and below each end.
    std::vector<double> heights = {random.real(-30, 15), random.real(-30, 15)};
    for (const HeightInterval& interval : left)
      for (const double end : {interval.bottom, interval.top})
        for (const double side : {-2 * tolerance, 2 * tolerance}) heights.push_back(end + side);
    for (const double z : heights) {
      if (z <= -30 || z >= 15) continue;
      const bool is_left = std::any_of(left.begin(), left.end(),
                                       [&](const HeightInterval& each) { return z > each.bottom && z < each.top; });
      const Real distance = signed_distance(*sweep.body, path, RealVec(x, y, z), samples);
      if (is_left) {
        ASSERT_GE(distance, -tolerance) << what << ": material is left at " << x << ' ' << y << ' ' << z;
      } else {
        ASSERT_LE(distance, tolerance) << what << ": material is missing at " << x << ' ' << y << ' ' << z;
      }
    }
  }
}

TEST(PointSampling, VerticalAxisAlongLines) {
  for (const std::uint64_t seed : support::seeds(100)) {
    Random random(seed);
    const RevolvedBody tool = any_body(random);
    const Vec3 from = any_point(random);
    Vec3 to = any_point(random);
    if (random.one_in(3)) to.z() = from.z();
    if (random.one_in(5)) to.head<2>() = from.head<2>();
    if (random.one_in(6)) to = from;
    const Vec3 axis(0, 0, random.one_in(5) ? -1 : 1);
    expect_as_sampled(line(tool, from, to, axis), random, 0.001, 24, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST(PointSampling, VerticalAxisAlongArcs) {
  for (const std::uint64_t seed : support::seeds(40)) {
    Random random(seed);
    const RevolvedBody tool = any_body(random);
    const Vec3 from = any_point(random);
    const double degrees = (random.one_in(2) ? 1 : -1) * random.real(5, 360);
    const bool is_level = random.one_in(2);
    const Vec3 normal = is_level ? Vec3(0, 0, 1) : any_axis(random);
    const Vec3 out = normal.cross(any_axis(random)).normalized() * random.real(1, 15);
    const Eigen::AngleAxisd rotation(degrees * pi / 180, normal);
    const Vec3 center = from - out;
    Vec3 to = center + rotation * out;
    if (random.one_in(2)) to += random.real(-8, 8) * normal;
    expect_as_sampled(arc(tool, from, to, center, degrees, normal), random, 0.012, 100, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST(PointSampling, TiltedAxisAlongLines) {
  for (const std::uint64_t seed : support::seeds(100)) {
    Random random(seed);
    const RevolvedBody tool = any_body(random);
    const Vec3 from = any_point(random);
    Vec3 to = any_point(random);
    Vec3 axis = any_axis(random);
    if (random.one_in(6)) axis = Vec3(1, 0, 0);
    if (random.one_in(6)) to = from;
    if (random.one_in(4)) to = from + random.real(-30, 30) * axis;  // Along the axis.
    if (random.one_in(4)) to = from + random.real(-30, 30) * axis.cross(Vec3(0.3, 0.4, 0.2)).normalized();  // Across.
    expect_as_sampled(line(tool, from, to, axis), random, 0.001, 24, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST(PointSampling, TurningAxis) {
  for (const std::uint64_t seed : support::seeds(20)) {
    Random random(seed);
    const RevolvedBody tool = any_body(random);
    const Vec3 from = any_point(random);
    const Vec3 to = random.one_in(3) ? from : Vec3(from + any_point(random) / 5);
    const Vec3 axis = any_axis(random);
    const Vec3 other = (axis + random.real(0.01, 0.8) * any_axis(random)).normalized();
    expect_as_sampled(turn(tool, {from, axis}, {to, other}), random, 0.1, 60, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace isocnc::stock::cuts
