#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/plot/stock_recording.h"
#include "interpreter/plot/toolpath.h"
#include "interpreter/running/runner.h"
#include "interpreter/system/output_file.h"
#include "interpreter/verification/verified_run.h"

namespace isocnc::plot {

/// A tool as described in the machine file; mm.
struct PlotTool {
  execution::ToolCode code;
  std::string name;
  std::optional<double> length;
  std::optional<double> radius;
};

/// The data that a plot shows besides the path.
struct PlotSubject {
  std::string name;          ///< Name of the program; may contain any characters.
  std::string_view program;  ///< Its text.
  geometry::Pose home;       ///< Position of the machine at the start.
  std::vector<PlotTool> tools;
  std::string_view page;  ///< Template for PlotFormat::Html: kPageTemplate.
  dialect::Language language = dialect::Language::English;
  std::shared_ptr<const verification::Scene> scene;  ///< What surrounds the program; null if nothing is known of it.
  geometry::Vec3 origin = geometry::Vec3::Zero();    ///< Of the first workpiece frame, machine frame, mm.
};

/// How a run has ended, and what it has shown.
struct PlottedRun {
  const running::RunResult& result;
  const verification::VerifiedRun& verified;
  StockRecording* cuts = nullptr;  ///< How the stock was cut; null if there is none.
};

/// A drawing of a path in one format.
class Picture {
 public:
  virtual ~Picture() = default;
  virtual void add(const ToolpathStep& step) = 0;
  /// Writes the whole picture after the end of the run.
  virtual void write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) = 0;
};

/// The tool with its name in the machine file: `T102003 fresa D20`; without a name `T102003`.
std::string shown_tool(const execution::ToolCode& tool, const std::vector<PlotTool>& known);

}  // namespace isocnc::plot
