#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/plot/plot.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/simulation/run_findings.h"
#include "interpreter/summary/summary.h"
#include "interpreter/system/output_file.h"
#include "interpreter/threads/crew.h"
#include "interpreter/timing/parallel_timing.h"
#include "interpreter/verification/verified_run.h"
#include "interpreter/verification/verifier_queue.h"

namespace isocnc::interpreter {

/// The outputs of a run with their destinations: file names, `-` for standard output, or empty for none.
struct RunOutputs {
  std::string trace;
  std::string samples;
  double sample_seconds = 0.01;
  std::string plot;
  plot::PlotSubject subject;  ///< Subject of the plot, and what surrounds the program.
  bool json = false;          ///< Whether the summary is JSON.
  std::string stock_out;      ///< What remains of the blank: `.stl` or `.stock`.
  verification::MaterialOptions material;
  std::string program_name;
  dialect::Language language = dialect::Language::English;
};

/// Receives the events of a run on a machine and writes the requested outputs.
class RunReport {
 public:
  RunReport(const RunOutputs& outputs, const timing::TimedMachine& machine);

  /// Whether all files could be created; otherwise problems() has the reasons.
  bool is_ready() const { return problems_.empty(); }
  void take(const running::Block& block) { findings_.take(block); }
  void take(const running::Event& event) {
    findings_.take(event);
    compensation_.take(event, compensated_);
  }
  /// Ends the run, and returns what it has shown. `text` is that of the program.
  verification::VerifiedRun end_run(std::string_view text, const running::RunResult& result);
  /// Writes the rest, after end_run(). problems() then lists the failed outputs. `shown_findings` are shown with the
  /// summary, in its format: text before it, or the JSON array that is its last member; empty for none.
  void finish(const running::RunResult& result, const verification::VerifiedRun& verified,
              const std::string& shown_findings);
  /// Whether the summary is written, and with it the findings.
  bool has_summary() const { return outputs_.trace != "-" && outputs_.samples != "-"; }
  const std::vector<std::string>& problems() const { return problems_; }

 private:
  timing::TimingListeners listeners();
  system::OutputFile* open(const std::string& name, std::optional<system::OutputFile>& file);
  void close(system::OutputFile& output, const std::string& name);
  void take(const timing::TimedEvent& timed);
  void take(const motion::Stretch& stretch, const timing::TimedEvent& timed);
  void sort_warnings();
  std::string summary(const verification::VerifiedRun& verified, const std::string& shown_findings) const;
  std::string stock_bytes(const verification::VerifiedRun& verified) const;
  void sample_rest(double until);
  void write(const motion::Sample& sample);

  const RunOutputs& outputs_;
  const timing::TimedMachine& machine_;
  std::vector<std::string> problems_;
  system::OutputFile standard_output_;
  std::optional<system::OutputFile> trace_file_;
  std::optional<system::OutputFile> samples_file_;
  system::OutputFile* trace_;
  system::OutputFile* samples_;
  summary::Summary summary_;
  std::optional<system::OutputFile> stock_file_;
  std::optional<system::OutputFile> plot_file_;
  std::optional<plot::Plot> plot_;
  std::optional<plot::StockRecording> cuts_;  ///< For a page.
  std::uint64_t next_sample_ = 0;             ///< In units of sample_seconds.
  motion::Sample last_sample_;
  timing::ParallelTiming timing_;
  simulation::RunFindings findings_;
  std::optional<verification::Verifier> verifier_;
  std::optional<verification::VerifierQueue> verified_;  ///< Leads to the verifier.
  std::vector<simulation::RunWarning> warnings_;
  simulation::Compensation compensation_;
  simulation::Compensation::Listeners compensated_;
  std::optional<threads::Crew> crew_;  ///< The last member, since its threads use the others.
};

}  // namespace isocnc::interpreter
