#pragma once

#include <optional>

#include "analyzer/check/frontier.h"

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

}  // namespace isocnc::check
