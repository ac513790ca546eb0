#pragma once

#include <cmath>
#include <optional>

#include "analyzer/check/frontier.h"
#include "analyzer/check/outcome.h"
#include "interpreter/geometry/increment.h"

namespace isocnc::check {

/// An equal displacement of all positions, in whole steps (geometry::advanced). Lines with incremental moves give the
/// same findings after it, at shifted positions.
struct PositionShift {
  geometry::Pose by;
  execution::AxisSet axes = 0;  ///< The shifted axes.

  bool empty() const { return axes == 0; }
  /// Ends the shift of these axes.
  void drop(execution::AxisSet dropped);
  /// Adds a shift that follows this one; returns false and changes nothing if the sum is too large to be exact.
  bool add(const PositionShift& other);
  void apply(Frontier& frontier) const;
};

/// The shift that turns `from` into `to`, if they differ in positions alone; nothing otherwise.
std::optional<PositionShift> shift_between(const Frontier& from, const Frontier& to);

/// Whether a coordinate is beyond half the range in which increments add up exactly; a shift may use the other half.
inline bool is_far(const geometry::Pose& pose) {
  constexpr double kFar = geometry::kFarthestStep / 2;
  return !(std::abs(pose.tip[0]) <= kFar && std::abs(pose.tip[1]) <= kFar && std::abs(pose.tip[2]) <= kFar &&
           std::abs(pose.b) <= kFar && std::abs(pose.c) <= kFar);
}

/// Records which positions a line that is not plain depends on; in complicated cases, all axes. `is_judged`: whether
/// the line has findings, or rules that judge motions have seen it.
void note_line(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
               bool is_judged, PositionUse& use);

}  // namespace isocnc::check
