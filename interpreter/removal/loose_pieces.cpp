#include "interpreter/removal/loose_pieces.h"

#include <algorithm>

namespace isocnc::removal {

using stock::StockPiece;

/// What is nearer touches: the dexels know a wall to within their spacing.
static constexpr double kTouch = 1;  // mm
/// Smaller pieces go away with the chips.
static constexpr double kMinVolume = 100;  // mm^3
static constexpr double kMinWidth = 2;     // mm

static bool touches(const StockPiece& piece, const stock::Stock& stock, const solids::BoundingBox& box) {
  const solids::BoundingBox near(box.min().array() - kTouch - stock.spacing(),
                                 box.max().array() + kTouch + stock.spacing());
  return has_material_in(piece, near);
}

/// Whether a piece goes on outside the window, where nobody knows what holds it.
static bool goes_on(const StockPiece& piece, const stock::Stock& stock, const Workpiece& workpiece) {
  if (!workpiece.window) return false;
  const solids::BoundingBox blank = stock::bounds_of(workpiece.blank);
  const double cell = stock.spacing() / 2;
  for (int axis = 0; axis < 2; ++axis) {
    const double first = stock.bounds().min()[axis];
    const double last = stock.bounds().max()[axis];
    if (first > blank.min()[axis] && piece.bounds.min()[axis] < first + cell) return true;
    if (last < blank.max()[axis] && piece.bounds.max()[axis] > last - cell) return true;
  }
  return false;
}

static bool is_held(const StockPiece& piece, const stock::Stock& stock, const Workpiece& workpiece) {
  if (goes_on(piece, stock, workpiece)) return true;
  if (workpiece.board_top && piece.bounds.min().z() <= *workpiece.board_top + kTouch) return true;
  return std::any_of(workpiece.holding.begin(), workpiece.holding.end(),
                     [&](const solids::BoundingBox& box) { return touches(piece, stock, box); });
}

std::vector<StockPiece> loose_pieces(const stock::Stock& stock, const Workpiece& workpiece) {
  if (workpiece.holding.empty() && !workpiece.board_top) return {};
  std::vector<StockPiece> pieces = stock::pieces_of(stock);
  if (pieces.empty() || (pieces.size() < 2 && !workpiece.window)) return {};
  if (!is_held(pieces.front(), stock, workpiece)) return {};
  std::erase_if(pieces, [&](const StockPiece& piece) {
    const Eigen::Vector3d sizes = piece.bounds.sizes();
    return piece.volume < kMinVolume || sizes.head<2>().minCoeff() < kMinWidth || is_held(piece, stock, workpiece);
  });
  return pieces;
}

}  // namespace isocnc::removal
