#pragma once

#include <cmath>
#include <optional>

#include "analyzer/check/frontier.h"
#include "analyzer/check/outcome.h"
#include "interpreter/execution/plain_run.h"
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

/// What plain lines pass on of a group of paths, but for its position.
struct PassedState {
  execution::State state;
  rules::Memory memory;
  rules::HouseMemory house;

  static PassedState of(const Group& group) { return {group.state, group.memory, group.house}; }
  /// Whether a row of plain lines that has run from `before` without a finding does so from here as well.
  bool passes(const execution::PlainEffects& row, const Group& before, const rules::HouseRules* rules) const;
  /// Goes on past such a row, which has led from another state to `after`.
  void pass(const execution::PlainEffects& row, const execution::State& after, const rules::HouseRules* rules);
  bool equals(const Group& group) const;
  /// Gives a group this state, at its own position.
  void apply(Group& group) const;
};

/// A difference between two frontiers that lines may pass on without giving other findings.
struct FrontierChange {
  PositionShift shift;
  std::optional<PassedState> state;  ///< That of the only live group, where it has changed.

  bool empty() const { return shift.empty() && !state; }
  void apply(Frontier& frontier) const;
  /// Whether lines that have been checked from `before` give the same findings after this change, and pass it on.
  /// `row`: if all of them are one row of plain motions.
  bool passes(const PositionUse& use, const std::optional<execution::PlainEffects>& row, const Frontier& before,
              const rules::HouseRules* rules) const;
  /// Goes on past such lines, which have led to `after`.
  void pass(const PositionUse& use, const std::optional<execution::PlainEffects>& row, const Frontier& after,
            const rules::HouseRules* rules);
};

/// The change that turns `from` into `to`; nothing if they differ in more.
std::optional<FrontierChange> change_between(const Frontier& from, const Frontier& to);

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
