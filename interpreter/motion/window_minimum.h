#pragma once

#include <cstddef>
#include <vector>

#include "interpreter/motion/limits.h"
#include "interpreter/motion/memory.h"

namespace isocnc::motion {

/// A part of the way with limits of its own.
struct Cell {
  double begin = 0;  ///< From the last rest on.
  double length = 0;
  LineLimits limits;
};

/// Spreads limits over their surroundings: what holds on a piece shall hold as well half a window before the machine
/// gets there, and half a window after it has left, at the piece's own speed. Then the mean over a window, centered
/// where the machine is on the piece, is a mean of motions within the piece's limits (docs/motion.md).
///
/// Pieces go in one by one, cells come out, each as soon as nothing that follows reaches back to it. A value.
class WindowMinimum {
 public:
  /// `window`: seconds. No piece is faster than `max_speed`.
  WindowMinimum(double window, double max_speed);

  void append(double length, LineLimits limits);

  /// The way ends; what follows is another one, from 0.
  void come_to_rest();

  /// Next in order, or null. Valid until the window minimum is used again.
  const Cell* next();

  /// Bytes that it holds, beside itself.
  std::size_t memory() const {
    return bytes_of(sources_) + bytes_of(intervals_) + bytes_of(cells_) + from_earlier_.memory();
  }

 private:
  /// The least of values, each of which holds up to a place, while places pass in order.
  class RunningMinimum {
   public:
    void insert(double value, double until);
    void pass(double place);
    double minimum(double otherwise) const { return entries_.empty() ? otherwise : entries_.back().value; }
    double until(double otherwise) const { return entries_.empty() ? otherwise : entries_.back().until; }
    std::size_t memory() const { return bytes_of(entries_); }

   private:
    struct Entry {
      double value;
      double until;
    };
    std::vector<Entry> entries_;  ///< The least last, which ends first.
  };

  /// Limits that reach a place from one side.
  class RunningLimits {
   public:
    void insert(const LineLimits& limits, double until);
    void pass(double place);
    LineLimits limits() const;
    double until() const;  ///< Where they change.
    std::size_t memory() const { return cap_.memory() + acceleration_.memory() + fall_.memory(); }

   private:
    RunningMinimum cap_;
    RunningMinimum acceleration_;
    RunningMinimum fall_;  ///< Negative: the most falls counts.
  };

  struct Source {
    double begin = 0;
    double end = 0;
    double radius = 0;
    LineLimits limits;
  };
  struct Interval {
    double begin = 0;
    double end = 0;
    LineLimits limits;
  };

  std::size_t settled() const;
  void widen(std::size_t count);
  void widen_backward(std::size_t count);
  void widen_forward(std::size_t count);
  void emit(double begin, double end, const LineLimits& limits);

  double window_;
  double max_speed_;
  std::vector<Source> sources_;
  std::vector<Interval> intervals_;  ///< Of the sources that are spread now, the last first.
  RunningLimits from_earlier_;       ///< Of the sources that are spread.
  std::size_t batch_;                ///< So many sources call for spreading.
  Cell open_;                        ///< The last, which may still grow.
  int open_parts_ = 0;               ///< So many it has grown from.
  double end_ = 0;                   ///< Of the last source.
  std::vector<Cell> cells_;
  std::size_t handed_out_ = 0;
};

}  // namespace isocnc::motion
