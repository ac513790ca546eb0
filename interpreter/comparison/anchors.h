#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/comparison/alignment.h"

namespace isocnc::comparison {

/// Pairs of actions that occur once in each of two runs and therefore most likely belong together: the longest rows of
/// pairs in the order of both runs, as in a patience diff. There is a row by place, in which motions end in the same
/// place of the machine within the tolerance, one by numbers, which are the same to the last digit, so that places of
/// short motions are told apart whatever the tolerance, and one by shape, in which three motions go the same way,
/// wherever they start.
class Anchors {
 public:
  enum class AnchorRow : std::uint8_t { Numbers, Place, Shape };

  explicit Anchors(const RunPair& runs);

  /// The first pair at or after a place.
  std::optional<PlaceInBoth> next(const PlaceInBoth& place, AnchorRow row) const;

 private:
  std::vector<PlaceInBoth> by_numbers_;
  std::vector<PlaceInBoth> by_place_;
  std::vector<PlaceInBoth> by_shape_;
};

}  // namespace isocnc::comparison
