#include "interpreter/removal/left_material.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "interpreter/stock/tile.h"

namespace isocnc::removal {

using stock::DexelGrid;
using stock::HeightInterval;
using stock::Stock;
using stock::Tile;

/// Regions that are told.
static constexpr std::size_t kMaxRegions = 20;
/// Fewer dexels are no region: they stand between two dexels of the finished part.
static constexpr std::size_t kMinDexels = 4;

namespace {

using Intervals = std::vector<HeightInterval>;

/// Dexels of a row that follow each other, all with material left.
struct Run {
  int row = 0;
  int first = 0;
  int last = 0;  ///< Exclusive.
  bool is_on_target = false;
  std::size_t dexels = 0;
  LeftRegion region;
};

/// The union of sets that have been found to be one.
class Sets {
 public:
  explicit Sets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t one = find(a);
    const std::size_t other = find(b);
    parents_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::size_t> parents_;
};

/// Compares a stock with its target, block by block.
class TargetComparison {
 public:
  TargetComparison(const Stock& stock, const stock::Blank& target, double tolerance)
      : stock_(stock),
        target_(target),
        tolerance_(tolerance),
        // The wall of the target is somewhere between two dexels.
        reach_(tolerance + 0.75 * stock.spacing()),
        margin_(std::clamp(static_cast<int>(std::ceil(reach_ / stock.grid().spacing.minCoeff())), 1, kMaxMargin) + 1) {}

  std::vector<Run> runs() {
    const int inner = Tile::kSize - 2 * margin_;
    for (int row = 0; row < stock_.grid().rows; row += inner) {
      for (int column = 0; column < stock_.grid().columns; column += inner) compare(row, column, inner);
    }
    std::sort(runs_.begin(), runs_.end(),
              [](const Run& a, const Run& b) { return a.row != b.row ? a.row < b.row : a.first < b.first; });
    return std::move(runs_);
  }

 private:
  static constexpr int kMaxMargin = 48;

  /// The dexels of the target around a block. Beyond the border of the stock there may be target, too.
  std::vector<Intervals> target_around(int row, int column) const {
    DexelGrid grid = stock_.grid();
    grid.first += Eigen::Vector2d((column - margin_) * grid.spacing.x(), (row - margin_) * grid.spacing.y());
    grid.columns = grid.rows = Tile::kSize;
    const Tile tile = stock::tile_of(target_, grid);
    std::vector<Intervals> dexels;
    dexels.reserve(static_cast<std::size_t>(Tile::kSize) * Tile::kSize);
    for (int r = 0; r < Tile::kSize; ++r)
      for (int c = 0; c < Tile::kSize; ++c) dexels.push_back(tile.intervals(r, c));
    return dexels;
  }

  void compare(int first_row, int first_column, int inner) {
    const DexelGrid& grid = stock_.grid();
    const std::vector<Intervals> target = target_around(first_row, first_column);
    const auto target_at = [&](int r, int c) -> const Intervals& {
      return target[static_cast<std::size_t>(r) * Tile::kSize + static_cast<std::size_t>(c)];
    };
    const int rows = std::min(inner, grid.rows - first_row);
    const int columns = std::min(inner, grid.columns - first_column);
    for (int r = 0; r < rows; ++r) {
      bool goes_on = false;
      for (int c = 0; c < columns; ++c) {
        const int row = first_row + r;
        const int column = first_column + c;
        const Intervals left = left_at(row, column, r + margin_, c + margin_, target_at);
        if (left.empty()) {
          goes_on = false;
          continue;
        }
        if (!goes_on) runs_.push_back({.row = row, .first = column});
        goes_on = true;
        add(runs_.back(), row, column, left, r + margin_, c + margin_, target_at);
      }
    }
  }

  /// What a dexel of the stock has beyond the target around it.
  template <class TargetAt>
  Intervals left_at(int row, int column, int r, int c, const TargetAt& target_at) const {
    Intervals left = intervals_of(row, column);
    const DexelGrid& grid = stock_.grid();
    for (int dr = -margin_; dr <= margin_ && !left.empty(); ++dr) {
      for (int dc = -margin_; dc <= margin_ && !left.empty(); ++dc) {
        const double aside = std::hypot(dr * grid.spacing.y(), dc * grid.spacing.x());
        if (aside > std::max(reach_, grid.spacing.maxCoeff())) continue;
        for (const HeightInterval& each : target_at(r + dr, c + dc))
          remove(left, {each.bottom - tolerance_, each.top + tolerance_});
      }
    }
    return left;
  }

  static void remove(Intervals& from, const HeightInterval& what) {
    Intervals rest;
    for (const HeightInterval& each : from) {
      const HeightInterval low{each.bottom, std::min(each.top, what.bottom)};
      const HeightInterval high{std::max(each.bottom, what.top), each.top};
      if (low.length() > Tile::kTouch) rest.push_back(low);
      if (high.length() > Tile::kTouch) rest.push_back(high);
    }
    from = std::move(rest);
  }

  Intervals intervals_of(int row, int column) const {
    const Tile& tile = stock_.tile({column / Tile::kSize, row / Tile::kSize});
    return tile.intervals(row % Tile::kSize, column % Tile::kSize);
  }

  template <class TargetAt>
  void add(Run& run, int row, int column, const Intervals& left, int r, int c, const TargetAt& target_at) {
    const DexelGrid& grid = stock_.grid();
    run.last = column + 1;
    ++run.dexels;
    double height = 0;
    for (const HeightInterval& each : left) height += each.length();
    run.region.volume += height * grid.cell();
    if (height > run.region.height) {
      run.region.height = height;
      run.region.point = {grid.x(column), grid.y(row), left.back().top};
    }
    note_last_cut(row, column, run.region);
    run.is_on_target = run.is_on_target || hangs_on_target(row, column, r, c, target_at);
  }

  /// Whether this dexel, or one as near as the margin, has stock within the target, in one piece with what is here.
  template <class TargetAt>
  bool hangs_on_target(int row, int column, int r, int c, const TargetAt& target_at) const {
    static constexpr int kDirections[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    const Intervals own = intervals_of(row, column);
    if (overlap(own, target_at(r, c))) return true;
    for (const auto& [dr, dc] : kDirections) {
      Intervals joined = own;
      for (int step = 1; step <= margin_ && !joined.empty(); ++step) {
        if (!is_inside(row + step * dr, column + step * dc)) break;
        Intervals beside = intervals_of(row + step * dr, column + step * dc);
        std::erase_if(beside, [&](const HeightInterval& each) { return !overlap({each}, joined); });
        if (overlap(beside, target_at(r + step * dr, c + step * dc))) return true;
        joined = std::move(beside);
      }
    }
    return false;
  }

  static bool overlap(const Intervals& some, const Intervals& others) {
    return std::any_of(some.begin(), some.end(), [&](const HeightInterval& one) {
      return std::any_of(others.begin(), others.end(),
                         [&](const HeightInterval& other) { return one.bottom < other.top && other.bottom < one.top; });
    });
  }
  bool is_inside(int row, int column) const {
    return row >= 0 && column >= 0 && row < stock_.grid().rows && column < stock_.grid().columns;
  }

  /// Also cuts beside a dexel were near it.
  void note_last_cut(int row, int column, LeftRegion& region) const {
    static constexpr int kSteps[][2] = {{0, 0}, {0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    for (const auto& [dr, dc] : kSteps) {
      if (!is_inside(row + dr, column + dc)) continue;
      const Tile& tile = stock_.tile({(column + dc) / Tile::kSize, (row + dr) / Tile::kSize});
      if (const auto tag = tile.cut_by((row + dr) % Tile::kSize, (column + dc) % Tile::kSize))
        region.last_cut = std::max(region.last_cut.value_or(0), *tag);
    }
  }

  const Stock& stock_;
  const stock::Blank& target_;
  double tolerance_;
  double reach_;
  int margin_;
  std::vector<Run> runs_;
};

void add(const Run& run, Run& to) {
  to.dexels += run.dexels;
  to.is_on_target = to.is_on_target || run.is_on_target;
  to.region.volume += run.region.volume;
  if (run.region.last_cut) to.region.last_cut = std::max(to.region.last_cut.value_or(0), *run.region.last_cut);
  if (run.region.height <= to.region.height) return;
  to.region.height = run.region.height;
  to.region.point = run.region.point;
}

}  // namespace

std::vector<LeftRegion> left_on_target(const Stock& stock, const stock::Blank& target, double tolerance) {
  std::vector<Run> runs = TargetComparison(stock, target, tolerance).runs();
  Sets sets(runs.size());
  std::size_t below = 0;  // The first run of the row before that may touch.
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i > 0 && runs[i - 1].row == runs[i].row && runs[i - 1].last == runs[i].first) sets.join(i - 1, i);
    while (below < i && (runs[below].row < runs[i].row - 1 ||
                         (runs[below].row == runs[i].row - 1 && runs[below].last <= runs[i].first)))
      ++below;
    for (std::size_t k = below; k < i && runs[k].row == runs[i].row - 1 && runs[k].first < runs[i].last; ++k)
      if (runs[k].last > runs[i].first) sets.join(i, k);
  }
  for (std::size_t i = runs.size(); i-- > 0;)
    if (const std::size_t set = sets.find(i); set != i) add(runs[i], runs[set]);
  std::vector<LeftRegion> regions;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (sets.find(i) == i && runs[i].is_on_target && runs[i].dexels >= kMinDexels) regions.push_back(runs[i].region);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const LeftRegion& a, const LeftRegion& b) { return a.volume > b.volume; });
  if (regions.size() > kMaxRegions) regions.resize(kMaxRegions);
  return regions;
}

}  // namespace isocnc::removal
