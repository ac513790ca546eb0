#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/path.h"
#include "interpreter/motion/jerk_limiter.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/profile.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// What a track tells of the moves that it belongs to.
struct TrackOwner {
  std::uint64_t tag = 0;       ///< Move::tag of the move.
  bool ends_move = false;      ///< Whether this is the last piece of its move.
  int span_count = 1;          ///< Number of the profile's spans that run along it.
  bool is_shared = false;      ///< Whether the piece is a blend whose second half belongs to the next move.
  std::uint64_t next_tag = 0;  ///< Move::tag of the next move, if `is_shared`.
};

/// Times the path that a Rounder makes. A value.
class PathTimes {
 public:
  /// `keeps_paths`: whether stretches will be asked for, not their times alone.
  PathTimes(const kinematics::Machine& machine, bool keeps_paths);

  bool limits_jerk() const { return jerk_limiter_.has_value(); }

  // The path, where jerk is not limited: spans with their limits, then the track that runs along them.
  void append_line(double begin, double length, const kinematics::LineLimits& limits) {
    profile_.append_line(begin, length, limits);
  }
  void append_curve(double begin, double length, double cap, std::span<const kinematics::CurveBound> forward,
                    std::span<const kinematics::CurveBound> backward) {
    profile_.append_curve(begin, length, cap, forward, backward);
  }
  void append_level(double length, double cap) { profile_.append_level(length, cap); }
  void append_track(const kinematics::Path& path, const TrackOwner& owner) {
    append_track(owner);
    if (keeps_paths_) paths_.push_back(path);
  }
  /// The same where paths are not kept.
  void append_track(const TrackOwner& owner) { tracks_.push_back(owner); }

  /// A piece of the path where jerk is limited. `feed_cap`: maximum of (ds/dt)^2 by the feed, mm^2/s^2.
  void append_smooth(const kinematics::Machine& machine, const Piece& piece, double feed_cap) {
    jerk_limiter_->append(machine, piece, feed_cap);
  }

  /// A piece that takes a given phase. Requires that the machine is at rest.
  void append_phase(const Piece& piece, const Phase& phase);
  /// After the last one of such pieces.
  void end_phases() { profile_.come_to_rest(); }

  void begin_element() { forget_some(); }
  /// After an element that does not end at rest.
  void end_element() {
    if (profile_.wants_planning()) profile_.plan_ahead();
  }

  void come_to_rest(const kinematics::Machine& machine);
  /// Stays at rest for a time, s. Requires that the machine is at rest.
  void wait(double seconds);

  /// Returns the next stretch, or null if the path so far does not determine it yet. The pointer is valid until the
  /// next call of a non-const member function. Requires that paths are kept.
  const Stretch* next();
  /// The same without its path and phases, and no such requirement.
  const StretchTime* next_time();

  /// Frees the memory of stretches that next() has returned.
  void forget_handed_out();
  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const {
    return profile_.memory() + bytes_of(tracks_) + bytes_of(paths_) + (jerk_limiter_ ? jerk_limiter_->memory() : 0);
  }
  /// Returns the time at the end of all stretches that are determined, rests included, s.
  double time() const { return jerk_limiter_ ? jerk_limiter_->time() : profile_.time(); }

 private:
  void forget_some();
  void forget_tracks();
  template <class OnSpan>
  bool choose_next(StretchTime& time, const OnSpan& on_span);
  void hand_out(int spans);

  bool keeps_paths_;                         ///< Whether next() will be called, not next_time() alone.
  Profile profile_;                          ///< Profile of machines whose jerk is not limited.
  std::vector<TrackOwner> tracks_;           ///< Tracks of the profile's spans.
  std::vector<kinematics::Path> paths_;      ///< Paths of the tracks, if they are kept.
  std::size_t handed_out_ = 0;               ///< Number of tracks whose stretches are all returned.
  int spans_out_ = 0;                        ///< Number of returned spans of the next track.
  bool half_out_ = false;                    ///< Whether the first half of a shared blend is returned.
  std::optional<JerkLimiter> jerk_limiter_;  ///< Profile of machines whose jerk is limited; absent on others.
  Stretch stretch_;                          ///< Stretch to which next() and next_time() return a pointer.
};

}  // namespace isocnc::motion
