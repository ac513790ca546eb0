#pragma once

#include <vector>

#include "interpreter/removal/workpiece.h"
#include "interpreter/stock/pieces.h"

namespace isocnc::removal {

/// The pieces that have come free of the workpiece and that nothing holds: neither do they touch what holds it, nor lie
/// on its board. Chips are none, nor is anything where the description of what holds does not even hold the largest
/// piece.
std::vector<stock::StockPiece> loose_pieces(const stock::Stock& stock, const Workpiece& workpiece);

}  // namespace isocnc::removal
