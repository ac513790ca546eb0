#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "interpreter/solids/clearance.h"
#include "interpreter/solids/tool_shapes.h"
#include "tests/support/random.h"

/// Random bodies and obstacles, and what is known of them by means that the library does not use.
namespace isocnc::solids::scenes {

using geometry::Vec3;
using support::Random;

inline constexpr double kSceneError = 1e-9;  ///< By so much the construction of a scene itself may be off, mm.

inline RevolvedBody body(const BodyOrProblem& made) { return std::get<RevolvedBody>(made); }

inline AxisPlacement upright(double x, double y, double z) { return {{x, y, z}, {0, 0, 1}}; }

/// A prism along Y from 0 to `length`. The outline in X and Z is seen from the front, counterclockwise, and from its
/// first corner all of it can be seen.
inline std::shared_ptr<const Mesh> prism(const std::vector<geometry::Vec2>& outline, double length) {
  std::vector<Triangle> triangles;
  const auto at = [&](std::size_t i, double y) {
    const geometry::Vec2& corner = outline[i % outline.size()];
    return Vec3(corner.x(), y, corner.y());
  };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    triangles.push_back({{at(i, 0), at(i + 1, 0), at(i + 1, length)}});
    triangles.push_back({{at(i, 0), at(i + 1, length), at(i, length)}});
  }
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    triangles.push_back({{at(0, 0), at(i + 1, 0), at(i, 0)}});
    triangles.push_back({{at(0, length), at(i, length), at(i + 1, length)}});
  }
  for (Triangle& triangle : triangles) std::swap(triangle.corners[1], triangle.corners[2]);
  return std::make_shared<const Mesh>(std::move(triangles));
}

inline Vec3 any_direction(Random& random) {
  const double z = random.real(-1, 1);
  const double angle = random.real(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

inline Vec3 any_point(Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

/// One of each kind, in sizes of the workshop.
inline RevolvedBody any_body(Random& random) {
  const double radius = random.real(0.5, 60);
  const double length = 2 * radius + random.real(1, 150);
  switch (random.between(0, 7)) {
    case 0:
      return body(flat_body(radius, length));
    case 1:
      return body(ball_body(radius, length));
    case 2:
      return body(bull_body(radius, random.real(0.01, 1) * radius, length));
    case 3:
      return body(cone_body(radius, random.real(0, 1) * radius, random.real(20, 160), length));
    case 4:
      return body(drill_body(radius, random.real(60, 150), length + radius));
    case 5:
      return body(disc_body(radius + 40, random.real(0.5, 6)));
    case 6: {
      const std::vector<StackRow> rows = {{random.real(1, 40), 2 * radius, radius},
                                          {random.real(1, 40), 3 * radius, 3 * radius},
                                          {random.real(1, 40), 2 * radius, 4 * radius}};
      return body(stacked_body(rows, random.real(-10, 100)));
    }
    default: {
      const std::vector<FormPoint> points = {{0, 0},          {0, radius / 3}, {2, radius},       {5, radius / 2},
                                             {5, radius / 4}, {9, radius / 4}, {9, radius / 1.5}, {9 + length, radius}};
      return body(form_body(points));
    }
  }
}

/// The point of a body that is farthest in the direction `n`.
inline Vec3 farthest_point(const RevolvedBody& body, const AxisPlacement& at, const Vec3& n) {
  const double along = n.dot(at.axis);
  const Vec3 across = n - along * at.axis;
  const Vec3 radial = across.norm() > 1e-12 ? Vec3(across.normalized()) : Vec3(Vec3::Zero());
  Vec3 best = Vec3::Zero();
  double farthest = -1e300;
  for (const BodyPiece& piece : body.pieces())
    for (const auto& [z, r] :
         {std::pair(piece.core.bottom, piece.core.bottom_radius), std::pair(piece.core.top, piece.core.top_radius)}) {
      const Vec3 point = at.origin + z * at.axis + r * radial + piece.rounding * n;
      if (point.dot(n) <= farthest) continue;
      farthest = point.dot(n);
      best = point;
    }
  return best;
}

inline Cuboid any_cuboid(Random& random) {
  const Vec3 corner = any_point(random, 300);
  return {corner, corner + Vec3(random.real(0.1, 200), random.real(0.1, 200), random.real(0.1, 200))};
}

inline Cylinder any_cylinder(Random& random) {
  return {.at = {any_point(random, 300), any_direction(random)},
          .height = random.real(0.1, 200),
          .radius = random.real(0.1, 100)};
}

/// The twelve triangles of a box, counterclockwise seen from outside.
inline std::vector<Triangle> box_triangles(const Cuboid& box) {
  const auto corner = [&](int index) {
    return Vec3((index & 1) != 0 ? box.maximum.x() : box.minimum.x(),
                (index & 2) != 0 ? box.maximum.y() : box.minimum.y(),
                (index & 4) != 0 ? box.maximum.z() : box.minimum.z());
  };
  constexpr int kQuads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Triangle> triangles;
  for (const auto& quad : kQuads) {
    triangles.push_back({{corner(quad[0]), corner(quad[1]), corner(quad[2])}});
    triangles.push_back({{corner(quad[0]), corner(quad[2]), corner(quad[3])}});
  }
  return triangles;
}

/// A ball of 8 * steps^2 or so triangles with bumps; every triangle's corners run counterclockwise seen from outside.
inline std::vector<Triangle> bumpy_ball(const Vec3& center, double radius, int steps, double bumps) {
  const auto point = [&](int i, int j) {
    const int around = 2 * steps;
    const double tilt = std::numbers::pi * i / steps;
    const double turn = 2 * std::numbers::pi * (j % around) / around;
    const double r = radius * (1 + (i == 0 || i == steps ? 0 : bumps * std::sin(3 * tilt) * std::cos(5 * turn)));
    const double across = i == 0 || i == steps ? 0 : std::sin(tilt);
    return Vec3(center + r * Vec3(across * std::cos(turn), across * std::sin(turn), std::cos(tilt)));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      if (i > 0) triangles.push_back({{point(i, j), point(i + 1, j), point(i, j + 1)}});
      if (i + 1 < steps) triangles.push_back({{point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)}});
    }
  return triangles;
}

/// Unit normal of a random plane that touches a box from outside, and a point in which it does. A corner, an edge or a
/// face, one as often as the other.
struct Touch {
  Vec3 point;
  Vec3 normal;
};

inline Touch any_touch(Random& random, const Cuboid& box) {
  Touch touch{box.middle(), Vec3::Zero()};
  const int free_axes = random.between(0, 2);
  const int first = random.between(0, 2);
  for (int i = 0; i < 3; ++i) {
    const int axis = (first + i) % 3;
    if (i < free_axes) {
      touch.point[axis] = random.real(box.minimum[axis], box.maximum[axis]);
    } else {
      const bool is_high = random.one_in(2);
      touch.point[axis] = is_high ? box.maximum[axis] : box.minimum[axis];
      touch.normal[axis] = random.real(0.01, 1) * (is_high ? 1 : -1);
    }
  }
  touch.normal.normalize();
  return touch;
}

inline Touch any_touch(Random& random, const Cylinder& cylinder) {
  const Vec3 axis = cylinder.at.axis;
  const Vec3 radial = axis.cross(any_direction(random)).normalized();
  const int kind = random.between(0, 2);  // Side, face or rim.
  const bool is_top = random.one_in(2);
  const double z = kind == 0 ? random.real(0, cylinder.height) : is_top ? cylinder.height : 0.0;
  const double r = kind == 1 ? random.real(0, cylinder.radius) : cylinder.radius;
  const double up = kind == 0 ? 0 : random.real(0.01, 1) * (is_top ? 1 : -1);
  const double out = kind == 1 ? 0 : random.real(0.01, 1);
  return {cylinder.at.at(z) + r * radial, (out * radial + up * axis).normalized()};
}

/// The corner of a mesh that is farthest in a random direction.
inline Touch any_touch(Random& random, const Mesh& mesh) {
  Touch touch{Vec3::Zero(), any_direction(random)};
  double farthest = -1e300;
  for (const Triangle& triangle : mesh.triangles())
    for (const Vec3& corner : triangle.corners)
      if (corner.dot(touch.normal) > farthest) {
        farthest = corner.dot(touch.normal);
        touch.point = corner;
      }
  return touch;
}

/// Places a body at a gap from what the touched plane bounds. If the gap is positive, the distance is exactly the gap:
/// the plane separates both, and the two points in line with its normal have that distance. If it is negative, and
/// smaller than the obstacle, the body's farthest point lies in the obstacle.
inline AxisPlacement placed_at_gap(const RevolvedBody& body, const Vec3& axis, const Touch& touch, double gap) {
  const Vec3 farthest = farthest_point(body, {Vec3::Zero(), axis}, -touch.normal);
  return {touch.point + gap * touch.normal - farthest, axis};
}

inline Placement any_placement(Random& random, double size) {
  Placement at = Placement::Identity();
  at.linear() = Eigen::AngleAxisd(random.real(-3.2, 3.2), any_direction(random)).toRotationMatrix();
  at.translation() = any_point(random, size);
  return at;
}

/// Places a solid at a gap from what the touched plane bounds, with a touched plane of its own against it: corners,
/// edges and faces meet each other. If the gap is positive, the distance is exactly the gap, as above.
inline Placement placed_at_gap(Random& random, const Touch& own, const Touch& touch, double gap) {
  const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(own.normal, -touch.normal);
  const Eigen::AngleAxisd spin(random.one_in(3) ? 0.0 : random.real(-3.2, 3.2), touch.normal);
  Placement at = Placement::Identity();
  at.linear() = (spin * facing).normalized().toRotationMatrix();
  at.translation() = touch.point + gap * touch.normal - at.linear() * own.point;
  return at;
}

}  // namespace isocnc::solids::scenes
