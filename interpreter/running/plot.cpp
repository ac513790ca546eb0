#include "interpreter/running/plot.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "interpreter/running/page_plot.h"
#include "interpreter/running/svg_plot.h"

namespace isocnc::running {

std::optional<PlotFormat> plot_format(std::string_view file_name) {
  const auto ends_with = [&](std::string_view ending) {
    return file_name.size() > ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), file_name.rbegin(), [](char wanted, char found) {
             return wanted == std::tolower(static_cast<unsigned char>(found));
           });
  };
  if (ends_with(".svg")) return PlotFormat::Svg;
  if (ends_with(".html") || ends_with(".htm")) return PlotFormat::Html;
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
