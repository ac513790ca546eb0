#pragma once

#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/plot/picture.h"

namespace isocnc::plot {

/// The machine's tools, as a picture names and draws them.
std::vector<PlotTool> plot_tools(const configuration::MachineConfiguration& machine);

}  // namespace isocnc::plot
