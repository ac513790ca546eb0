#pragma once

#include <optional>
#include <vector>

#include "interpreter/comparison/alignment.h"

namespace isocnc::comparison {

/// Pairs of actions that occur once in each of two runs and therefore most likely belong together: the longest rows of
/// pairs in the order of both runs, as in a patience diff. There is a row by place, in which motions end in the same
/// place of the machine, and one by shape, in which three motions go the same way, wherever they start.
class Anchors {
 public:
  explicit Anchors(const RunPair& runs);

  /// The first pair at or after a place.
  std::optional<PlaceInBoth> next(const PlaceInBoth& place, bool is_by_place) const;

 private:
  std::vector<PlaceInBoth> by_place_;
  std::vector<PlaceInBoth> by_shape_;
};

}  // namespace isocnc::comparison
