#include "interpreter/plot/stock_recording.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace isocnc::plot {

using stock::HeightInterval;
using stock::Stock;
using stock::Tile;
using Material = std::vector<HeightInterval>;

static constexpr std::size_t kMaxMoments = 4000;
static constexpr double kMicrometer = 1e-3;

/// The material of all dexels that are shown, where `material_at` knows that of each of the stock.
template <class MaterialAt>
static std::vector<Material> sampled(const stock::DexelGrid& grid, int first, int step, MaterialAt&& material_at) {
  std::vector<Material> dexels;
  dexels.reserve(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      dexels.push_back(material_at(first + row * step, first + column * step));
  return dexels;
}

StockRecording::StockRecording(const removal::Workpiece& workpiece, const Stock& blank, std::size_t max_dexels)
    : shown_(blank),
      grid_(blank.grid()),
      has_target_(workpiece.target.has_value()),
      shift_(in_units(workpiece.origin.z(), kMicrometer)) {
  const double all = static_cast<double>(grid_.columns) * grid_.rows;
  step_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(all / static_cast<double>(max_dexels)))));
  step_ = std::min({step_, grid_.columns, grid_.rows});
  first_ = (step_ - 1) / 2;
  const auto shown = [&](int count) { return (count - first_ + step_ - 1) / step_; };
  grid_.first += first_ * grid_.spacing;
  grid_.spacing *= step_;
  grid_.per_mm /= step_;
  grid_.columns = shown(grid_.columns);
  grid_.rows = shown(grid_.rows);
  put_picture(sampled(grid_, first_, step_, [&](int row, int column) {
    return blank.tile({column / Tile::kSize, row / Tile::kSize}).intervals(row % Tile::kSize, column % Tile::kSize);
  }));
  if (!has_target_) return;
  std::vector<Material> target(static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows));
  for (int tile_row = 0; tile_row < grid_.tile_rows(); ++tile_row)
    for (int tile_column = 0; tile_column < grid_.tile_columns(); ++tile_column) {
      const stock::DexelGrid part = grid_.tile(tile_column, tile_row);
      const Tile tile = stock::tile_of(*workpiece.target, part);
      for (int row = 0; row < part.rows; ++row)
        for (int column = 0; column < part.columns; ++column)
          target[static_cast<std::size_t>(tile_row * Tile::kSize + row) * static_cast<std::size_t>(grid_.columns) +
                 static_cast<std::size_t>(tile_column * Tile::kSize + column)] = tile.intervals(row, column);
    }
  put_picture(target);
}

void record(removal::MaterialCheck& material, std::optional<StockRecording>& recording) {
  static constexpr std::size_t kMaxDexels = 500'000;
  recording.emplace(material.workpiece(), material.stock(), kMaxDexels);
  material.watch([&recording](const Stock& stock, double time) {
    recording->take(stock, time);
    return time + recording->interval();
  });
}

StockRecording::DexelChange StockRecording::change_of(std::uint32_t dexel, std::uint32_t line,
                                                      const Material& material) {
  DexelChange change{dexel, line, static_cast<std::uint32_t>(heights_.size()),
                     static_cast<std::uint32_t>(material.size())};
  for (auto each = material.rbegin(); each != material.rend(); ++each) {
    heights_.push_back(in_units(each->top, kMicrometer) + shift_);
    heights_.push_back(in_units(each->top, kMicrometer) - in_units(each->bottom, kMicrometer));
  }
  return change;
}

void StockRecording::take(const Stock& now, double time) {
  StockMoment moment{.time = time};
  stock::for_each_change(shown_, now, [&](int row, int column) {
    if (row % step_ != first_ || column % step_ != first_) return;
    const Tile& tile = now.tile({column / Tile::kSize, row / Tile::kSize});
    const int tile_row = row % Tile::kSize;
    const int tile_column = column % Tile::kSize;
    const auto dexel = static_cast<std::uint32_t>((row / step_) * grid_.columns + column / step_);
    moment.changes.push_back(
        change_of(dexel, tile.cut_by(tile_row, tile_column).value_or(0), tile.intervals(tile_row, tile_column)));
  });
  shown_ = now;
  if (moment.changes.empty()) return;
  std::sort(moment.changes.begin(), moment.changes.end(),
            [](const DexelChange& a, const DexelChange& b) { return a.dexel < b.dexel; });
  moments_.push_back(std::move(moment));
  if (moments_.size() > kMaxMoments) thin();
}

/// Makes one moment of every two.
void StockRecording::thin() {
  interval_ *= 2;
  for (std::size_t i = 0; i + 1 < moments_.size(); i += 2) {
    const std::vector<DexelChange>& early = moments_[i].changes;
    const std::vector<DexelChange>& late = moments_[i + 1].changes;
    StockMoment both{.time = moments_[i + 1].time};
    both.changes.reserve(early.size() + late.size());
    auto next = late.begin();
    for (const DexelChange& each : early) {
      for (; next != late.end() && next->dexel < each.dexel; ++next) both.changes.push_back(*next);
      if (next == late.end() || next->dexel != each.dexel) both.changes.push_back(each);
    }
    both.changes.insert(both.changes.end(), next, late.end());
    moments_[i / 2] = std::move(both);
  }
  if (moments_.size() % 2 != 0) moments_[moments_.size() / 2] = std::move(moments_.back());
  moments_.resize((moments_.size() + 1) / 2);
}

std::string_view StockRecording::bytes() {
  if (!std::exchange(is_packed_, true)) {
    double before = 0;
    for (const StockMoment& moment : moments_) {
      put(moment, before);
      before = moment.time;
    }
  }
  return bytes_.bytes();
}

void StockRecording::put_interval(std::int64_t top, std::int64_t length) {
  bytes_.put_signed(top - std::exchange(last_top_, top));
  bytes_.put(static_cast<std::uint64_t>(length));
}

void StockRecording::put_material(const DexelChange& change) {
  bytes_.put(change.count);
  for (std::uint32_t i = 0; i < change.count; ++i)
    put_interval(heights_[change.first + 2 * i], heights_[change.first + 2 * i + 1]);
}

void StockRecording::put_material(const Material& material) {
  bytes_.put(material.size());
  for (auto each = material.rbegin(); each != material.rend(); ++each) {
    const std::int64_t top = in_units(each->top, kMicrometer);
    put_interval(top + shift_, top - in_units(each->bottom, kMicrometer));
  }
}

void StockRecording::put_picture(const std::vector<Material>& dexels) {
  last_top_ = 0;
  const auto is_same_material = [](const Material& a, const Material& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const HeightInterval& one, const HeightInterval& other) {
                        return one.bottom == other.bottom && one.top == other.top;
                      });
  };
  for (std::size_t begin = 0; begin < dexels.size();) {
    std::size_t end = begin + 1;
    while (end < dexels.size() && is_same_material(dexels[begin], dexels[end])) ++end;
    bytes_.put(end - begin);
    put_material(dexels[begin]);
    begin = end;
  }
}

bool StockRecording::is_same(const DexelChange& a, const DexelChange& b) const {
  const auto heights_of = [&](const DexelChange& change) {
    return std::span(heights_).subspan(change.first, std::size_t{2} * change.count);
  };
  const auto one = heights_of(a);
  const auto other = heights_of(b);
  return std::equal(one.begin(), one.end(), other.begin(), other.end());
}

void StockRecording::put(const StockMoment& moment, double before) {
  last_top_ = 0;
  std::vector<DexelChange> changes = moment.changes;
  std::stable_sort(changes.begin(), changes.end(),
                   [](const DexelChange& a, const DexelChange& b) { return a.line < b.line; });
  const auto end_of_group = [&](std::size_t i) {
    const std::uint32_t line = changes[i].line;
    while (i < changes.size() && changes[i].line == line) ++i;
    return i;
  };
  const auto end_of_run = [&](std::size_t i, std::size_t end) {
    for (++i; i < end && changes[i].dexel == changes[i - 1].dexel + 1;) ++i;
    return i;
  };
  std::size_t groups = 0;
  for (std::size_t i = 0; i < changes.size(); i = end_of_group(i)) ++groups;
  const std::int64_t time = in_units(moment.time, 1e-8) - in_units(before, 1e-8);
  bytes_.put(static_cast<std::uint64_t>(std::max<std::int64_t>(0, time)));
  bytes_.put(groups);
  std::int64_t last_line = 0;
  for (std::size_t begin = 0; begin < changes.size();) {
    const std::size_t end = end_of_group(begin);
    bytes_.put_signed(changes[begin].line - std::exchange(last_line, static_cast<std::int64_t>(changes[begin].line)));
    std::size_t runs = 0;
    for (std::size_t i = begin; i < end; i = end_of_run(i, end)) ++runs;
    bytes_.put(runs);
    std::uint32_t after = 0;  // The dexel after the run before.
    for (std::size_t i = begin; i < end;) {
      const std::size_t run_end = end_of_run(i, end);
      bytes_.put(changes[i].dexel - after);
      bytes_.put(run_end - i);
      bool is_one = true;
      for (std::size_t k = i + 1; k < run_end && is_one; ++k) is_one = is_same(changes[i], changes[k]);
      bytes_.put(is_one ? 1 : 0);
      for (std::size_t k = i; k < (is_one ? i + 1 : run_end); ++k) put_material(changes[k]);
      after = changes[run_end - 1].dexel + 1;
      i = run_end;
    }
    begin = end;
  }
}

}  // namespace isocnc::plot
