#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/kinematics/element.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/motion/blend.h"
#include "interpreter/motion/jerk_limiter.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/profile.h"
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
  explicit Planner(kinematics::Machine machine);

  /// Appends a move. A move without length yields no stretch, but its exact stop takes effect. Rapids whose joints move
  /// independently start and end at rest.
  void push(const kinematics::Move& move);

  /// Brings the machine to rest after all moves pushed so far, and keeps it at rest for `seconds`: for dwells, tool
  /// changes, and other waits of the control.
  void rest(double seconds = 0);

  /// Returns the next stretch, or null if the moves pushed so far do not determine it yet. The pointer is valid until
  /// the next call of a non-const member function.
  const Stretch* next();

  /// Frees the memory of stretches that next() has returned, so that a copy is as small as possible. The planner also
  /// does so by itself from time to time.
  void forget_handed_out();

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const {
    return profile_.memory() + bytes_of(tracks_) + (jerk_limiter_ ? jerk_limiter_->memory() : 0);
  }

  /// Returns the time at the end of all stretches that are determined, rests included, s.
  double time() const { return jerk_limiter_ ? jerk_limiter_->time() : profile_.time(); }

 private:
  /// A piece of path, with the number of the profile's spans that run along it.
  struct Track {
    Piece piece;
    int span_count = 1;
    bool is_shared = false;      ///< Whether the piece is a blend whose second half belongs to the next move.
    std::uint64_t next_tag = 0;  ///< Move::tag of the next move, if `is_shared`.
  };

  void append_rapid(const kinematics::Move& rapid);
  void take_elements();
  void take(kinematics::Element element);
  void join(kinematics::Element& next);
  void join_smoothly(kinematics::Element& next);
  void come_to_rest();
  void plan_ahead();
  void append(const kinematics::Element& element);
  void append_line(const kinematics::Element& element);
  void append_curve(const kinematics::Element& element);
  void append_arc(const kinematics::Element& element);
  void append_smooth_curve(const kinematics::Element& element);
  int append_fine(const kinematics::Path& circle, double begin, double end, double cap);
  void append_corner(const Blend& blend, const kinematics::Element& before, const kinematics::Element& after);
  void append_corner(const SmoothBlend& blend, const kinematics::Element& before, const kinematics::Element& after);
  const Stretch* next_determined();
  void forget_some();
  void forget_tracks();
  void hand_out(int spans);

  kinematics::Machine machine_;
  kinematics::Splitter splitter_;
  kinematics::Element last_;  ///< Last element; its end is final when the next element or a rest is known.
  bool has_last_ = false;
  geometry::Pose end_;  ///< End of the last move pushed.
  bool has_end_ = false;

  Profile profile_;                          ///< Profile of machines whose jerk is not limited.
  std::vector<Track> tracks_;                ///< Tracks of the profile's spans.
  std::size_t handed_out_ = 0;               ///< Number of tracks whose stretches are all returned.
  int spans_out_ = 0;                        ///< Number of returned spans of the next track.
  bool half_out_ = false;                    ///< Whether the first half of a shared blend is returned.
  std::optional<JerkLimiter> jerk_limiter_;  ///< Profile of machines whose jerk is limited; absent on others.
  Stretch stretch_;                          ///< Stretch to which next() returns a pointer.
};

}  // namespace isocnc::motion
