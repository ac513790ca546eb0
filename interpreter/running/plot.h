#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/output_file.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/toolpath.h"

namespace isocnc::running {

/// A tool as the machine's file describes it; mm.
struct PlotTool {
  execution::ToolCode code;
  std::string name;
  std::optional<double> length;
  std::optional<double> radius;
};

/// What a plot shows besides the path.
struct PlotSubject {
  std::string name;          ///< Of the program; may hold anything.
  std::string_view program;  ///< Its text.
  geometry::Pose home;       ///< Where the machine starts.
  std::vector<PlotTool> tools;
  std::string_view page;  ///< What a PlotFormat::Html is made of: kPageTemplate.
  dialect::Language language = dialect::Language::English;
};

/// One way to draw a path.
class Picture {
 public:
  virtual ~Picture() = default;
  virtual void add(const ToolpathStep& step) = 0;
  /// All of it, once the run is over.
  virtual void write(OutputFile& output, const Toolpath& path, const RunResult& result) = 0;
};

enum class PlotFormat : std::uint8_t { Svg, Html };

/// By how the name of a file ends: .svg, .html or .htm, in capitals, too.
std::optional<PlotFormat> plot_format(std::string_view file_name);

/// Listens to a run and draws the way of the tool tip.
class Plot {
 public:
  Plot(PlotFormat format, const PlotSubject& subject, const TimedMachine& machine);

  void add(const motion::Stretch& stretch) { path_.add(stretch); }
  void add(const TimedEvent& timed) { path_.add(timed); }
  void write(OutputFile& output, const RunResult& result) { picture_->write(output, path_, result); }

 private:
  std::unique_ptr<Picture> picture_;
  Toolpath path_;
};

/// `T102003`, and what the machine's file calls it: `T102003 fresa D20`.
std::string shown_tool(const execution::ToolCode& tool, const std::vector<PlotTool>& known);

}  // namespace isocnc::running
