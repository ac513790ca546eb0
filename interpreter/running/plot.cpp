#include "interpreter/running/plot.h"

#include <algorithm>

#include "interpreter/dialect/any_case.h"
#include "interpreter/running/page_plot.h"
#include "interpreter/running/svg_plot.h"

namespace isocnc::running {

std::optional<PlotFormat> plot_format(std::string_view file_name) {
  const auto has_extension = [&](std::string_view extension) {
    return file_name.size() > extension.size() && dialect::ends_with(file_name, extension);
  };
  if (has_extension(".svg")) return PlotFormat::Svg;
  if (has_extension(".html") || has_extension(".htm")) return PlotFormat::Html;
  return std::nullopt;
}

static std::unique_ptr<Picture> picture(PlotFormat format, const PlotSubject& subject, const TimedMachine& machine) {
  if (format == PlotFormat::Html) return std::make_unique<PagePlot>(subject, machine);
  return std::make_unique<SvgPlot>(subject);
}

Plot::Plot(PlotFormat format, const PlotSubject& subject, const TimedMachine& machine)
    : picture_(picture(format, subject, machine)),
      path_(machine, subject.home, [this](const ToolpathStep& step) { picture_->add(step); }) {}

std::string shown_tool(const execution::ToolCode& tool, const std::vector<PlotTool>& known) {
  const std::string code = tool_name(tool);
  const auto described =
      std::find_if(known.begin(), known.end(), [&](const PlotTool& each) { return each.code == tool; });
  return described == known.end() || described->name.empty() ? code : code + ' ' + described->name;
}

}  // namespace isocnc::running
