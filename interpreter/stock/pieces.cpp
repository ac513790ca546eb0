#include "interpreter/stock/pieces.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

namespace isocnc::stock {

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
    std::vector<std::pair<int, int>> last_dexel(pieces.size(), {-1, -1});
    const DexelGrid& grid = stock_.grid();
    const auto add = [&](StockPiece& piece, int row, int column, int rows, int columns, float bottom, float top) {
      piece.volume += static_cast<double>(top - bottom) * grid.cell() * rows * columns;
      const geometry::Vec2 half = grid.spacing / 2;
      piece.bounds.extend(geometry::Vec3(grid.x(column) - half.x(), grid.y(row) - half.y(), bottom));
      piece.bounds.extend(
          geometry::Vec3(grid.x(column + columns - 1) + half.x(), grid.y(row + rows - 1) + half.y(), top));
      auto& last = last_dexel[piece.number];
      if (last != std::pair(row, column))
        piece.dexels += static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
      last = {row, column};
    };
    for_each_tile([&](const TileIndex& index) {
      const Tile& tile = stock_.tile(index);
      const int row = index.row * Tile::kSize;
      const int column = index.column * Tile::kSize;
      if (tile.is_uniform()) {
        if (tile.is_empty()) return;
        StockPiece& piece = pieces[labels(index).front()];
        add(piece, row, column, tile.rows(), tile.columns(), tile.floor(), tile.ceiling());
        note_cuts_around(index, piece);
        return;
      }
      std::size_t next = 0;
      for (int i = 0; i < tile.rows(); ++i)
        tile.for_each_interval(i, [&](int k, float bottom, float top) {
          StockPiece& piece = pieces[labels(index)[next++]];
          add(piece, row + i, column + k, 1, 1, bottom, top);
          note_cut(row + i, column + k, piece);
          note_cut(row + i, column + k - 1, piece);
          note_cut(row + i, column + k + 1, piece);
          note_cut(row + i - 1, column + k, piece);
          note_cut(row + i + 1, column + k, piece);
        });
    });
    return pieces;
  }

  /// After measure().
  void for_each_interval(const StockPiece& piece,
                         const std::function<void(int column, int row, const HeightInterval& z)>& use) const {
    const DexelGrid& grid = stock_.grid();
    const auto first_column = grid.first_column(piece.bounds.min().x()) / Tile::kSize;
    const auto first_row = grid.first_row(piece.bounds.min().y()) / Tile::kSize;
    const auto last_column = (grid.first_column(piece.bounds.max().x()) - 1) / Tile::kSize;
    const auto last_row = (grid.first_row(piece.bounds.max().y()) - 1) / Tile::kSize;
    for (int tile_row = first_row; tile_row <= last_row; ++tile_row)
      for (int tile_column = first_column; tile_column <= last_column; ++tile_column) {
        const TileIndex index{tile_column, tile_row};
        const Tile& tile = stock_.tile(index);
        std::size_t next = 0;
        for (int row = 0; row < tile.rows(); ++row)
          tile.for_each_interval(row, [&](int column, float bottom, float top) {
            const Mark label = labels(index)[tile.is_uniform() ? 0 : next++];
            if (label == piece.number)
              use(tile_column * Tile::kSize + column, tile_row * Tile::kSize + row, HeightInterval{bottom, top});
          });
      }
  }

 private:
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
        sets_.join(interval.label, there[i].label);
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

  void note_cut(int row, int column, StockPiece& piece) const {
    if (row < 0 || row >= stock_.grid().rows || column < 0 || column >= stock_.grid().columns) return;
    const auto tag =
        stock_.tile({column / Tile::kSize, row / Tile::kSize}).cut_by(row % Tile::kSize, column % Tile::kSize);
    if (tag && (!piece.last_cut || *tag > *piece.last_cut)) piece.last_cut = tag;
  }
  /// The dexels around a uniform tile, which itself has no cut.
  void note_cuts_around(const TileIndex& index, StockPiece& piece) const {
    const Tile& tile = stock_.tile(index);
    const int row = index.row * Tile::kSize;
    const int column = index.column * Tile::kSize;
    for (int i = 0; i < tile.rows(); ++i) {
      note_cut(row + i, column - 1, piece);
      note_cut(row + i, column + tile.columns(), piece);
    }
    for (int i = 0; i < tile.columns(); ++i) {
      note_cut(row - 1, column + i, piece);
      note_cut(row + tile.rows(), column + i, piece);
    }
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
  if (piece.labels) piece.labels->for_each_interval(piece, use);
}

}  // namespace isocnc::stock
