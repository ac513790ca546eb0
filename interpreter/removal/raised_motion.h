#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/stock/sweep.h"

namespace isocnc::removal {

/// What a program asks of a motion.
struct ProgrammedMotion {
  geometry::Vec3 from = geometry::Vec3::Zero();  ///< The tip at its start, mm.
  geometry::Vec3 to = geometry::Vec3::Zero();    ///< The tip at its end, mm.
  bool is_line = false;                          ///< Of the tip, where all axes arrive together.
};

/// A motion with another Z at its end, as if it had been typed into its line. A motion that is level goes at the other
/// Z all the time, since its start is a Z of the same kind.
class RaisedMotion {
 public:
  /// What is known of a motion.
  struct Kind {
    bool axes_alone = false;     ///< Each axis goes at its own speed.
    bool starts_inside = false;  ///< It begins where it must not be.
  };

  /// Along `up`, a unit vector, in the frame of the motion.
  RaisedMotion(const ProgrammedMotion& motion, const geometry::Vec3& up, const Kind& kind);

  /// Whether another Z in its line may keep it out of something: not where it rises, as then it is its start that is
  /// too low, nor where its way follows from more than its ends.
  bool can_help() const { return way_ != Way::Unknown; }

  /// How much higher it may end at most, mm: where it would have to rise, it is its start that is too low.
  double most_rise() const;

  /// Appends the path of the tip on a part of the motion, if that ends higher by `rise` mm.
  /// Where each axis goes at its own speed, it may be higher on its way, but is nowhere lower.
  void append(const stock::SweepPath& tip, double rise, std::vector<stock::SweepPath>& paths) const;

 private:
  enum class Way : std::uint8_t { Unknown, Level, Line, AxesAlone };

  double height(const geometry::Vec3& point) const { return up_.dot(point); }
  geometry::Vec3 raised(const geometry::Vec3& tip, double rise) const;

  ProgrammedMotion motion_;
  geometry::Vec3 up_;
  Way way_ = Way::Unknown;
};

}  // namespace isocnc::removal
