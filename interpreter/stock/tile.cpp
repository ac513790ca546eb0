#include "interpreter/stock/tile.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace isocnc::stock {

namespace {

constexpr std::size_t kDexels = static_cast<std::size_t>(Tile::kSize) * Tile::kSize;
constexpr CutTag kUncut = 0xFFFFFFFF;
constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

/// A length in steps of 2^-30 mm. Sums of such lengths are exact below 2^22 mm, so they do not depend on the order, or
/// on which dexels are looked at together.
double stepped(float length) {
  constexpr double kSteps = 1.5 * (1 << 22);
  return (static_cast<double>(length) + kSteps) - kSteps;
}

void note_deepest(DexelCount& count, int row, int column, float depth, float bottom) {
  if (depth > count.all.depth) count.all = {depth, row, column, bottom};
}

}  // namespace

Tile::Tile(int columns, int rows, float bottom, float top)
    : columns_(columns), rows_(rows), bottom_(bottom), floor_(bottom), ceiling_(std::max(bottom, top)) {}

Tile::Tile(int columns, int rows, std::span<const DexelInterval> material) : Tile(columns, rows, 0, 0) {
  if (material.empty()) return;
  const DexelInterval& first = material.front();
  const auto dexels = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const bool are_all_same =
      material.size() == dexels && std::all_of(material.begin(), material.end(), [&](const DexelInterval& each) {
        return each.bottom == first.bottom && each.top == first.top;
      });
  if (are_all_same) {
    *this = Tile(columns, rows, first.bottom, first.top);
    return;
  }
  bottom_ = first.bottom;
  tops_.assign(kDexels, bottom_);
  for (const DexelInterval& interval : material) {
    const std::size_t at = index(interval.row, interval.column);
    if (tops_[at] > bottom_at(at)) {
      if (lower_.empty()) lower_.resize(kSize);
      lower_[static_cast<std::size_t>(interval.row)].push_back({interval.column, bottom_at(at), tops_[at]});
    }
    set_bottom(at, interval.bottom);
    tops_[at] = interval.top;
  }
  for (LowerIntervals& row : lower_) std::sort(row.begin(), row.end(), is_in_order);
  tighten();
}

std::size_t Tile::memory() const {
  std::size_t bytes = sizeof(Tile) + (tops_.capacity() + bottoms_.capacity()) * sizeof(float) +
                      tags_.capacity() * sizeof(CutTag) + lower_.capacity() * sizeof(LowerIntervals);
  for (const LowerIntervals& row : lower_) bytes += row.capacity() * sizeof(LowerInterval);
  return bytes;
}

double Tile::length() const {
  if (is_uniform()) return static_cast<double>(ceiling_ - floor_) * columns_ * rows_;
  double sum = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t at = index(row, column);
      sum += std::max(0.0F, tops_[at] - bottom_at(at));
    }
    if (has_lower(row))
      for (const LowerInterval& interval : lower_[static_cast<std::size_t>(row)]) sum += interval.top - interval.bottom;
  }
  return sum;
}

std::vector<HeightInterval> Tile::intervals(int row, int column) const {
  std::vector<HeightInterval> all;
  if (is_uniform()) {
    if (!is_empty()) all.push_back({floor_, ceiling_});
    return all;
  }
  const std::size_t at = index(row, column);
  if (has_lower(row))
    for (const LowerInterval& interval : lower_[static_cast<std::size_t>(row)])
      if (interval.column == column) all.insert(all.begin(), {interval.bottom, interval.top});
  if (tops_[at] > bottom_at(at)) all.push_back({bottom_at(at), tops_[at]});
  return all;
}

bool Tile::has_same_material(const Tile& other, int row, int column) const {
  const std::size_t at = index(row, column);
  if (has_lower(row) || other.has_lower(row)) {
    const std::vector<HeightInterval> here = intervals(row, column);
    const std::vector<HeightInterval> there = other.intervals(row, column);
    return std::equal(here.begin(), here.end(), there.begin(), there.end(),
                      [](const auto& one, const auto& two) { return one.bottom == two.bottom && one.top == two.top; });
  }
  const float bottom = is_uniform() ? floor_ : bottom_at(at);
  const float top = is_uniform() ? ceiling_ : tops_[at];
  const float other_bottom = other.is_uniform() ? other.floor_ : other.bottom_at(at);
  const float other_top = other.is_uniform() ? other.ceiling_ : other.tops_[at];
  return (bottom == other_bottom && top == other_top) || (!(bottom < top) && !(other_bottom < other_top));
}

std::optional<float> Tile::top(int row, int column) const {
  if (is_uniform()) return is_empty() ? std::nullopt : std::optional(ceiling_);
  const std::size_t at = index(row, column);
  return tops_[at] > bottom_at(at) ? std::optional(tops_[at]) : std::nullopt;
}

void Tile::highest(int row, int first, int size, float* tops) const {
  constexpr float kNothing = -std::numeric_limits<float>::infinity();
  if (is_uniform()) {
    std::fill_n(tops, size, is_empty() ? kNothing : ceiling_);
    return;
  }
  const std::size_t start = index(row, first);
  for (int i = 0; i < size; ++i) {
    const std::size_t at = start + static_cast<std::size_t>(i);
    tops[i] = tops_[at] > bottom_at(at) ? tops_[at] : kNothing;
  }
}

std::optional<CutTag> Tile::cut_by(int row, int column) const {
  if (tags_.empty() || tags_[index(row, column)] == kUncut) return {};
  return tags_[index(row, column)];
}

void Tile::prepare() {
  if (tops_.empty()) tops_.assign(kDexels, ceiling_);
  if (tags_.empty()) tags_.assign(kDexels, kUncut);
}

void Tile::tighten() {
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t at = index(row, column);
      if (!(tops_[at] > bottom_at(at))) continue;
      high = std::max(high, tops_[at]);
      low = std::min(low, bottom_at(at));
    }
    if (has_lower(row))
      for (const LowerInterval& interval : lower_[static_cast<std::size_t>(row)]) low = std::min(low, interval.bottom);
  }
  floor_ = low < high ? low : bottom_;
  ceiling_ = low < high ? high : bottom_;
}

void Tile::set_bottom(std::size_t index, float bottom) {
  if (bottoms_.empty()) {
    if (bottom == bottom_) return;
    bottoms_.assign(kDexels, bottom_);
  }
  bottoms_[index] = bottom;
}

void Tile::insert_lower(int row, const LowerInterval& interval) {
  if (lower_.empty()) lower_.resize(kSize);
  LowerIntervals& all = lower_[static_cast<std::size_t>(row)];
  all.insert(std::upper_bound(all.begin(), all.end(), interval, is_in_order), interval);
}

bool Tile::has_lower(int row, int column) const {
  if (!has_lower(row)) return false;
  const LowerIntervals& all = lower_[static_cast<std::size_t>(row)];
  const auto at = std::lower_bound(all.begin(), all.end(), column,
                                   [](const LowerInterval& each, int wanted) { return each.column < wanted; });
  return at != all.end() && at->column == column;
}

/// One interval in the dexel; the frequent cases first.
void Tile::cut_single(int row, int column, float bottom, float top, CutTag tag, CutCount& count) {
  const std::size_t at = index(row, column);
  const float old_top = tops_[at];
  const float old_bottom = bottom_at(at);
  bottom = std::max(bottom, old_bottom);
  top = std::min(top, old_top);
  if (!(bottom < top)) return;
  if (bottom - old_bottom < kSkin) bottom = old_bottom;
  if (old_top - top < kSkin) top = old_top;
  count.length += stepped(top - bottom);
  count.note(row, column, top - bottom, bottom);
  tags_[at] = tag;
  if (top == old_top) {
    tops_[at] = bottom;
  } else {
    set_bottom(at, top);
    if (bottom > old_bottom) insert_lower(row, {column, old_bottom, bottom});
  }
}

void Tile::cut_dexel(int row, int column, float bottom, float top, CutTag tag, CutCount& count) {
  if (has_lower(row, column)) return cut_dexel_of_many(row, column, bottom, top, tag, count);
  cut_single(row, column, bottom, top, tag, count);
}

/// Several intervals in the dexel.
void Tile::cut_dexel_of_many(int row, int column, float bottom, float top, CutTag tag, CutCount& count) {
  const std::size_t at = index(row, column);
  LowerIntervals& all = lower_[static_cast<std::size_t>(row)];
  const auto is_before = [](const LowerInterval& interval, int wanted) { return interval.column < wanted; };
  const auto first = std::lower_bound(all.begin(), all.end(), column, is_before);
  const auto last = std::lower_bound(first, all.end(), column + 1, is_before);
  const auto meets = [&](float from, float to) { return std::max(bottom, from) < std::min(top, to); };
  if (!meets(bottom_at(at), tops_[at]) &&
      std::none_of(first, last, [&](const LowerInterval& each) { return meets(each.bottom, each.top); }))
    return;
  thread_local LowerIntervals left;  // From the highest one down. Kept, so that its memory is.
  left.clear();
  float removed = 0;
  float lowest = top;
  const auto cut = [&](float old_bottom, float old_top) {
    float cut_bottom = std::max(bottom, old_bottom);
    float cut_top = std::min(top, old_top);
    if (!(cut_bottom < cut_top)) {
      left.push_back({column, old_bottom, old_top});
      return;
    }
    if (cut_bottom - old_bottom < kSkin) cut_bottom = old_bottom;
    if (old_top - cut_top < kSkin) cut_top = old_top;
    removed += cut_top - cut_bottom;
    lowest = cut_bottom;
    if (cut_top < old_top) left.push_back({column, cut_top, old_top});
    if (old_bottom < cut_bottom) left.push_back({column, old_bottom, cut_bottom});
  };
  cut(bottom_at(at), tops_[at]);
  for (auto each = first; each != last; ++each) cut(each->bottom, each->top);
  if (!(removed > 0)) return;
  count.length += stepped(removed);
  count.note(row, column, removed, lowest);
  tags_[at] = tag;
  const auto place = all.erase(first, last);
  if (left.empty()) {
    tops_[at] = bottom_at(at);
    return;
  }
  tops_[at] = left.front().top;
  set_bottom(at, left.front().bottom);
  all.insert(place, left.begin() + 1, left.end());
}

/// For cuts that reach above all material of a row in which no dexel has a second interval. `bottoms` holds one bound
/// for each dexel, or is null where `lowest` is that of all of them.
void Tile::cut_from_above(int row, int first, int last, const float* bottoms, float lowest, CutTag tag,
                          CutCount& count) {
  const std::size_t start = index(row, first);
  float* const tops = tops_.data() + start;
  CutTag* const tags = tags_.data() + start;
  const float* const floors = bottoms_.empty() ? nullptr : bottoms_.data() + start;
  const int size = last - first;
  std::array<double, kLanes> sums{};
  const auto note = [&](int from, int number, const float* removed, const float* after) {
    for (int i = 0; i < number; ++i) count.note(row, first + from + i, removed[i], after[i]);
  };
  int i = 0;
  for (; i + kLanes <= size; i += kLanes) {
    Eigen::Map<Lanes> top(tops + i);
    Lanes bound = bottoms ? Lanes(Eigen::Map<const Lanes>(bottoms + i)) : Lanes(Lanes::Constant(lowest));
    if (!((top - bound).maxCoeff() > 0)) continue;
    bound = floors ? Lanes(bound.max(Eigen::Map<const Lanes>(floors + i))) : Lanes(bound.max(bottom_));
    const Lanes after = top.min(bound);
    const Lanes removed = top - after;
    top = after;
    const float* const lane = removed.data();
    CutTag* const tag_lane = tags + i;
    for (std::size_t k = 0; k < kLanes; ++k) sums[k] += stepped(lane[k]);
    for (int k = 0; k < kLanes; ++k) tag_lane[k] = lane[k] > 0 ? tag : tag_lane[k];
    if (removed.maxCoeff() > count.inside.depth) note(i, kLanes, removed.data(), after.data());
  }
  double rest = 0;
  for (; i < size; ++i) {
    const float bound = std::max(bottoms ? bottoms[i] : lowest, floors ? floors[i] : bottom_);
    if (!(tops[i] > bound)) continue;
    const float removed = tops[i] - bound;
    rest += stepped(removed);
    tops[i] = bound;
    tags[i] = tag;
    note(i, 1, &removed, &bound);
  }
  for (const double sum : sums) rest += sum;
  count.length += rest;
}

void Tile::cut_run(int row, int first, int last, float bottom, float top, CutTag tag, CutCount& count) {
  if (!(bottom < top) || bottom >= ceiling_ || top <= floor_) return;
  if (top >= ceiling_ && !has_lower(row)) return cut_from_above(row, first, last, nullptr, bottom, tag, count);
  for (int column = first; column < last; ++column) cut_dexel(row, column, bottom, top, tag, count);
}

void Tile::cut_row(int row, int first, int last, const float* bottoms, const float* tops, CutTag tag, CutCount& count) {
  const int size = last - first;
  if (has_lower(row)) {
    for (int i = 0; i < size; ++i)
      if (bottoms[i] < tops[i]) cut_dexel(row, first + i, bottoms[i], tops[i], tag, count);
    return;
  }
  for (int i = 0; i < size; ++i)
    if (bottoms[i] < tops[i]) cut_single(row, first + i, bottoms[i], tops[i], tag, count);
}

void Tile::cut_row(int row, int first, int last, const float* bottoms, float top, CutTag tag, CutCount& count) {
  if (top <= floor_) return;
  if (top >= ceiling_ && !has_lower(row)) return cut_from_above(row, first, last, bottoms, 0, tag, count);
  for (int i = 0; i < last - first; ++i)
    if (bottoms[i] < top) cut_dexel(row, first + i, bottoms[i], top, tag, count);
}

void Tile::meet_dexel(int row, int column, float bottom, float top, DexelCount& count) const {
  float met = 0;
  float lowest = top;
  const auto meet = [&](float from, float to) {
    const float overlap = std::min(top, to) - std::max(bottom, from);
    if (!(overlap > kTouch)) return;
    met += overlap;
    lowest = std::max(bottom, from);
  };
  if (is_uniform()) {
    meet(floor_, ceiling_);
  } else {
    const std::size_t at = index(row, column);
    meet(bottom_at(at), tops_[at]);
    if (has_lower(row))
      for (const LowerInterval& interval : lower_[static_cast<std::size_t>(row)])
        if (interval.column == column) meet(interval.bottom, interval.top);
  }
  count.length += stepped(met);
  note_deepest(count, row, column, met, lowest);
}

void Tile::meet_row(int row, int first, int last, const float* bottoms, const float* tops, DexelCount& count) const {
  for (int i = 0; i < last - first; ++i)
    if (bottoms[i] < tops[i] && bottoms[i] < ceiling_ && tops[i] > floor_)
      meet_dexel(row, first + i, bottoms[i], tops[i], count);
}

}  // namespace isocnc::stock
