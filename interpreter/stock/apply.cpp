#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include "interpreter/solids/clearance.h"
#include "interpreter/stock/stock.h"
#include "interpreter/stock/unit_sweep.h"

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// The units of each tile, in order.
class TileBins {
 public:
  TileBins(const UnitSweeps& units, const DexelGrid& grid) : grid_(grid) {
    starts_.assign(static_cast<std::size_t>(grid.tile_columns()) * static_cast<std::size_t>(grid.tile_rows()) + 1, 0);
    for_each(units, [&](std::size_t tile, std::size_t) { ++starts_[tile + 1]; });
    for (std::size_t tile = 1; tile < starts_.size(); ++tile) {
      if (starts_[tile] > 0) {
        const int index = static_cast<int>(tile) - 1;
        tiles_.push_back({index % grid.tile_columns(), index / grid.tile_columns()});
      }
      starts_[tile] += starts_[tile - 1];
    }
    units_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for_each(units,
             [&](std::size_t tile, std::size_t unit) { units_[next[tile]++] = static_cast<std::uint32_t>(unit); });
  }

  /// Those with units, in order.
  std::span<const TileIndex> tiles() const { return tiles_; }
  std::size_t size() const { return units_.size(); }
  /// Where the units of a tile start among all.
  std::size_t start_of(const TileIndex& tile) const { return starts_[number_of(tile)]; }
  std::span<const std::uint32_t> units_of(const TileIndex& tile) const {
    const std::size_t start = start_of(tile);
    return std::span(units_).subspan(start, starts_[number_of(tile) + 1] - start);
  }

 private:
  std::size_t number_of(const TileIndex& tile) const {
    return static_cast<std::size_t>(tile.row * grid_.tile_columns() + tile.column);
  }

  template <class Use>
  void for_each(const UnitSweeps& units, Use&& use) const {
    for (std::size_t i = 0; i < units.size(); ++i) {
      const solids::BoundingBox& box = units[i].bounds;
      const int first_column = grid_.first_column(box.min().x()) / Tile::kSize;
      const int first_row = grid_.first_row(box.min().y()) / Tile::kSize;
      const int columns = (grid_.first_column(box.max().x()) + Tile::kSize - 1) / Tile::kSize;
      const int rows = (grid_.first_row(box.max().y()) + Tile::kSize - 1) / Tile::kSize;
      const bool is_long = (columns - first_column) * (rows - first_row) > 4;
      for (int row = first_row; row < rows; ++row)
        for (int column = first_column; column < columns; ++column)
          if (!is_long || may_touch(units[i], {column, row})) use(number_of({column, row}), i);
    }
  }

  /// False only if a line surely passes a tile.
  bool may_touch(const UnitSweep& unit, const TileIndex& tile) const {
    const auto* line = std::get_if<UprightLine>(&unit.motion);
    if (!line) return true;
    const Vec2 size = Tile::kSize * grid_.spacing;
    const Vec2 center = grid_.first + Vec2(tile.column * size.x(), tile.row * size.y()) + size / 2;
    const double radius = (unit.bounds.max().x() - std::max(line->from.x(), line->to.x())) + size.norm() / 2;
    const Vec2 along = (line->to - line->from).head<2>();
    const Vec2 to_center = center - line->from.head<2>();
    const double share =
        along.squaredNorm() > 0 ? std::clamp(to_center.dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
    return (to_center - share * along).squaredNorm() <= radius * radius;
  }

  const DexelGrid& grid_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> units_;
  std::vector<TileIndex> tiles_;
};

double tilt_of(const Sweep& sweep) {
  if (const auto* straight = std::get_if<StraightPath>(&sweep.path)) return straight->from.axis.z();
  if (const auto* helix = std::get_if<HelixPath>(&sweep.path)) return helix->axis.z();
  const TurningPath& turning = std::get<TurningPath>(sweep.path);
  return std::max(std::abs(turning.from.axis.z()), std::abs(turning.to.axis.z()));
}

/// Where the depth of the cut of a unit is told.
CutBand band_of(const UnitSweep& unit, const SweptShape& shape, const Sweep& sweep) {
  if (!(sweep.side_rim > 0 || sweep.end_rim > 0)) return {};
  if (const auto* line = std::get_if<UprightLine>(&unit.motion))
    return CutBand::along_line(line->from.head<2>(), line->to.head<2>(), shape.radius, sweep.side_rim, sweep.end_rim);
  if (const auto* arc = std::get_if<LevelArc>(&unit.motion))
    return CutBand::along_arc(arc->center, arc->start, arc->end, shape.radius, sweep.side_rim, sweep.end_rim);
  // While the axis turns the units are poses and very short ways: what counts is the way of all of them.
  if (const auto* turning = std::get_if<TurningPath>(&sweep.path))
    return CutBand::along_slanted(turning->from.origin, turning->from.axis + turning->to.axis,
                                  turning->to.origin - turning->from.origin, shape.radius, sweep.side_rim);
  const SlantedLine& line = std::get<SlantedLine>(unit.motion);
  return CutBand::along_slanted(line.from.origin, line.from.axis, line.travel, shape.radius, sweep.side_rim);
}

void take_deeper(const DeepestDexel& dexel, const DexelGrid& part, double tilt, double& depth, geometry::Vec3& point) {
  const double deep = static_cast<double>(dexel.depth) * tilt;
  if (dexel.row < 0 || deep < depth || (deep == depth && depth > 0)) return;
  depth = deep;
  point = {part.x(dexel.column), part.y(dexel.row), dexel.bottom};
}

/// Adds what one unit has met in one tile.
void add(const DexelCount& count, const DexelGrid& part, double cell, double tilt, SweepOutcome& outcome) {
  outcome.volume += count.length * cell;
  outcome.length = std::max(outcome.length, static_cast<double>(count.all.depth));
  take_deeper(count.all, part, tilt, outcome.depth, outcome.point);
  take_deeper(count.inside, part, tilt, outcome.inside_depth, outcome.inside_point);
}

/// What sweeps that find have met in one tile, and what of the others is therefore known.
class FoundInTile {
 public:
  /// What a unit counts without being looked at; none if it has to be.
  std::optional<DexelCount> known(const Sweep& sweep, const UnitSweep& unit) {
    if (sweep.purpose != SweepPurpose::Find || !sweep_) return std::nullopt;
    if (unit.sweep == *sweep_) {
      const bool is_known = is_whole_ || (piece_ == unit.piece && std::holds_alternative<TurningPath>(sweep.path));
      return is_known ? std::optional(DexelCount()) : std::nullopt;
    }
    if (!sweep.contains_last || unit.sweep != *sweep_ + 1) return std::nullopt;
    sweep_ = unit.sweep;
    is_whole_ = true;
    return count_;
  }

  void note(const UnitSweep& unit, const DexelCount& count) {
    if (count.all.row < 0) return;
    if (sweep_ != unit.sweep || count.all.depth > count_.all.depth) count_ = count;
    sweep_ = unit.sweep;
    piece_ = unit.piece;
    is_whole_ = false;
  }

 private:
  std::optional<std::uint32_t> sweep_;  ///< The last one that has met something.
  std::uint32_t piece_ = 0;             ///< The piece of its body that did.
  bool is_whole_ = false;               ///< Nothing else of it counts.
  DexelCount count_;                    ///< The deepest.
};

/// Sweeps that turn have many units; asks once for all of them whether they pass a tile.
class PassedTile {
 public:
  explicit PassedTile(const UnitSweeps& units_of_all) : all_(units_of_all) {}

  /// `units` are the indexes of the tile's units, `i` the present one.
  bool is_passed(const Sweep& sweep, std::span<const std::uint32_t> units, std::size_t i, const DexelGrid& part,
                 const Tile& tile) {
    const UnitSweep& unit = all_[units[i]];
    if (sweep_ == unit.sweep) return is_passed_;
    sweep_ = unit.sweep;
    is_passed_ = false;
    const auto* const path = std::get_if<TurningPath>(&sweep.path);
    const bool has_many = i + kMany < units.size() && all_[units[i + kMany]].sweep == unit.sweep;
    if (!path || !has_many) return false;
    const Vec3 axis = path->from.axis + path->to.axis;
    const double length = axis.norm();
    if (!(length > 1)) return false;
    const solids::RevolvedBody& body = *sweep.body;
    const solids::AxisPlacement middle{(path->from.origin + path->to.origin) / 2, axis / length};
    // No point of the body leaves its place in the middle by more.
    const double most =
        (path->to.origin - path->from.origin).norm() / 2 +
        body.reach(0) * std::max((path->to.axis - middle.axis).norm(), (path->from.axis - middle.axis).norm());
    const solids::Cuboid box{{part.x(0), part.y(0), static_cast<double>(tile.floor())},
                             {part.x(part.columns - 1), part.y(part.rows - 1), static_cast<double>(tile.ceiling())}};
    is_passed_ = solids::clearance(body, middle, box, most).lower >= most;
    return is_passed_;
  }

 private:
  static constexpr std::size_t kMany = 4;

  const UnitSweeps& all_;
  std::optional<std::uint32_t> sweep_;
  bool is_passed_ = false;
};

/// Sweeps that are divided into units at once.
constexpr std::size_t kAtOnce = 8192;

}  // namespace

void for_each_number(const Workers& workers, std::size_t count, const std::function<void(std::size_t)>& use) {
  std::atomic<std::size_t> taken = 0;
  std::atomic<std::size_t> from_front = 0;
  std::atomic<std::size_t> from_back = 0;
  std::atomic<unsigned> threads = 0;
  const auto work = [&] {
    const bool is_at_front = threads++ % 2 == 0;
    while (taken++ < count) use(is_at_front ? from_front++ : count - 1 - from_back++);
  };
  if (workers && count > 1) {
    workers(work);
  } else {
    work();
  }
}

std::vector<SweepOutcome> Stock::apply(std::span<const Sweep> sweeps, const Workers& workers) {
  std::vector<SweepOutcome> outcomes;
  outcomes.reserve(sweeps.size());
  for (std::size_t i = 0; i < sweeps.size(); i += kAtOnce)
    for (const SweepOutcome& each : apply_together(sweeps.subspan(i, std::min(kAtOnce, sweeps.size() - i)), workers))
      outcomes.push_back(each);
  return outcomes;
}

std::vector<SweepOutcome> Stock::apply_together(std::span<const Sweep> sweeps, const Workers& workers) {
  std::vector<SweepOutcome> outcomes(sweeps.size());
  const UnitSweeps divided(sweeps, spacing(), bounds().max().z(), workers);
  const TileBins bins(divided, grid());
  std::vector<DexelCount> counts(bins.size());
  own(bins.tiles());

  const auto work_on = [&](const TileIndex& index) {
    TilePointer& pointer = tile_to_cut(index);
    if (pointer->is_empty()) return;
    const DexelGrid part = grid().tile(index.column, index.row);
    TilePointer changed;  // Once there is a cut.
    const auto units = bins.units_of(index);
    bool is_cut = false;
    const UnitSweep* before = nullptr;  // The last one that has cut.
    FoundInTile found;
    PassedTile passed(divided);
    for (std::size_t i = 0; i < units.size(); ++i) {
      const UnitSweep& unit = divided[units[i]];
      const Sweep& sweep = sweeps[unit.sweep];
      const Tile& present = changed ? *changed : *pointer;
      if (!(unit.bounds.min().z() < present.ceiling() && unit.bounds.max().z() > present.floor())) continue;
      if (passed.is_passed(sweep, units, i, part, present)) continue;
      DexelCount& count = counts[bins.start_of(index) + i];
      if (sweep.purpose != SweepPurpose::Cut) {
        if (const auto known = found.known(sweep, unit)) {
          count = *known;
          continue;
        }
        DexelSink sink(present, part, sweep.purpose == SweepPurpose::Find);
        divided.apply(unit, nullptr, sink);
        count = sink.count();
        found.note(unit, count);
        continue;
      }
      if (!changed) {
        changed = !pointer->is_uniform() && pointer.use_count() == 1 ? pointer : std::make_shared<Tile>(*pointer);
        std::atomic_thread_fence(std::memory_order_acquire);
        changed->prepare();
      }
      DexelSink sink(*changed, part, sweep.tag, band_of(unit, divided.shape_of(unit), sweep), sweep.depth_limit);
      divided.apply(unit, before, sink);
      before = &unit;
      count = sink.count();
      is_cut |= count.all.row >= 0;
    }
    if (!is_cut) return;
    changed->tighten();
    pointer = std::move(changed);
  };

  for_each_number(workers, bins.tiles().size(), [&](std::size_t i) { work_on(bins.tiles()[i]); });

  // In the order of the tiles, whichever thread was at them.
  for (const TileIndex& index : bins.tiles()) {
    const DexelGrid part = grid().tile(index.column, index.row);
    const auto units = bins.units_of(index);
    for (std::size_t i = 0; i < units.size(); ++i) {
      const UnitSweep& unit = divided[units[i]];
      const DexelCount& count = counts[bins.start_of(index) + i];
      if (count.all.row >= 0)
        add(count, part, grid().cell(), std::abs(tilt_of(sweeps[unit.sweep])), outcomes[unit.sweep]);
    }
  }
  return outcomes;
}

}  // namespace isocnc::stock
