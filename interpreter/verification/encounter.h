#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "interpreter/motion/stretch.h"
#include "interpreter/verification/body_pairs.h"

namespace isocnc::verification {

/// A time within a stretch during which a pair touches, from the first touch to the last.
struct Touch {
  double first = 0;         ///< Seconds since the start of the run.
  double last = 0;          ///< Seconds.
  bool from_start = false;  ///< Whether both are together from the start of the stretch on.
  bool to_end = false;      ///< Whether both are still together at the end of the stretch.
  double distance = 0;      ///< Smallest distance that was found, mm; negative: how deep they overlap.
  double deepest_time = 0;  ///< When it was found; seconds since the start of the run.
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Of the obstacle, there; mm, as in Contact.
};

/// A pair that a stretch of motion brings nearer together than the pair's limit.
struct Encounter {
  std::size_t stretch = 0;  ///< Index of the stretch among those that were examined together.
  std::size_t pair = 0;     ///< Index of the pair.
  double distance = 0;      ///< Smallest distance that was found, mm; negative: how deep they overlap.
  double nearest_time = 0;  ///< When it was found; seconds since the start of the run.
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Of the obstacle, there; mm, as in Contact.
  bool ends_apart = false;                        ///< Whether both are beyond the limit at the end of the stretch.
  std::vector<Touch> touches;                     ///< By time; between two of them both are apart.

  bool is_contact() const { return !touches.empty(); }
};

/// What examining stretches has shown.
struct Examined {
  std::vector<Encounter>
      encounters;  ///< In the order of the stretches, those of one stretch in the order of the pairs.
  std::vector<std::size_t> undecided;  ///< Indices of stretches for which not all could be proven.
};

/// Examines stretches that follow one another, by conservative advancement: what comes nearer to an obstacle than the
/// contact distance / 2 is always found. The result depends on nothing but the arguments.
Examined examine(std::span<const motion::Stretch> stretches, const BodyPairs& bodies,
                 const kinematics::Kinematics& kinematics);

}  // namespace isocnc::verification
