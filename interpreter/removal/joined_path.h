#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "interpreter/removal/tip_paths.h"

namespace isocnc::removal {

/// Pieces of path that follow one another, and the one piece that stands for them: from the start of the first to the
/// end of the last, straight, while the axis turns evenly. Most motions of a few millimetres are a line between two
/// rounded corners, and to cut them at once takes a third of the time.
class JoinedPath {
 public:
  /// How far a point of the tool may be beside its own path, mm.
  struct Tolerance {
    double aside = 0;
    double in_height = 0;  ///< While the axis rests. There, depths are more exact than walls.
  };

  /// Of a piece alone.
  explicit JoinedPath(const TipPath& first);

  /// Adds the piece that begins where the last one ends. Adds nothing, and returns false, if one piece would not stand
  /// for all of them within a tolerance.
  bool add(const TipPath& next, const Tolerance& tolerance);

  /// What stands for them.
  const stock::SweepPath& path() const { return path_; }
  bool is_single() const { return count_ == 2; }

 private:
  /// More than eight pieces are never joined, so that each costs the same.
  static constexpr std::size_t kMostNodes = 9;

  /// The greatest of all pieces.
  struct Greatest {
    // As TipPath has it.
    double reach = 0;
    double stray = 0;
    double stray_in_height = 0;
    double stray_of_axis = 0;
    double turn = 0;  ///< Of the axis, radians.
  };

  static Greatest greatest_of(const TipPath& piece, double turn);
  static Greatest of_both(const Greatest& one, const Greatest& other);
  std::span<const solids::AxisPlacement> nodes() const { return std::span(nodes_).first(count_); }
  bool strays_little(const solids::AxisPlacement& end, const Greatest& greatest, const Tolerance& tolerance) const;
  bool strays_little_at_rest(const solids::AxisPlacement& end, const Greatest& greatest,
                             const Tolerance& tolerance) const;

  stock::SweepPath path_;
  std::array<solids::AxisPlacement, kMostNodes> nodes_;  ///< Where the pieces begin and end.
  std::size_t count_ = 2;
  Greatest greatest_;
};

}  // namespace isocnc::removal
