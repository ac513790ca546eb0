#include "interpreter/plot/picture.h"

#include <algorithm>

namespace isocnc::plot {

std::string shown_tool(const execution::ToolCode& tool, const std::vector<PlotTool>& known) {
  const std::string code = running::tool_name(tool);
  const auto described =
      std::find_if(known.begin(), known.end(), [&](const PlotTool& each) { return each.code == tool; });
  return described == known.end() || described->name.empty() ? code : code + ' ' + described->name;
}

}  // namespace isocnc::plot
