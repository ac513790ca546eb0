#pragma once

#include <limits>
#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/timing/timing.h"
#include "interpreter/verification/body_pairs.h"

namespace isocnc::verification {

/// The bodies of a machine that are near each other where it stands at home, as it does when a program starts.
NeighborsAtHome neighbors_at_home(const Scene& scene, const timing::TimedMachine& machine);

/// An obstacle, and how near the machine is to it.
struct Neighbor {
  dialect::GivenName who;   ///< The nearest part of the machine.
  dialect::GivenName whom;  ///< The obstacle.
  BodyRole role = BodyRole::Fixture;
  BodyDescription described;                                  ///< Where the obstacle is described.
  double distance = std::numeric_limits<double>::infinity();  ///< mm; negative: how deep they overlap.
  /// The distance of what should stay away from it, mm: not of a cutter from the spoilboard or the finished part, which
  /// it may touch.
  double clearance = std::numeric_limits<double>::infinity();
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Of the obstacle; mm, as in Contact.
  bool touches = false;                           ///< See is_contact().

  /// Whether a motion to here is a contact. The cutter touches none of the board that it is allowed to cut.
  bool is_contact() const { return touches; }
};

/// The obstacles around the machine where its joints are at `joints`, nearest first.
std::vector<Neighbor> neighbors_at(const BodyPairs& bodies, const kinematics::Kinematics& kinematics,
                                   const kinematics::Coordinates& joints);

/// The obstacles that a motion brings nearer than `within` mm, nearest first: the smallest distances on the programmed
/// path, to within 0.1 mm. `bodies` are those of the tool that makes the motion.
std::vector<Neighbor> neighbors_along(const BodyPairs& bodies, const kinematics::Machine& machine,
                                      const kinematics::Move& move, double within);

}  // namespace isocnc::verification
