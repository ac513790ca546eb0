#include "interpreter/plot/plot.h"

#include <algorithm>

#include "interpreter/dialect/any_case.h"
#include "interpreter/plot/page_plot.h"
#include "interpreter/plot/svg_plot.h"

namespace isocnc::plot {

std::optional<PlotFormat> plot_format(std::string_view file_name) {
  const auto has_extension = [&](std::string_view extension) {
    return file_name.size() > extension.size() && dialect::ends_with(file_name, extension);
  };
  if (has_extension(".svg")) return PlotFormat::Svg;
  if (has_extension(".html") || has_extension(".htm")) return PlotFormat::Html;
  return std::nullopt;
}

static std::unique_ptr<Picture> picture(PlotFormat format, const PlotSubject& subject,
                                        const timing::TimedMachine& machine) {
  if (format == PlotFormat::Html) return std::make_unique<PagePlot>(subject, machine);
  return std::make_unique<SvgPlot>(subject);
}

Plot::Plot(PlotFormat format, const PlotSubject& subject, const timing::TimedMachine& machine)
    : picture_(picture(format, subject, machine)),
      path_(machine, subject.home, [this](const ToolpathStep& step) { picture_->add(step); }) {}

}  // namespace isocnc::plot
