#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "interpreter/stock/grid.h"

namespace isocnc::stock {

/// Dexels that a sweep looks at together: as many floats as the vectors of a usual processor hold.
inline constexpr int kTogether = 8;

/// Touching bodies seem to share so much of a dexel by rounding, mm.
inline constexpr double kSliver = 0.01;

/// Takes the intervals of dexels of one tile that a sweep covers, and cuts them, or only counts the material in them.
class DexelSink {
 public:
  DexelSink(Tile& tile, const DexelGrid& grid, CutTag tag, const CutBand& band, double depth_limit)
      : grid_(grid),
        tile_(tile),
        cut_(&tile),
        tag_(tag),
        depth_limit_(depth_limit),
        count_(band, grid.first, grid.spacing) {}
  DexelSink(const Tile& tile, const DexelGrid& grid, bool only_finds = false)
      : grid_(grid), tile_(tile), only_finds_(only_finds), count_({}, grid.first, grid.spacing) {}

  const DexelGrid& grid() const { return grid_; }
  double floor() const { return tile_.floor(); }
  double ceiling() const { return tile_.ceiling(); }
  bool has_material_in(const HeightInterval& z) const { return z.bottom < ceiling() && z.top > floor(); }
  bool cuts() const { return cut_ != nullptr; }
  /// Whether it counts whether material is met, and less exactly how much.
  bool only_finds() const { return only_finds_; }
  const DexelCount& count() const { return count_; }

  /// The material of a dexel within an interval, without what is shorter than kSliver.
  std::vector<HeightInterval> material(int row, int column, const HeightInterval& within) const {
    std::vector<HeightInterval> all = tile_.intervals(row, column);
    for (HeightInterval& each : all) each.clip(within);
    std::erase_if(all, [](const HeightInterval& each) { return !(each.top - each.bottom > kSliver); });
    return all;
  }

  /// For a body that cuts and reaches above all material: the upper ends of the dexels of a row from a column on, if
  /// each has at most one interval; else null. A dexel that ends below the body's lower surface need not be taken.
  const float* tops_to_cut(int row, int first) const { return cut_ ? tile_.tops(row, first) : nullptr; }

  /// Sets the highest ends of `size` dexels of a row from a column on, cut or not; below all else where there is no
  /// material.
  void highest(int row, int first, int size, float* tops) const { tile_.highest(row, first, size, tops); }

  /// The columns [first, last) of a row, all with the same interval.
  void take_run(int row, int first, int last, const HeightInterval& z) {
    if (first >= last || z.is_empty()) return;
    if (cut_) {
      cut_->cut_run(row, first, last, bottom_of(z.bottom), top_of(z.top), tag_, count_);
      return;
    }
    for (int column = first; column < last; ++column) set(column - first, z);
    take_row(row, first, last);
  }

  /// The columns [first, last) of a row, each with the interval that has been set for it.
  void take_row(int row, int first, int last) {
    if (first >= last) return;
    if (cut_) {
      cut_->cut_row(row, first, last, bottoms_.data(), tops_.data(), tag_, count_);
    } else {
      tile_.meet_row(row, first, last, bottoms_.data(), tops_.data(), count_);
    }
  }
  /// The same where all intervals end at `top`.
  void take_row(int row, int first, int last, double top) {
    if (first >= last) return;
    if (cut_) return cut_->cut_row(row, first, last, bottoms_.data(), top_of(top), tag_, count_);
    std::fill_n(tops_.data(), last - first, top_of(top));
    take_row(row, first, last);
  }
  /// Sets the interval of the i-th column of the next row to be taken.
  void set(int i, const HeightInterval& z) {
    bottoms_[static_cast<std::size_t>(i)] = bottom_of(z.bottom);
    tops_[static_cast<std::size_t>(i)] = top_of(z.top);
  }
  /// A further interval of one dexel. Leaves what has been set alone.
  void take_apart(int row, int column, const HeightInterval& z) {
    const float bottom = bottom_of(z.bottom);
    const float top = top_of(z.top);
    if (cut_) {
      cut_->cut_row(row, column, column + 1, &bottom, &top, tag_, count_);
    } else {
      tile_.meet_row(row, column, column + 1, &bottom, &top, count_);
    }
  }
  /// Deeper cuts are measured along the axis, mm.
  double depth_limit() const { return depth_limit_; }
  /// What part of their length along the axis the dexels that are cut next are deep.
  void set_share(double share) { count_.set_share(share); }
  /// The same for many, by which loops over them become vectors: floats that are rounded already.
  float* bottoms() { return bottoms_.data(); }
  float* tops() { return tops_.data(); }

 private:
  static float bottom_of(double z) { return chords::rounded_up(z); }
  static float top_of(double z) { return chords::rounded_down(z); }

  const DexelGrid& grid_;
  const Tile& tile_;
  Tile* cut_ = nullptr;
  bool only_finds_ = false;
  CutTag tag_ = 0;
  double depth_limit_ = std::numeric_limits<double>::infinity();
  CutCount count_;
  std::array<float, Tile::kSize> bottoms_;
  std::array<float, Tile::kSize> tops_;
};

}  // namespace isocnc::stock
