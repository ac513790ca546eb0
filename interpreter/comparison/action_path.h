#pragma once

#include <optional>
#include <span>
#include <vector>

#include "interpreter/comparison/machine_action.h"
#include "interpreter/geometry/helix.h"
#include "interpreter/kinematics/independent_rapid.h"

namespace isocnc::comparison {

/// The path of the tip in one motion, as a function of the part that is traveled, 0 to 1.
class ActionPath {
 public:
  ActionPath(const RecordedRun& run, const MachineAction& motion);

  bool is_straight() const { return !is_arc_ && !motion_.is_by_joints; }
  geometry::Pose at(double part) const;
  /// The nearest place to a pose of the path from `from_part` on; of rapids by joints the one that is nearest in
  /// joints. `from_part` decides between the places of a full circle, too. None if the path is a point.
  std::optional<double> nearest(const geometry::Pose& pose, double from_part) const;
  double length() const;

 private:
  const kinematics::Kinematics& kinematics() const { return run_.machine.kinematics; }
  kinematics::Coordinates joints(double part) const;
  double nearest_in_joints(const kinematics::Coordinates& there, double from_part) const;

  const RecordedRun& run_;
  const MachineAction& motion_;
  bool is_arc_;
  double tool_length_ = 0;
  kinematics::Coordinates from_joints_;  ///< Of a rapid by joints.
  kinematics::Coordinates along_joints_;
  std::vector<kinematics::RapidPart> parts_;  ///< Of a rapid whose joints move independently.
  geometry::Helix helix_;
};

/// The path of several motions as a chain of points, from the start of the first motion. Arcs are chords that are at
/// most `deviation` mm from them.
std::vector<geometry::Vec3> chain_of(const RecordedRun& run, std::span<const MachineAction> actions, double deviation);

/// How far a point of a chain is at most from another one, mm; else as distance_of().
std::optional<double> distance_from(std::span<const geometry::Vec3> chain, std::span<const geometry::Vec3> other,
                                    double accuracy, std::size_t* left = nullptr);

/// Hausdorff distance of two chains of points, mm: how far a point of one is at most from the other. The result is at
/// most `accuracy` below. None where it would take too long: `left` is how many distances from points to lines are left
/// for this and others.
std::optional<double> distance_of(std::span<const geometry::Vec3> a, std::span<const geometry::Vec3> b, double accuracy,
                                  std::size_t* left = nullptr);

/// By how much B or C differ at most where two paths are nearest to each other, degrees; `shift` leads from the first
/// to the second. Both are taken as straight between the ends of their motions. None as for distance_of().
std::optional<double> turn_between(std::span<const MachineAction> a, std::span<const MachineAction> b,
                                   const geometry::Vec3& shift, std::size_t* left = nullptr);

/// Whether two chains can be traveled from their starts to their ends, never back, with both places at most `distance`
/// apart: whether that is not below their Fréchet distance. Takes time in proportion to the product of their sizes.
bool goes_along(std::span<const geometry::Vec3> a, std::span<const geometry::Vec3> b, double distance);

}  // namespace isocnc::comparison
