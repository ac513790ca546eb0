#include "interpreter/stock/pieces.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace isocnc::stock {

using solids::BoundingBox;

namespace {

using Mark = std::uint32_t;
constexpr Mark kNoMark = 0xFFFFFFFF;

/// Sets of labels that turn out to mean the same piece.
class LabelSets {
 public:
  Mark add() {
    parents_.push_back(static_cast<Mark>(parents_.size()));
    return parents_.back();
  }
  Mark root(Mark label) {
    while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
    return label;
  }
  void join(Mark one, Mark other) {
    one = root(one);
    other = root(other);
    parents_[std::max(one, other)] = std::min(one, other);
  }
  std::size_t size() const { return parents_.size(); }

 private:
  std::vector<Mark> parents_;
};

/// An interval of a dexel in a row or a column of a tile.
struct LabelledInterval {
  int at;  ///< Index of the dexel.
  float bottom;
  float top;
  Mark label;
};

/// Those of a row or a column, by dexel, then from the lowest one up.
using LabelledRow = std::vector<LabelledInterval>;

}  // namespace

/// Which interval belongs to which piece.
class PieceLabels {
 public:
  explicit PieceLabels(const Stock& stock) : stock_(stock), across_(stock.grid().tile_columns()) {
    const DexelGrid& grid = stock_.grid();
    tiles_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(grid.tile_rows()));
    for_each_tile([&](const TileIndex& index) {
      if (stock_.tile(index).is_uniform()) {
        label_uniform(index);
      } else {
        label_rows(index);
      }
    });
  }

  std::vector<StockPiece> measure() {
    std::vector<StockPiece> pieces = number_pieces();
    std::vector<PieceExtent> extents(pieces.size());
    for_each_tile([&](const TileIndex& index) {
      const Tile& tile = stock_.tile(index);
      const int row = index.row * Tile::kSize;
      const int column = index.column * Tile::kSize;
      if (tile.is_uniform()) {
        if (!tile.is_empty())
          extents[labels(index).front()].add(row, column, tile.rows(), tile.columns(), tile.floor(), tile.ceiling());
        return;
      }
      const Mark* label = labels(index).data();
      for (int i = 0; i < tile.rows(); ++i)
        tile.for_each_interval(
            i, [&](int k, float bottom, float top) { extents[*label++].add(row + i, column + k, 1, 1, bottom, top); });
    });
    for (StockPiece& piece : pieces) extents[piece.number].describe(piece, stock_.grid());
    return pieces;
  }

  /// After measure().
  bool has_material_in(const StockPiece& piece, const BoundingBox& box) const {
    const DexelGrid& grid = stock_.grid();
    const auto is_in = [](double value, double least, double most) { return value >= least && value <= most; };
    return is_any_tile(piece.bounds.intersection(box), [&](const TileIndex& index) {
      bool is_found = false;
      for_each_interval(piece, index, [&](int row, int column, float bottom, float top) {
        is_found =
            is_found ||
            (static_cast<double>(bottom) <= box.max().z() && static_cast<double>(top) >= box.min().z() &&
             is_in(grid.x(column), box.min().x(), box.max().x()) && is_in(grid.y(row), box.min().y(), box.max().y()));
      });
      return is_found;
    });
  }

  /// After measure().
  template <class Use>
  void for_each_interval(const StockPiece& piece, Use&& use) const {
    is_any_tile(piece.bounds, [&](const TileIndex& index) {
      for_each_interval(piece, index, use);
      return false;
    });
  }

  /// After measure().
  std::optional<CutTag> last_cut_beside(const StockPiece& piece) const {
    std::optional<CutTag> last;
    for_each_interval(piece, [&](int row, int column, float, float) {
      for (const auto& [down, right] : {std::pair(0, 0), {0, -1}, {0, 1}, {-1, 0}, {1, 0}}) {
        const auto tag = cut_by(row + down, column + right);
        if (tag && (!last || *tag > *last)) last = tag;
      }
    });
    return last;
  }

 private:
  /// How far the dexels of a piece reach.
  class PieceExtent {
   public:
    void add(int row, int column, int rows, int columns, float bottom, float top) {
      length_ += static_cast<double>(top - bottom) * rows * columns;
      first_row_ = std::min(first_row_, row);
      last_row_ = std::max(last_row_, row + rows - 1);
      first_column_ = std::min(first_column_, column);
      last_column_ = std::max(last_column_, column + columns - 1);
      bottom_ = std::min(bottom_, bottom);
      top_ = std::max(top_, top);
    }
    void describe(StockPiece& piece, const DexelGrid& grid) const {
      const geometry::Vec2 half = grid.spacing / 2;
      piece.volume = length_ * grid.cell();
      piece.bounds = {
          geometry::Vec3(grid.x(first_column_) - half.x(), grid.y(first_row_) - half.y(), static_cast<double>(bottom_)),
          geometry::Vec3(grid.x(last_column_) + half.x(), grid.y(last_row_) + half.y(), static_cast<double>(top_))};
    }

   private:
    double length_ = 0;
    int first_row_ = std::numeric_limits<int>::max();
    int last_row_ = -1;
    int first_column_ = std::numeric_limits<int>::max();
    int last_column_ = -1;
    float bottom_ = std::numeric_limits<float>::infinity();
    float top_ = -std::numeric_limits<float>::infinity();
  };

  /// Calls `use(row, column, bottom, top)`, of the whole grid, with the intervals of a piece in a tile.
  template <class Use>
  void for_each_interval(const StockPiece& piece, const TileIndex& index, Use&& use) const {
    const Tile& tile = stock_.tile(index);
    if (tile.is_empty()) return;
    const Mark* label = labels(index).data();
    const int step = tile.is_uniform() ? 0 : 1;
    for (int row = 0; row < tile.rows(); ++row)
      tile.for_each_interval(row, [&](int column, float bottom, float top) {
        if (*label == piece.number)
          use(index.row * Tile::kSize + row, index.column * Tile::kSize + column, bottom, top);
        label += step;
      });
  }

  /// Whether `is_it(index)` holds for any tile of a box, which may be empty.
  template <class IsIt>
  bool is_any_tile(const BoundingBox& box, IsIt&& is_it) const {
    if (box.isEmpty()) return false;
    const DexelGrid& grid = stock_.grid();
    const int first_column = grid.first_column(box.min().x()) / Tile::kSize;
    const int first_row = grid.first_row(box.min().y()) / Tile::kSize;
    const int columns = std::min(across_, grid.first_column(box.max().x()) / Tile::kSize + 1);
    const int rows = std::min(grid.tile_rows(), grid.first_row(box.max().y()) / Tile::kSize + 1);
    for (int row = first_row; row < rows; ++row)
      for (int column = first_column; column < columns; ++column)
        if (is_it(TileIndex{column, row})) return true;
    return false;
  }

  template <class Use>
  void for_each_tile(Use&& use) const {
    for (int row = 0; row < stock_.grid().tile_rows(); ++row)
      for (int column = 0; column < across_; ++column) use(TileIndex{column, row});
  }

  std::size_t number_of(const TileIndex& index) const {
    return static_cast<std::size_t>(index.row) * static_cast<std::size_t>(across_) +
           static_cast<std::size_t>(index.column);
  }
  std::vector<Mark>& labels(const TileIndex& index) { return tiles_[number_of(index)]; }
  const std::vector<Mark>& labels(const TileIndex& index) const { return tiles_[number_of(index)]; }

  /// The last row of a tile that has labels; of a uniform one, one interval for all of it, at -1.
  LabelledRow last_row(const TileIndex& index) const {
    LabelledRow result;
    if (index.row < 0) return result;
    const Tile& tile = stock_.tile(index);
    if (append_uniform(index, result)) return result;
    tile.for_each_interval(tile.rows() - 1, [&](int column, float bottom, float top) {
      result.push_back({column, bottom, top, kNoMark});
    });
    std::size_t next = labels(index).size() - result.size();
    for (LabelledInterval& interval : result) interval.label = labels(index)[next++];
    return result;
  }
  /// The same of its last column.
  LabelledRow last_column(const TileIndex& index) const {
    LabelledRow result;
    if (index.column < 0) return result;
    const Tile& tile = stock_.tile(index);
    if (append_uniform(index, result)) return result;
    std::size_t next = 0;
    for (int row = 0; row < tile.rows(); ++row)
      tile.for_each_interval(row, [&](int column, float bottom, float top) {
        const Mark label = labels(index)[next++];
        if (column == tile.columns() - 1) result.push_back({row, bottom, top, label});
      });
    return result;
  }
  bool append_uniform(const TileIndex& index, LabelledRow& row) const {
    const Tile& tile = stock_.tile(index);
    if (!tile.is_uniform()) return false;
    if (!tile.is_empty()) row.push_back({-1, tile.floor(), tile.ceiling(), labels(index).front()});
    return true;
  }

  void label_uniform(const TileIndex& index) {
    const Tile& tile = stock_.tile(index);
    if (tile.is_empty()) return;
    const Mark label = sets_.add();
    labels(index).push_back(label);
    for (const LabelledRow& beside :
         {last_row({index.column, index.row - 1}), last_column({index.column - 1, index.row})})
      for (const LabelledInterval& other : beside)
        if (other.bottom < tile.ceiling() && other.top > tile.floor()) sets_.join(label, other.label);
  }

  void label_rows(const TileIndex& index) {
    const Tile& tile = stock_.tile(index);
    LabelledRow above = last_row({index.column, index.row - 1});
    const LabelledRow beside = last_column({index.column - 1, index.row});
    DexelFinder left_tile(beside);
    LabelledRow present;
    LabelledRow before;  // The dexel to the left.
    LabelledRow dexel;
    for (int row = 0; row < tile.rows(); ++row) {
      present.clear();
      tile.for_each_interval(row, [&](int column, float bottom, float top) {
        present.push_back({column, bottom, top, kNoMark});
      });
      DexelFinder upper(above);
      std::span<const LabelledInterval> left = left_tile.at(row);
      int left_at = -1;
      for (std::size_t i = 0; i < present.size();) {
        std::size_t end = i;
        while (end < present.size() && present[end].at == present[i].at) ++end;
        const std::span<LabelledInterval> here = std::span(present).subspan(i, end - i);
        if (left_at == here.front().at - 1) join(here, left);
        join(here, upper.at(here.front().at));
        for (LabelledInterval& interval : here) {
          if (interval.label == kNoMark) interval.label = sets_.add();
          labels(index).push_back(interval.label);
        }
        left = here;
        left_at = here.front().at;
        i = end;
      }
      std::swap(above, present);
    }
  }

  /// Finds the intervals of each dexel of a row or column, asked for in order.
  class DexelFinder {
   public:
    explicit DexelFinder(std::span<const LabelledInterval> all) : all_(all) {
      is_uniform_ = all.size() == 1 && all.front().at < 0;
    }
    std::span<const LabelledInterval> at(int dexel) {
      if (is_uniform_) return all_;
      while (next_ < all_.size() && all_[next_].at < dexel) ++next_;
      std::size_t end = next_;
      while (end < all_.size() && all_[end].at == dexel) ++end;
      return all_.subspan(next_, end - next_);
    }

   private:
    std::span<const LabelledInterval> all_;
    std::size_t next_ = 0;
    bool is_uniform_;
  };

  /// Gives intervals the labels of those of a neighbor that they overlap.
  void join(std::span<LabelledInterval> here, std::span<const LabelledInterval> there) {
    std::size_t k = 0;
    for (LabelledInterval& interval : here) {
      while (k < there.size() && there[k].top <= interval.bottom) ++k;
      for (std::size_t i = k; i < there.size() && there[i].bottom < interval.top; ++i) {
        if (interval.label == kNoMark) interval.label = there[i].label;
        if (interval.label != there[i].label) sets_.join(interval.label, there[i].label);
      }
    }
  }

  /// Makes all labels indexes of pieces.
  std::vector<StockPiece> number_pieces() {
    std::vector<Mark> number(sets_.size(), kNoMark);
    std::vector<StockPiece> pieces;
    for (std::vector<Mark>& tile : tiles_)
      for (Mark& label : tile) {
        Mark& known = number[sets_.root(label)];
        if (known == kNoMark) {
          known = static_cast<Mark>(pieces.size());
          pieces.emplace_back().number = known;
        }
        label = known;
      }
    return pieces;
  }

  /// Who cut a dexel last; no value outside the grid.
  std::optional<CutTag> cut_by(int row, int column) const {
    if (row < 0 || row >= stock_.grid().rows || column < 0 || column >= stock_.grid().columns) return std::nullopt;
    return stock_.tile({column / Tile::kSize, row / Tile::kSize}).cut_by(row % Tile::kSize, column % Tile::kSize);
  }

  Stock stock_;
  int across_;  ///< Tiles in a row.
  /// Those of a tile's intervals in order; one for a uniform tile.
  std::vector<std::vector<Mark>> tiles_;
  LabelSets sets_;
};

std::vector<StockPiece> pieces_of(const Stock& stock) {
  const auto labels = std::make_shared<PieceLabels>(stock);
  std::vector<StockPiece> pieces = labels->measure();
  for (StockPiece& piece : pieces) piece.labels = labels;
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const StockPiece& left, const StockPiece& right) { return left.volume > right.volume; });
  return pieces;
}

void for_each_interval(const StockPiece& piece,
                       const std::function<void(int column, int row, const HeightInterval& z)>& use) {
  if (!piece.labels) return;
  piece.labels->for_each_interval(piece, [&](int row, int column, float bottom, float top) {
    use(column, row, HeightInterval{bottom, top});
  });
}

bool has_material_in(const StockPiece& piece, const BoundingBox& box) {
  return piece.labels && piece.labels->has_material_in(piece, box);
}

std::optional<CutTag> last_cut_beside(const StockPiece& piece) {
  return piece.labels ? piece.labels->last_cut_beside(piece) : std::nullopt;
}

}  // namespace isocnc::stock
