#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/command_line.h"
#include "analyzer/fixing/fixer.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/lint_counts.h"
#include "analyzer/lint_output.h"
#include "analyzer/selection/baseline.h"
#include "analyzer/selection/program_settings.h"
#include "interpreter/command_line/progress.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/system/exit_status.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/source_file.h"

namespace isocnc::analyzer {

/// The files to check, and the settings of each.
struct Programs {
  std::vector<std::filesystem::path> files;
  std::vector<std::reference_wrapper<const selection::ProgramSettings>> settings;
};

/// A program and its findings.
struct CheckedFile {
  std::string name;
  std::variant<system::SourceFile, system::SourceFile::Problem> opened;
  const selection::ProgramSettings& settings;
  check::Report report = {};
  std::size_t known = 0;         ///< The number of findings that the baseline knows.
  std::string certificate = {};  ///< What the machine has proven of it, in words; empty if it was not asked.
  std::optional<fixing::FixedText> fixed = {};
  std::optional<std::string> why_not_fixed = {};

  std::string_view original() const { return std::get<system::SourceFile>(opened).text(); }
  std::string_view text() const { return fixed ? fixed->text : original(); }
  LintCounts counts() const;
};

/// Checks files in parallel and shows the findings in the order of the files.
class LintRun {
 public:
  /// Gets each program with its number among the files; its findings are shown if it returns true.
  using Filter = std::function<bool(std::size_t index, const CheckedFile& checked)>;

  /// `baseline` may be null.
  LintRun(const LintCommandOptions& options, const formats::ReportStyle& style,
          std::unique_ptr<formats::Renderer> renderer, const selection::Baseline* baseline, Programs programs);

  /// `failed` tells that some programs could not be found.
  system::ExitStatus run(bool failed);
  /// Checks the programs for a watch, until its end is requested. Returns false, after an error message, if output has
  /// been lost.
  bool run_for_watch(Filter filter);

 private:
  bool show_all();
  void work();
  std::variant<system::SourceFile, system::SourceFile::Problem> open(const std::filesystem::path& path) const;
  CheckedFile check(const std::filesystem::path& path, const selection::ProgramSettings& settings);
  void fix(CheckedFile& checked) const;
  int jobs_for(std::string_view text) const;
  void verify(CheckedFile& checked, check::Report found, const selection::FindingFilter& filter);
  check::Report without_known(check::Report report, const std::string& name, std::string_view text) const;
  void show(const CheckedFile& checked);
  void show_difference(const CheckedFile& checked);

  const LintCommandOptions& options_;
  const formats::ReportStyle& style_;
  const selection::Baseline* const baseline_;  // Null: none.
  const std::vector<std::filesystem::path> files_;
  const std::vector<std::reference_wrapper<const selection::ProgramSettings>> settings_;
  std::unique_ptr<formats::Renderer> renderer_;
  const int jobs_;
  configuration::Scenes scenes_;
  Filter filter_;
  command_line::Progress progress_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::condition_variable turn_changed_;
  std::size_t turn_ = 0;  // Guarded by mutex_, like the members below.
  LintOutput output_;
  LintCounts counts_;
  std::string certificates_;                             // One line for each program.
  system::OutputFile program_{system::kStandardOutput};  // The output of --fix -.
  bool has_difference_ = false;
  bool failed_ = false;
};

}  // namespace isocnc::analyzer
