#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "interpreter/motion/stretch.h"
#include "interpreter/verification/surroundings.h"

namespace isocnc::debuggee {

/// By how much a contact is deeper in a block than before it, to be asked about again, mm: corners that are rounded
/// make less.
inline constexpr double kDeeper = 0.05;

/// What of the surroundings a limit is for.
enum class LimitedQuantity : std::uint8_t {
  Clearance,  ///< mm
  Depth,      ///< mm
  Removed,    ///< By the present block, mm^3.
  InCut,      ///< 1 while the cutter removes material, else 0.
};

/// A limit of how near the machine comes to what surrounds it, or of what it removes: `CLEARANCE < 5`, `DEPTH > 1`,
/// `REMOVED > 100`, `INCUT = 1`.
struct SurroundingsLimit {
  LimitedQuantity of = LimitedQuantity::Clearance;
  bool is_from_below = false;  ///< Larger values are beyond it; otherwise smaller ones.
  double value = 0;            ///< In the unit of the quantity.
  bool is_either_way = false;  ///< InCut: each change counts.

  bool is_of_obstacles() const { return of == LimitedQuantity::Clearance || of == LimitedQuantity::Depth; }
  bool is_of_material() const { return !is_of_obstacles(); }

  /// For a limit of obstacles: how far the machine is from being beyond the limit, mm; negative where it is. It changes
  /// by no more than points of bodies travel.
  double margin(const std::vector<verification::Neighbor>& neighbors) const;
  /// By at least a millionth of a mm, so that where a run stops the comparison surely holds.
  bool is_beyond(const std::vector<verification::Neighbor>& neighbors) const;
  /// For a limit of the material.
  bool is_beyond(double number) const;
};

/// The machine comes to be beyond a limit.
struct LimitCrossing {
  double time = 0;        ///< Seconds since the start.
  std::size_t limit = 0;  ///< Index of the limit.
};

/// The times within a stretch at which the machine comes to be beyond a limit of obstacles, in their order. What is
/// beyond it for less than 0.1 mm of travel may be missed. `bodies` are those of the tool that makes the motion.
std::vector<double> crossings_of(const SurroundingsLimit& limit, const motion::Stretch& stretch,
                                 const verification::BodyPairs& bodies, const kinematics::Kinematics& kinematics);

}  // namespace isocnc::debuggee
