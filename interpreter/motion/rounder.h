#pragma once

#include "interpreter/kinematics/element.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"

namespace isocnc::motion {

/// Makes the path of moves, with rounded corners, and the limits of its spans. How a corner is rounded depends on the
/// two elements that meet there, and on nothing before them: so parts of a path can be made apart from each other.
///
/// The path goes to an `out`: PathTimes, which times it at once, or RoundedPath, which keeps it. A value.
class Rounder {
 public:
  /// At rest, before the first move.
  Rounder() = default;
  /// Somewhere in a path, of which nothing is known yet. See is_settled().
  static Rounder anywhere();

  /// Begins a move, whose elements then wait. Those of the move before must have been taken. A rapid whose joints move
  /// independently has none: it goes out at once.
  template <class Out>
  void push(const kinematics::Machine& machine, const kinematics::Move& move, Out& out);
  bool has_more() const { return splitter_.has_more(); }
  /// Takes the next element. Requires has_more().
  template <class Out>
  void take_next(const kinematics::Machine& machine, Out& out);
  template <class Out>
  void come_to_rest(const kinematics::Machine& machine, Out& out);

  /// Whether it is where it would be if it had taken all moves from the start on: after two elements, or a rest.
  bool is_settled() const { return has_end_ && known_elements_ >= kSettled; }

 private:
  template <class Out>
  friend class Rounding;

  static constexpr int kSettled = 2;

  kinematics::Splitter splitter_;
  kinematics::Element last_;  ///< Last element; its end is final when the next element or a rest is known.
  bool has_last_ = false;
  geometry::Pose end_;  ///< End of the last move pushed.
  bool has_end_ = false;
  int known_elements_ = kSettled;  ///< Number of elements taken since the start, kSettled at most.
};

}  // namespace isocnc::motion
