#pragma once

#include <string_view>

#include "interpreter/plot/path_recording.h"

namespace isocnc::plot {

/// A page that is written from its template, with blocks of data in it, as toolpath-view/README.md describes them.
class PageFile {
 public:
  /// `page`, the template, and the output must outlive this object.
  PageFile(system::OutputFile& output, std::string_view page, std::string_view title);

  void add_json(std::string_view id, std::string_view json);
  void add_bytes(std::string_view id, std::string_view bytes);
  /// Writes the rest of the template.
  void finish();

 private:
  void add(std::string_view id, std::string_view type, std::string_view content);

  system::OutputFile& output_;
  std::string_view rest_;
};

/// The path in three dimensions, as a page that needs no network: the page's template with the run's data in it.
class PagePlot final : public Picture {
 public:
  /// Both must outlive it.
  PagePlot(const PlotSubject& subject, const timing::TimedMachine& machine)
      : subject_(subject), recording_(subject, machine) {}

  void add(const ToolpathStep& step) override { recording_.add(step); }
  void write(system::OutputFile& output, const Toolpath& path, const PlottedRun& run) override;

 private:
  const PlotSubject& subject_;
  PathRecording recording_;
};

}  // namespace isocnc::plot
