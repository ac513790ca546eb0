#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/running/runner.h"
#include "interpreter/system/output_file.h"

namespace isocnc::plot {

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
  virtual void write(system::OutputFile& output, const Toolpath& path, const running::RunResult& result) = 0;
};

/// `T102003`, and what the machine's file calls it: `T102003 fresa D20`.
std::string shown_tool(const execution::ToolCode& tool, const std::vector<PlotTool>& known);

}  // namespace isocnc::plot
