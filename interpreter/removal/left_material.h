#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/stock/stock.h"

namespace isocnc::removal {

/// Material that stands on the finished part where it should be gone.
struct LeftRegion {
  double volume = 0;                              ///< mm^3
  double height = 0;                              ///< Greatest height of what is left, mm.
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Its upper end where it is highest; frame of the stock.
  std::optional<stock::CutTag> last_cut;          ///< The last cut of any of its dexels.
};

/// What a stock has above the target, each region that hangs together once, the largest first. Material within
/// `tolerance` mm of the target, in any direction, does not count, nor what the dexels' spacing leaves open at a wall,
/// nor what hangs together with no part of the target.
std::vector<LeftRegion> left_on_target(const stock::Stock& stock, const stock::Blank& target, double tolerance);

}  // namespace isocnc::removal
