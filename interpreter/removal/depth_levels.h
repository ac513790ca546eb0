#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "interpreter/dialect/given_name.h"
#include "interpreter/geometry/frame.h"

namespace isocnc::removal {

/// Where a part of what is in contact is deepest.
struct DeepestPlace {
  double depth = 0;                               ///< mm.
  std::size_t line = 0;                           ///< From 0.
  double time = 0;                                ///< Seconds since the start of the run.
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Machine frame of the program, mm.
};

/// A line on which a part of what is in contact goes much deeper than on all lines before, or begins to touch.
struct DepthLevel {
  std::size_t line = 0;       ///< From 0.
  std::size_t part = 0;       ///< Of the mover: a number of the caller's.
  double depth = 0;           ///< The greatest one on the line, mm.
  geometry::Frame frame;      ///< In force there; in the machine frame.
  bool is_in_inches = false;  ///< G70 is in force there.
  dialect::GivenName who;     ///< The part.
  DeepestPlace deepest;       ///< From the line on up to the part's next level.
};

/// Takes the next depth of a contact, whose deepest place is there, in the order of the run. Whoever accepts a contact
/// on the line where it begins has not accepted that it is much deeper on a later line, or that the holder follows the
/// cutter; rounded corners make a line a little deeper than another.
inline void take_depth(std::vector<DepthLevel>& levels, const DepthLevel& next) {
  constexpr double kMuchDeeper = 0.25;  // mm, or this part of the depth.
  const auto last =
      std::find_if(levels.rbegin(), levels.rend(), [&](const DepthLevel& each) { return each.part == next.part; });
  const bool is_on_line = last != levels.rend() && last->line == next.line;
  if (last == levels.rend() || (!is_on_line && next.depth > last->depth + kMuchDeeper * std::max(1.0, last->depth))) {
    levels.push_back(next);
    return;
  }
  if (is_on_line) last->depth = std::max(last->depth, next.depth);
  if (next.deepest.depth > last->deepest.depth) last->deepest = next.deepest;
}

}  // namespace isocnc::removal
