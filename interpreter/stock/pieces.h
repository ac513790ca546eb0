#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "interpreter/stock/stock.h"

namespace isocnc::stock {

class PieceLabels;

/// A part of the material that hangs together. Dexels side by side, in a row or a column, do so where their intervals
/// overlap.
struct StockPiece {
  double volume = 0;           ///< mm^3
  solids::BoundingBox bounds;  ///< Of its dexels with their cells.

  std::size_t number = 0;  ///< Its index among all of the stock.
  std::shared_ptr<const PieceLabels> labels;
};

/// All pieces of a stock, the largest first; of equal ones, the first in the order of the tiles. Takes time and memory
/// for the tiles with cuts, 4 bytes for each interval in them; a tile without cuts is one step.
std::vector<StockPiece> pieces_of(const Stock& stock);

/// Calls `use` with all intervals of a piece: column and row in the whole grid.
void for_each_interval(const StockPiece& piece,
                       const std::function<void(int column, int row, const HeightInterval& z)>& use);

/// Whether a dexel whose line goes through the box has material of the piece between its bottom and top. Looks at the
/// tiles of the box alone.
bool has_material_in(const StockPiece& piece, const solids::BoundingBox& box);

/// The greatest tag of the dexels of a piece and of those beside them: the last sweep that may have cut it off.
std::optional<CutTag> last_cut_beside(const StockPiece& piece);

}  // namespace isocnc::stock
