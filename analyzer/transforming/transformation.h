#pragma once

#include <cstdint>
#include <string_view>

#include "interpreter/execution/state.h"

namespace isocnc::transforming {

enum class Movement : std::uint8_t { None, MirrorX, MirrorY, Rotate, Shift, Repeat };

/// Lengths and angles beyond this are mistakes; mm, degrees. So are feed factors beyond the other two.
inline constexpr double kMaxPlace = 1e6;
inline constexpr double kMinFeedFactor = 0.001;
inline constexpr double kMaxFeedFactor = 1000;
/// More copies are a mistake.
inline constexpr int kMaxCopies = 1000;

/// What is done to a program. Its places are those of the workpiece frame (G92, I.3.2); lengths in mm, angles in
/// degrees.
struct Transformation {
  Movement movement = Movement::None;
  /// Mirrors: x or y stays where it equals that of `place`. Rotate: the center, counterclockwise seen from above.
  /// Shift: the way. Repeat: the way in x from column to column, and that in y from row to row.
  geometry::Vec3 place = geometry::Vec3::Zero();
  double degrees = 0;  ///< Rotate.
  int columns = 1;     ///< Repeat; with `rows` at most kMaxCopies in all.
  int rows = 1;
  double feed_factor = 1;  ///< Each F is multiplied by it; positive.
};

/// Where a pose goes: an isometry of the tip, and what B and C become with it so that the tool leans as the workpiece
/// does (D28, D30).
struct PoseMap {
  geometry::Mat3 linear = geometry::Mat3::Identity();
  geometry::Vec3 offset = geometry::Vec3::Zero();
  double b_sign = 1;
  double c_sign = 1;
  double c_offset = 0;  ///< Degrees.

  geometry::Vec3 point(const geometry::Vec3& p) const { return linear * p + offset; }
  geometry::Pose pose(const geometry::Pose& p) const { return {point(p.tip), b_sign * p.b, c_sign * p.c + c_offset}; }
  /// What becomes of an axis to turn about: a mirror exchanges the senses.
  geometry::Vec3 turn(const geometry::Vec3& axis) const { return linear.determinant() * (linear * axis); }
  /// Whether planes along a normal (0 to 2: X, Y, Z) stay such planes. If not, they hold no arcs any more.
  bool keeps_plane(int normal) const;
  /// Whether G02 and G03, G41 and G42 change places in such a plane (D40).
  bool flips_plane(int normal) const { return turn(geometry::Vec3::Unit(normal))[normal] < 0; }
  /// The same map as seen from a frame with this origin and parallel axes.
  PoseMap about(const geometry::Vec3& origin) const;
};

/// The map of coordinates in the workpiece frame.
PoseMap workpiece_map(const Transformation& transformation);

/// The map of coordinates in a face frame, which is itself transformed. A mirrored face stays right-handed, so that its
/// X (or Y) changes its sign there, too.
PoseMap face_map(const Transformation& transformation);

/// A transformation as it applies to one program.
class ProgramMap {
 public:
  /// Reads which frames the program has. In a program with a workpiece frame of its own (a G92 that is not all 0),
  /// coordinates in the machine frame are places of the machine, such as where it parks: they stay.
  ProgramMap(const Transformation& transformation, std::string_view text);

  const Transformation& transformation() const { return transformation_; }
  /// Whether the coordinates of a state are places of the machine.
  bool stays(const execution::State& state) const;
  /// The map of coordinates in the workpiece frame of a state.
  PoseMap in_workpiece(const execution::State& state) const;
  /// The map of coordinates in the frame in force.
  PoseMap in_force(const execution::State& state) const;
  /// The map of places in the machine frame, while the frame of this state is in force.
  PoseMap in_machine(const execution::State& state) const { return in_workpiece(state).about(state.workpiece_origin); }

 private:
  Transformation transformation_;
  PoseMap workpiece_;
  PoseMap face_;
  bool has_workpiece_frame_ = false;
};

}  // namespace isocnc::transforming
