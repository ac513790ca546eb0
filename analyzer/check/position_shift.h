#pragma once

#include <optional>

#include "analyzer/check/frontier.h"

namespace isocnc::check {

/// A move of all positions by the same distance, in whole steps (geometry::advanced). Where moves are incremental, what
/// is executed after it is shifted as well, and otherwise the same.
struct PositionShift {
  geometry::Pose by;
  execution::AxisSet axes = 0;  ///< The axes that it moves.

  bool empty() const { return axes == 0; }
  /// Ends the shift of these axes.
  void drop(execution::AxisSet dropped);
  /// Adds a shift after this one; false, with nothing done, when they lead too far to add up exactly.
  bool add(const PositionShift& other);
  void apply(Frontier& frontier) const;
};

/// The shift that makes one frontier of another, where they differ in nothing else. Nothing where there is none.
std::optional<PositionShift> shift_between(const Frontier& from, const Frontier& to);

}  // namespace isocnc::check
