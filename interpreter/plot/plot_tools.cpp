#include "interpreter/plot/plot_tools.h"

namespace isocnc::plot {

std::vector<PlotTool> plot_tools(const configuration::MachineConfiguration& machine) {
  std::vector<PlotTool> tools;
  if (machine.tools)
    for (const configuration::Tool& tool : *machine.tools)
      tools.push_back({tool.code, tool.name, tool.length, tool.radius});
  return tools;
}

}  // namespace isocnc::plot
