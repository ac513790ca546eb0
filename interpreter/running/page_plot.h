#pragma once

#include "interpreter/running/path_recording.h"

namespace isocnc::running {

/// The path in three dimensions, as a page that needs no network: the page's template with the run's data in it.
class PagePlot final : public Picture {
 public:
  /// Both must outlive it.
  PagePlot(const PlotSubject& subject, const TimedMachine& machine) : subject_(subject), recording_(subject, machine) {}

  void add(const ToolpathStep& step) override { recording_.add(step); }
  void write(OutputFile& output, const Toolpath& path, const RunResult& result) override;

 private:
  const PlotSubject& subject_;
  PathRecording recording_;
};

}  // namespace isocnc::running
