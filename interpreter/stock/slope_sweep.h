#pragma once

#include "interpreter/stock/dexel_sink.h"
#include "interpreter/stock/flat_line.h"
#include "interpreter/stock/upright_sweep.h"

namespace isocnc::stock {

/// Takes the dexels that a body with a vertical axis passes through on a straight line that rises or falls from
/// `from_z` to `to_z`.
void sweep_slope(const RevolvedColumn& column, const FlatLine& path, double from_z, double to_z, DexelSink& sink);

}  // namespace isocnc::stock
