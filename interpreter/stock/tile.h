#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/chords/cut_band.h"
#include "interpreter/chords/height_interval.h"

namespace isocnc::stock {

using chords::CutBand;
using chords::HeightInterval;

/// Says which sweep cut a dexel last. The module gives it no meaning.
using CutTag = std::uint32_t;

/// The dexel of which most is removed, or met.
struct DeepestDexel {
  float depth = 0;   ///< Length of what is removed or met in it, mm.
  int row = -1;      ///< Negative: there is none.
  int column = -1;   ///< Negative: there is none.
  float bottom = 0;  ///< Lowest end of what is removed or met in it, mm.
};

/// What one sweep removes from the dexels of a tile, or meets in them.
struct DexelCount {
  double length = 0;  ///< Sum over the dexels, mm, each in steps of 2^-30 mm.
  DeepestDexel all;   ///< Of all dexels.
  /// Of cuts: of the dexels that are not at the rim of what the sweep covers; as deep as Sweep::depth_limit says.
  DeepestDexel inside;
};

/// A count of what is cut, and the places that are not at the rim.
class CutCount : public DexelCount {
 public:
  /// `first` and `spacing`: of the tile's dexels.
  CutCount(const CutBand& band, const geometry::Vec2& first, const geometry::Vec2& spacing)
      : band_(band), first_(first), spacing_(spacing) {}

  /// Notes what has been removed of a dexel.
  void note(int row, int column, float depth, float bottom) {
    if (depth > all.depth) all = {depth, row, column, bottom};
    const float along = depth * share_;
    if (along > inside.depth && band_.contains({first_.x() + column * spacing_.x(), first_.y() + row * spacing_.y(),
                                                static_cast<double>(bottom)}))
      inside = {along, row, column, bottom};
  }
  void set_share(double share) { share_ = static_cast<float>(share); }

 private:
  CutBand band_;
  geometry::Vec2 first_;
  geometry::Vec2 spacing_;
  float share_ = 1;
};

/// An interval of a dexel of a tile, mm.
struct DexelInterval {
  int row = 0;
  int column = 0;
  float bottom = 0;
  float top = 0;
};

/// A square of 128 x 128 vertical dexels: lines along which the stock is exact. A dexel holds its material as
/// intervals of z, mm, from the highest one down. Heights are floats, so below 512 mm the step is 2^-15 mm.
///
/// A tile whose dexels are all the same holds two numbers and no arrays. Memory: 4 bytes a dexel for the upper ends, 4
/// for the last cuts once there is one, 4 for the lower ends once they differ, and 12 for each further interval.
class Tile {
 public:
  static constexpr int kSize = 128;  ///< Dexels in a row, and rows.

  /// A tile whose dexels all have one interval. A tile at the border of the stock has fewer columns or rows.
  Tile(int columns, int rows, float bottom, float top);
  /// A tile with any material: intervals by row, then by column, then from the lowest one up. None is empty, and those
  /// of a dexel do not overlap.
  Tile(int columns, int rows, std::span<const DexelInterval> material);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  bool is_uniform() const { return tops_.empty(); }
  bool is_empty() const { return !(floor_ < ceiling_); }
  float floor() const { return floor_; }      ///< No material below, mm.
  float ceiling() const { return ceiling_; }  ///< No material above, mm.

  std::size_t memory() const;  ///< Bytes.
  double length() const;       ///< Sum of the lengths of all intervals, mm.

  /// The intervals of a dexel, from the lowest one up.
  std::vector<HeightInterval> intervals(int row, int column) const;
  /// Calls `use(column, bottom, top)` with each interval of a row: by column, then from the lowest one up.
  template <class Use>
  void for_each_interval(int row, Use&& use) const;
  /// Whether the dexel at this place has the same intervals in both tiles.
  bool has_same_material(const Tile& other, int row, int column) const;
  /// The upper end of a dexel's material, mm; no value if it has none.
  std::optional<float> top(int row, int column) const;
  /// Who cut the dexel last; no value if nobody did.
  std::optional<CutTag> cut_by(int row, int column) const;

  /// Makes room for cuts. Required before them.
  void prepare();
  /// Tightens `floor` and `ceiling` after cuts.
  void tighten();

  /// Removes [bottom, top] from the columns [first, last) of a row.
  void cut_run(int row, int first, int last, float bottom, float top, CutTag tag, CutCount& count);
  /// The same, with an interval of its own for each dexel: `bottoms` and `tops` are those of the columns from `first`.
  /// A dexel with bottom >= top is left alone.
  void cut_row(int row, int first, int last, const float* bottoms, const float* tops, CutTag tag, CutCount& count);

  /// The same where all intervals end at `top`.
  void cut_row(int row, int first, int last, const float* bottoms, float top, CutTag tag, CutCount& count);

  /// The upper ends of the dexels of a row from a column on, if each has at most one interval; else null.
  const float* tops(int row, int first) const {
    return is_uniform() || has_lower(row) ? nullptr : tops_.data() + index(row, first);
  }

  /// Sets the upper ends of `size` dexels of a row from a column on; minus infinity where there is no material.
  void highest(int row, int first, int size, float* tops) const;

  /// Counts what of the material of a row is in [bottom, top]. Overlaps shorter than kTouch are none.
  void meet_row(int row, int first, int last, const float* bottoms, const float* tops, DexelCount& count) const;

  /// Bodies that touch the material meet it up to this length, mm, by rounding alone.
  static constexpr float kTouch = 0.001F;
  /// A skin thinner than this, mm, that a cut would leave between itself and a free end is cut, too: rounding leaves
  /// such skins between two pieces of one body.
  static constexpr float kSkin = 0.0002F;

 private:
  struct LowerInterval {
    int column;
    float bottom;
    float top;
  };
  using LowerIntervals = std::vector<LowerInterval>;  ///< By column, then from the highest one down.
  static bool is_in_order(const LowerInterval& left, const LowerInterval& right) {
    return left.column != right.column ? left.column < right.column : left.top > right.top;
  }

  static std::size_t index(int row, int column) {
    return static_cast<std::size_t>(row) * kSize + static_cast<std::size_t>(column);
  }
  float bottom_at(std::size_t index) const { return bottoms_.empty() ? bottom_ : bottoms_[index]; }
  bool has_lower(int row) const { return !lower_.empty() && !lower_[static_cast<std::size_t>(row)].empty(); }
  bool has_lower(int row, int column) const;
  void cut_single(int row, int column, float bottom, float top, CutTag tag, CutCount& count);
  void cut_dexel(int row, int column, float bottom, float top, CutTag tag, CutCount& count);
  void cut_dexel_of_many(int row, int column, float bottom, float top, CutTag tag, CutCount& count);
  void set_bottom(std::size_t index, float bottom);
  void insert_lower(int row, const LowerInterval& interval);
  void cut_from_above(int row, int first, int last, const float* bottoms, float lowest, CutTag tag, CutCount& count);
  void meet_dexel(int row, int column, float bottom, float top, DexelCount& count) const;

  int columns_;
  int rows_;
  float bottom_;  ///< Of the highest interval of every dexel while there are no `bottoms_`.
  float floor_;
  float ceiling_;
  std::vector<float> tops_;            ///< Of the highest interval; its bottom where there is no material.
  std::vector<float> bottoms_;         ///< Of the highest interval, once they differ.
  std::vector<CutTag> tags_;           ///< Once there is a cut.
  std::vector<LowerIntervals> lower_;  ///< Further intervals of each row, once there are any.
};

template <class Use>
void Tile::for_each_interval(int row, Use&& use) const {
  if (is_uniform()) {
    for (int column = 0; column < columns_ && !is_empty(); ++column) use(column, floor_, ceiling_);
    return;
  }
  const std::span<const LowerInterval> lower =
      has_lower(row) ? lower_[static_cast<std::size_t>(row)] : std::span<const LowerInterval>();
  std::size_t first = 0;
  for (int column = 0; column < columns_; ++column) {
    std::size_t last = first;
    while (last < lower.size() && lower[last].column == column) ++last;
    for (std::size_t i = last; i > first; --i) use(column, lower[i - 1].bottom, lower[i - 1].top);
    first = last;
    const std::size_t at = index(row, column);
    if (tops_[at] > bottom_at(at)) use(column, bottom_at(at), tops_[at]);
  }
}

}  // namespace isocnc::stock
