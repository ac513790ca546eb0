#pragma once

#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/running/plot.h"

namespace isocnc::configuration {

/// The machine's tools, as a picture names and draws them.
std::vector<running::PlotTool> plot_tools(const Machine& machine);

}  // namespace isocnc::configuration
