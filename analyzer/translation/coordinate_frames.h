#pragma once

#include <array>
#include <map>
#include <optional>

#include "interpreter/geometry/vectors.h"

namespace isocnc::translation {

/// A plane of arcs and rotations: a counterclockwise turn leads from u to v. Axes: 0 X, 1 Y, 2 Z.
struct ForeignPlane {
  int g = 17;
  int u = 0, v = 1, normal = 2;
};
const ForeignPlane& foreign_plane(int g);

/// G68: the coordinates are turned about a point of the plane.
struct TurnedCoordinates {
  ForeignPlane plane;
  double center_u = 0;  ///< mm.
  double center_v = 0;
  double degrees = 0;  ///< Counterclockwise, in [-180, 180].

  /// From turned coordinates to those that are not turned, and back.
  geometry::Vec3 turned(const geometry::Vec3& point) const { return rotated(point, degrees); }
  geometry::Vec3 turned_back(const geometry::Vec3& point) const { return rotated(point, -degrees); }

  friend bool operator==(const TurnedCoordinates& a, const TurnedCoordinates& b) {
    return a.plane.g == b.plane.g && a.center_u == b.center_u && a.center_v == b.center_v && a.degrees == b.degrees;
  }

 private:
  geometry::Vec3 rotated(const geometry::Vec3& point, double by) const;
};

/// Where the tool is, mm, as far as the program says.
struct KnownPlace {
  geometry::Vec3 at = geometry::Vec3::Zero();
  std::array<bool, 3> known{};
};

/// The coordinate system of another control: a zero point (G54 to G59.3), two shifts and a rotation. Lengths in mm.
///
/// machine = zero + local + shift + turned(program)
class CoordinateFrames {
 public:
  explicit CoordinateFrames(std::map<int, geometry::Vec3> zeros) : zeros_(std::move(zeros)) {}

  int selected = 540;                             ///< G54, in tenths.
  geometry::Vec3 local = geometry::Vec3::Zero();  ///< G52.
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< G92.
  std::optional<TurnedCoordinates> rotation;

  /// The zero point, in machine coordinates; nothing where it has not been given.
  std::optional<geometry::Vec3> zero(int name) const;
  void set_zero(int name, const geometry::Vec3& at) { zeros_[name] = at; }
  void forget_zero(int name) { zeros_.erase(name); }
  void forget_zeros() { zeros_.clear(); }
  bool has_zero() const { return zeros_.contains(selected); }
  /// Where the frame lies before it is turned, in machine coordinates. The zero point must be known.
  geometry::Vec3 origin() const { return *zero(selected) + local + shift; }

  KnownPlace to_machine(const KnownPlace& program) const;
  KnownPlace from_machine(const KnownPlace& machine) const;

 private:
  std::map<int, geometry::Vec3> zeros_;
};

}  // namespace isocnc::translation
