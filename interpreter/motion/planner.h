#pragma once

#include <cstddef>
#include <utility>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/motion/path_times.h"
#include "interpreter/motion/rounded_path.h"
#include "interpreter/motion/rounder.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Computes the times of moves. Moves go in one by one. Stretches come out in the same order, each as soon as no later
/// move can change it:
///
///     planner.push(move);
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///     ...
///     planner.rest();
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///
/// The times are the shortest under the constraints of docs/motion.md, within the margins that the page states. The
/// stretches depend on the moves alone, not on when next() is called. Memory is bounded for programs of any length if
/// next() is called as above. The class has value semantics: a copy is independent.
class Planner {
 public:
  /// `keeps_paths`: whether stretches will be asked for, not their times alone.
  explicit Planner(kinematics::Machine machine, bool keeps_paths = true)
      : machine_(std::move(machine)), times_(machine_, keeps_paths) {}

  /// Appends a move. A move without length yields no stretch, but its exact stop takes effect. Rapids whose joints move
  /// independently start and end at rest.
  void push(const kinematics::Move& move) {
    take_elements();
    rounder_.push(machine_, move, times_);
  }

  /// Brings the machine to rest after all moves pushed so far, and keeps it at rest for `seconds`: for dwells, tool
  /// changes, and other waits of the control.
  void rest(double seconds = 0) {
    take_elements();
    rounder_.come_to_rest(machine_, times_);
    times_.wait(seconds);
  }

  /// Returns the next stretch, or null if the moves pushed so far do not determine it yet. The pointer is valid until
  /// the next call of a non-const member function. Requires that paths are kept.
  const Stretch* next() { return next_by(&PathTimes::next); }
  /// The same without its path and phases, and no such requirement.
  const StretchTime* next_time() { return next_by(&PathTimes::next_time); }

  /// Takes what another Rounder has made of the next moves, or of a rest, up to this end of it. Then go_on_from().
  void take_rounded(RoundedPathReader& path, std::size_t end) { path.hand_on(end, machine_, times_); }
  /// Takes the further moves as this Rounder would, which has made the path up to here.
  void go_on_from(const Rounder& rounder) { rounder_ = rounder; }

  /// Frees the memory of stretches that next() has returned, so that a copy is as small as possible. The planner also
  /// does so by itself from time to time.
  void forget_handed_out() { times_.forget_handed_out(); }

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const { return times_.memory(); }

  /// Returns the time at the end of all stretches that are determined, rests included, s.
  double time() const { return times_.time(); }

 private:
  /// What a function of PathTimes returns, as soon as there is enough of the path.
  template <class Result>
  const Result* next_by(const Result* (PathTimes::*next)()) {
    const Result* result = (times_.*next)();
    while (!result && rounder_.has_more()) {
      rounder_.take_next(machine_, times_);
      result = (times_.*next)();
    }
    return result;
  }

  void take_elements() {
    while (rounder_.has_more()) rounder_.take_next(machine_, times_);
  }

  kinematics::Machine machine_;
  Rounder rounder_;
  PathTimes times_;
};

}  // namespace isocnc::motion
