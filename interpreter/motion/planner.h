#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/motion/blend.h"
#include "interpreter/motion/element.h"
#include "interpreter/motion/jerk_limiter.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/move.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/profile.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Gives moves their time. Moves go in one by one, and come out as stretches in the same order, as soon as nothing that
/// may still follow can change them:
///
///     planner.push(move);
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///     ...
///     planner.rest();
///     while (const Stretch* stretch = planner.next()) use(*stretch);
///
/// The times are the shortest under the constraints of docs/motion.md, or as near to that as it says. Memory is
/// bounded, however long the program, if next() is called as above. What comes out depends on what went in, not on when
/// next() was called. A planner is a value: a copy goes on by itself.
class Planner {
 public:
  explicit Planner(Machine machine);

  /// A move that goes nowhere has no stretch; its exact stop holds.
  void push(const Move& move);

  /// The machine comes to rest after all that was pushed, and stays so for a time: at dwells, tool changes, and
  /// wherever the control waits.
  void rest(double seconds = 0);

  /// The next stretch, or null where what was pushed does not determine it yet. Valid until the planner is used again.
  const Stretch* next();

  /// Lets go of what has been handed out, which is done now and then anyway: a copy is then as small as it can be.
  void forget_handed_out();

  /// Bytes that it holds, beside itself.
  std::size_t memory() const {
    return profile_.memory() + bytes_of(tracks_) + (jerk_limiter_ ? jerk_limiter_->memory() : 0);
  }

  /// Seconds until the end of all stretches that are determined, rests included.
  double time() const { return jerk_limiter_ ? jerk_limiter_->time() : profile_.time(); }

 private:
  /// What spans of the profile lead along.
  struct Track {
    Piece piece;
    int span_count = 1;
    bool is_shared = false;      ///< A corner, whose second half belongs to the next move.
    std::uint64_t next_tag = 0;  ///< Of that.
  };

  void take_elements();
  void take(Element element);
  void join(Element& next);
  void join_smoothly(Element& next);
  void come_to_rest();
  void plan_ahead();
  void append(const Element& element);
  void append_line(const Element& element);
  void append_curve(const Element& element);
  void append_arc(const Element& element);
  void append_smooth_curve(const Element& element);
  int append_fine(const Path& circle, double begin, double end, double cap);
  void append_corner(const Blend& blend, const Element& before, const Element& after);
  void append_corner(const SmoothBlend& blend, const Element& before, const Element& after);
  const Stretch* next_determined();
  void forget_tracks();
  void hand_out(int spans);

  Machine machine_;
  Splitter splitter_;
  Element last_;  ///< Its end waits for what comes next.
  bool has_last_ = false;
  geometry::Pose end_;  ///< Of the last move.
  bool has_end_ = false;

  Profile profile_;                          ///< Where jerk is not limited.
  std::vector<Track> tracks_;                ///< Of its spans.
  std::size_t handed_out_ = 0;               ///< Tracks before it.
  int spans_out_ = 0;                        ///< Of the next one.
  bool half_out_ = false;                    ///< The first half of a corner is handed out.
  std::optional<JerkLimiter> jerk_limiter_;  ///< Where it is.
  Stretch stretch_;
};

}  // namespace isocnc::motion
