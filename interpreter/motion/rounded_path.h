#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/motion/path_times.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Keeps what a Rounder makes, on machines whose jerk is not limited, for PathTimes to take it later.
class RoundedPath {
 public:
  /// `keeps_paths`: whether the stretches will be used, not their times alone.
  explicit RoundedPath(bool keeps_paths) : keeps_paths_(keeps_paths) {}

  // What a Rounder calls, as in PathTimes.
  static constexpr bool limits_jerk() { return false; }
  void append_line(double begin, double length, const kinematics::LineLimits& limits) {
    steps_.push_back(RoundedStep::Line);
    lines_.push_back({begin, length, limits});
  }
  void append_curve(double begin, double length, double cap, std::span<const kinematics::CurveBound> forward,
                    std::span<const kinematics::CurveBound> backward);
  void append_level(double length, double cap) {
    steps_.push_back(RoundedStep::Level);
    levels_.push_back({length, cap});
  }
  void append_track(const kinematics::Path& path, const TrackOwner& owner) {
    steps_.push_back(RoundedStep::Track);
    owners_.push_back(owner);
    if (keeps_paths_) paths_.push_back(path);
  }
  void append_smooth(const kinematics::Machine&, const Piece&, double) {}  // Where jerk is limited alone.
  void append_phase(const Piece& piece, const Phase& phase) {
    steps_.push_back(RoundedStep::Phase);
    phases_.push_back({piece, phase});
  }
  void end_phases() { steps_.push_back(RoundedStep::EndPhases); }
  void begin_element() {}
  void end_element() { steps_.push_back(RoundedStep::EndElement); }
  void come_to_rest(const kinematics::Machine&) { steps_.push_back(RoundedStep::Rest); }
  void wait(double seconds) {
    steps_.push_back(RoundedStep::Wait);
    waits_.push_back(seconds);
  }

  /// The end of what has been made so far.
  std::size_t end() const { return steps_.size(); }
  void clear();

 private:
  friend class RoundedPathReader;

  enum class RoundedStep : std::uint8_t { Line, Curve, Level, Track, Phase, EndPhases, EndElement, Rest, Wait };
  struct LineSpan {
    double begin;
    double length;
    kinematics::LineLimits limits;
  };
  struct CurveSpan {
    double begin;
    double length;
    double cap;
    std::uint8_t forward_count;
    std::uint8_t backward_count;
  };
  struct LevelSpan {
    double length;
    double cap;
  };
  struct TimedPiece {
    Piece piece;
    motion::Phase phase;
  };
  bool keeps_paths_;
  std::vector<RoundedStep> steps_;
  std::vector<LineSpan> lines_;
  std::vector<CurveSpan> curves_;
  std::vector<kinematics::CurveBound> bounds_;  ///< Of the curves, the forward bounds of each first.
  std::vector<LevelSpan> levels_;
  std::vector<TrackOwner> owners_;       ///< Of the tracks.
  std::vector<kinematics::Path> paths_;  ///< Of the tracks, if they are kept.
  std::vector<TimedPiece> phases_;
  std::vector<double> waits_;
};

/// Hands a kept path on, from its start to its end.
class RoundedPathReader {
 public:
  explicit RoundedPathReader(const RoundedPath& path) : path_(&path) {}

  /// Hands on what has been made up to an end().
  void hand_on(std::size_t end, const kinematics::Machine& machine, PathTimes& times);

 private:
  const RoundedPath* path_;
  std::size_t step_ = 0;
  std::size_t line_ = 0;
  std::size_t curve_ = 0;
  std::size_t bound_ = 0;
  std::size_t level_ = 0;
  std::size_t track_ = 0;
  std::size_t phase_ = 0;
  std::size_t wait_ = 0;
};

}  // namespace isocnc::motion
