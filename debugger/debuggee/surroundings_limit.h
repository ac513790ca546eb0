#pragma once

#include <cstddef>
#include <vector>

#include "interpreter/motion/stretch.h"
#include "interpreter/verification/surroundings.h"

namespace isocnc::debuggee {

/// A limit of how near the machine comes to what surrounds it: `CLEARANCE < 5`, `DEPTH > 1`.
struct SurroundingsLimit {
  bool is_of_depth = false;    ///< Of the depth; otherwise of the clearance.
  bool is_from_below = false;  ///< Larger values are beyond it; otherwise smaller ones.
  double value = 0;            ///< mm

  /// How far the machine is from being beyond the limit, mm; negative where it is. It changes by no more than points of
  /// bodies travel.
  double margin(const std::vector<verification::Neighbor>& neighbors) const;
  /// By at least a millionth of a mm, so that where a run stops the comparison surely holds.
  bool is_beyond(const std::vector<verification::Neighbor>& neighbors) const;
};

/// The machine comes to be beyond a limit.
struct LimitCrossing {
  double time = 0;        ///< Seconds since the start.
  std::size_t limit = 0;  ///< Index of the limit.
};

/// The times within a stretch at which the machine comes to be beyond a limit, in their order. What is beyond it for
/// less than 0.1 mm of travel may be missed. `bodies` are those of the tool that makes the motion.
std::vector<double> crossings_of(const SurroundingsLimit& limit, const motion::Stretch& stretch,
                                 const verification::BodyPairs& bodies, const kinematics::Kinematics& kinematics);

}  // namespace isocnc::debuggee
