#pragma once

#include "interpreter/plot/path_recording.h"

namespace isocnc::plot {

/// The path in three dimensions, as a page that needs no network: the page's template with the run's data in it.
class PagePlot final : public Picture {
 public:
  /// Both must outlive it.
  PagePlot(const PlotSubject& subject, const simulation::TimedMachine& machine)
      : subject_(subject), recording_(subject, machine) {}

  void add(const ToolpathStep& step) override { recording_.add(step); }
  void write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) override;

 private:
  const PlotSubject& subject_;
  PathRecording recording_;
};

}  // namespace isocnc::plot
