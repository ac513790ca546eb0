#include "interpreter/configuration/plot_tools.h"

namespace isocnc::configuration {

std::vector<running::PlotTool> plot_tools(const Machine& machine) {
  std::vector<running::PlotTool> tools;
  if (machine.tools)
    for (const Tool& tool : *machine.tools) tools.push_back({tool.code, tool.name, tool.length, tool.radius});
  return tools;
}

}  // namespace isocnc::configuration
