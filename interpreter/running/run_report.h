#pragma once

#include <optional>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/compensation.h"
#include "interpreter/running/output_file.h"
#include "interpreter/running/plot.h"
#include "interpreter/running/summary.h"

namespace isocnc::running {

/// What is written of a run, and where: names of files, `-` for standard output, or nothing.
struct RunOutputs {
  std::string trace;
  std::string samples;
  double sample_seconds = 0.01;
  std::string plot;
  PlotSubject subject;  ///< Of the plot.
  bool json = false;    ///< The summary.
  std::string program_name;
  dialect::Language language = dialect::Language::English;
};

/// Listens to a run on a machine, and writes what is wanted of it.
class RunReport {
 public:
  RunReport(const RunOutputs& outputs, const TimedMachine& machine);

  /// Whether all files could be made; problems() tells else.
  bool is_ready() const { return problems_.empty(); }
  void take(const Event& event) { compensation_.take(event, compensated_); }
  /// Writes the rest. Whatever could not be written stands in problems().
  void finish(const RunResult& result);
  const std::vector<std::string>& problems() const { return problems_; }
  /// By line, each once; complete when all is finished.
  const std::vector<RunWarning>& warnings() const { return warnings_; }

 private:
  bool has_standard_output_to_itself() const { return outputs_.trace == "-" || outputs_.samples == "-"; }
  OutputFile* open(const std::string& name, std::optional<OutputFile>& file);
  void close(OutputFile& output, const std::string& name);
  void take(const TimedEvent& timed);
  void take(const motion::Stretch& stretch);
  void sort_warnings();
  void sample_rest(double until);
  void write(const motion::Sample& sample);

  const RunOutputs& outputs_;
  const TimedMachine& machine_;
  std::vector<std::string> problems_;
  OutputFile standard_output_;
  std::optional<OutputFile> trace_file_;
  std::optional<OutputFile> samples_file_;
  OutputFile* trace_;
  OutputFile* samples_;
  Summary summary_;
  std::optional<OutputFile> plot_file_;
  std::optional<Plot> plot_;
  std::uint64_t next_sample_ = 0;  ///< In units of sample_seconds.
  motion::Sample last_sample_;
  Timing timing_;
  std::vector<RunWarning> warnings_;
  Compensation compensation_;
  Compensation::Listeners compensated_;
};

}  // namespace isocnc::running
