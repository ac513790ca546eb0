#pragma once

#include <cstddef>
#include <vector>

#include "interpreter/kinematics/limits.h"
#include "interpreter/motion/memory.h"

namespace isocnc::motion {

/// An interval of the path with constant limits, as the window minimum returns it.
struct Cell {
  double begin = 0;   ///< Distance along the path from the last rest, mm or degrees.
  double length = 0;  ///< Length along the path, mm or degrees.
  kinematics::LineLimits limits;
};

/// Widens the limits of each piece by half a window of time on both sides, and takes the strictest at each place. Half
/// a window is converted to a length by the piece's own maximum speed. A motion within the widened limits has a mean
/// over the window that keeps the limits of the pieces (docs/motion.md, "Jerk").
///
/// Pieces go in one by one. Cells come out in order, each as soon as no later piece can change it. The class has value
/// semantics.
class WindowMinimum {
 public:
  /// `window`: length of the window, s. `max_speed`: upper bound of the speed on any piece, mm/s.
  WindowMinimum(double window, double max_speed);

  /// Appends a piece of `length` mm or degrees.
  void append(double length, kinematics::LineLimits limits);

  /// Ends the path at rest. The next piece starts a new path at 0.
  void come_to_rest();

  /// Returns the next cell, or null. The pointer is valid until the next call of a member function.
  const Cell* next();

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const {
    return bytes_of(sources_) + bytes_of(intervals_) + bytes_of(cells_) + from_earlier_.memory();
  }

 private:
  /// The minimum of all values that apply at the current place. Each value applies up to a place of its own, and the
  /// current place only increases.
  class RunningMinimum {
   public:
    void insert(double value, double until);
    /// Moves the current place forward, and removes values that end there or before.
    void pass(double place);
    double minimum(double otherwise) const { return entries_.empty() ? otherwise : entries_.back().value; }
    /// Returns the place up to which the minimum applies.
    double until(double otherwise) const { return entries_.empty() ? otherwise : entries_.back().until; }
    std::size_t memory() const { return bytes_of(entries_); }

   private:
    struct Entry {
      double value;
      double until;  ///< Place up to which the value applies.
    };
    std::vector<Entry> entries_;  ///< Values that can still become the minimum, in descending order of value and place.
  };

  /// The strictest limits that reach the current place from pieces on one side of it.
  class RunningLimits {
   public:
    void insert(const kinematics::LineLimits& limits, double until);
    /// Moves the current place forward.
    void pass(double place);
    kinematics::LineLimits limits() const;
    /// Returns the place up to which limits() stays as it is.
    double until() const;
    std::size_t memory() const { return cap_.memory() + acceleration_.memory() + fall_.memory(); }

   private:
    RunningMinimum cap_;
    RunningMinimum acceleration_;
    RunningMinimum fall_;  ///< Minimum of the negated falls, since the greatest fall is the strictest.
  };

  /// A piece whose limits are to be widened.
  struct Source {
    double begin = 0;   ///< Start of the piece, as a distance from the last rest.
    double end = 0;     ///< End of the piece, as a distance from the last rest.
    double radius = 0;  ///< Distance by which its limits are widened on both sides.
    kinematics::LineLimits limits;
  };
  /// An interval of the path with the limits that reach it from its own and later pieces.
  struct Interval {
    double begin = 0;
    double end = 0;
    kinematics::LineLimits limits;
  };

  std::size_t settled() const;
  void widen(std::size_t count);
  void widen_backward(std::size_t count);
  void widen_forward(std::size_t count);
  void emit(double begin, double end, const kinematics::LineLimits& limits);

  double window_;                    ///< Length of the window, s.
  double max_speed_;                 ///< Upper bound of the speed on any piece, mm/s.
  std::vector<Source> sources_;      ///< Pieces whose cells are not determined yet.
  std::vector<Interval> intervals_;  ///< Intervals of the sources being widened, from the last to the first.
  RunningLimits from_earlier_;       ///< Limits that reach forward from sources already widened.
  std::size_t batch_;                ///< Number of sources that triggers the next widening.
  Cell open_;                        ///< Last cell, which may still grow.
  int open_parts_ = 0;               ///< Number of intervals merged into `open_`.
  double end_ = 0;                   ///< End of the last source, as a distance from the last rest.
  std::vector<Cell> cells_;          ///< Finished cells.
  std::size_t handed_out_ = 0;       ///< Number of `cells_` that next() has returned.
};

}  // namespace isocnc::motion
