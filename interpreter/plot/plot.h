#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/plot/picture.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/running/runner.h"
#include "interpreter/system/output_file.h"

namespace isocnc::plot {

enum class PlotFormat : std::uint8_t { Svg, Html };

/// The format for a file name by its extension: .svg, .html or .htm, upper case too.
std::optional<PlotFormat> plot_format(std::string_view file_name);

/// Receives the events of a run and draws the path of the tool tip.
class Plot {
 public:
  Plot(PlotFormat format, const PlotSubject& subject, const timing::TimedMachine& machine);

  void add(const motion::Stretch& stretch) { path_.add(stretch); }
  void add(const timing::TimedEvent& timed) { path_.add(timed); }
  void write(system::OutputFile& output, const PlottedRun& run) { picture_->write(output, path_, run); }

 private:
  std::unique_ptr<Picture> picture_;
  Toolpath path_;
};

}  // namespace isocnc::plot
