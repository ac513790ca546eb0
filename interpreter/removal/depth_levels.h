#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "interpreter/geometry/frame.h"

namespace isocnc::removal {

/// A line on which a contact goes much deeper than on all lines before, or on which it begins.
struct DepthLevel {
  std::size_t line = 0;       ///< From 0.
  double depth = 0;           ///< The greatest one on the line, mm.
  geometry::Frame frame;      ///< In force there; in the machine frame.
  bool is_in_inches = false;  ///< G70 is in force there.
};

/// Takes the next depth of a contact, in the order of the run. Whoever accepts a contact on the line where it begins
/// has not accepted one that is much deeper on a later line; rounded corners make a line a little deeper than another.
inline void take_depth(std::vector<DepthLevel>& levels, const DepthLevel& next) {
  constexpr double kMuchDeeper = 0.25;  // mm, or this part of the depth.
  if (!levels.empty()) {
    DepthLevel& last = levels.back();
    if (last.line == next.line) {
      last.depth = std::max(last.depth, next.depth);
      return;
    }
    if (!(next.depth > last.depth + kMuchDeeper * std::max(1.0, last.depth))) return;
  }
  levels.push_back(next);
}

}  // namespace isocnc::removal
