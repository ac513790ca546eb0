#include "analyzer/watch.h"

#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "analyzer/input/files.h"
#include "analyzer/input/program_changes.h"
#include "analyzer/input/settling.h"
#include "analyzer/lint_counts.h"
#include "analyzer/lint_output.h"
#include "analyzer/lint_run.h"
#include "analyzer/selection/baseline.h"
#include "analyzer/selection/program_settings.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/process.h"

namespace isocnc::analyzer {

using system::ExitStatus;
using system::SourceFile;

namespace {

/// Checks programs, and again those that others write, until the end is requested.
class Watch {
 public:
  Watch(const LintCommandOptions& options, const formats::ReportStyle& style) : options_(options), style_(style) {}

  ExitStatus run() {
    if (!system::take_end_request()) {
      static constexpr dialect::Text kNotHere = {"--watch is not possible here", "--watch qui non è possibile"};
      complain(kNotHere.in(style_.language));
      return ExitStatus::Failure;
    }
    std::chrono::milliseconds rest{0};
    while (!system::sleep_until_end_request(rest)) {
      const auto start = Clock::now();
      checking_ = {};
      if (!pass(start)) return ExitStatus::Failure;
      rest = input::rest_after(Clock::now() - start - checking_, is_unsettled());
    }
    if (!complaints_.is_settled_as({}) || !unreadable_.empty()) return ExitStatus::Failure;
    return status_of(total(), options_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// What stands in the way of a check.
  struct Complaints {
    std::vector<std::string> mistakes;  ///< In configurations and in the baseline: no program is checked.
    std::vector<std::string> problems;  ///< Paths that could not be searched.

    friend bool operator==(const Complaints&, const Complaints&) = default;
  };

  /// A look at all programs. Returns false if output has been lost.
  bool pass(Clock::time_point now) {
    Complaints complaints;
    read_baseline(complaints);
    configuration::Configurations configurations(options_.source, style_.language);
    selection::SettingsFinder settings(configurations, options_.selection);
    input::FileSelection found = input::select_programs(options_.paths, configurations, style_.language);
    if (!found.is_refused) complaints.problems = std::move(found.problems);  // A folder may be empty for now.
    input::ProgramChanges::Stamps stamps;
    Programs programs;
    for (const std::filesystem::path& file : found.files) {
      const std::optional<input::FileStamp> stamp = input::stamp_of(file);
      if (!stamp) continue;
      const std::filesystem::path& configuration = configurations.of(file).file;
      stamps[file] = {.program = *stamp,
                      .configuration = system::generic_name(configuration),
                      .configuration_content = input::stamp_of(configuration),
                      .baseline = baseline_stamp_};
      programs.files.push_back(file);
      programs.settings.emplace_back(settings.of(file));
    }
    changes_.see(stamps, now);
    for (std::string& mistake : configurations.mistakes(style_.language))
      complaints.mistakes.push_back(std::move(mistake));
    is_blocked_ = !complaints.mistakes.empty();
    complaints_.see(std::move(complaints), now);
    if (const auto settled = complaints_.take(now)) print(*settled);
    return is_blocked_ || check(changes_.take(now), stamps, programs);
  }

  bool is_unsettled() const { return complaints_.is_unsettled() || (!is_blocked_ && changes_.is_unsettled()); }

  void read_baseline(Complaints& complaints) {
    if (options_.baseline.empty()) return;
    const std::optional<input::FileStamp> stamp = input::stamp_of(options_.baseline);
    if (!baseline_ || stamp != baseline_stamp_) {
      baseline_ = selection::Baseline::read(options_.baseline, style_.language);
      baseline_stamp_ = stamp;
    }
    if (const auto* mistake = std::get_if<std::string>(&*baseline_))
      complaints.mistakes.push_back("isolint: " + *mistake);
  }

  static void print(const Complaints& complaints) {
    for (const std::string& mistake : complaints.mistakes) std::cerr << mistake << '\n';
    for (const std::string& problem : complaints.problems) complain(problem);
  }

  bool check(const input::ProgramChanges::Settled& settled, const input::ProgramChanges::Stamps& stamps,
             const Programs& programs) {
    static constexpr dialect::Text kRemoved = {"removed", "rimosso"};
    const auto start = Clock::now();
    if (settled.to_check.empty() && settled.removed.empty()) {
      if (!is_summarized_ && !is_unsettled()) summarize();
      return true;
    }
    bool is_new = !is_summarized_;  // Whether there is anything to summarize.
    for (const std::filesystem::path& removed : settled.removed) {
      if (!forget(removed)) continue;
      notes_.push_back(fmt::format("{}: {}", system::generic_name(removed), kRemoved.in(style_.language)));
      is_new = true;
    }
    Programs batch;
    for (std::size_t i = 0; i < programs.files.size(); ++i) {
      if (!settled.to_check.contains(programs.files[i])) continue;
      batch.files.push_back(programs.files[i]);
      batch.settings.push_back(programs.settings[i]);
    }
    const std::vector<std::filesystem::path> files = batch.files;
    const bool is_written = LintRun(options_, style_, formats::make_renderer(options_.format, style_),
                                    baseline_ ? &std::get<selection::Baseline>(*baseline_) : nullptr, std::move(batch))
                                .run_for_watch([&](std::size_t index, const CheckedFile& checked) {
                                  const bool is_shown = take(files[index], stamps.at(files[index]), checked);
                                  is_new |= is_shown;
                                  return is_shown;
                                });
    if (is_written && is_new && !system::is_end_requested()) summarize();
    checking_ = Clock::now() - start;
    return is_written;
  }

  /// Whether the findings are shown: those of a file that others have changed meanwhile, or still use, are not.
  bool take(const std::filesystem::path& file, const input::ProgramStamp& stamp, const CheckedFile& checked) {
    static constexpr int kTries = 10;  // Some seconds.
    static constexpr dialect::Text kNothing = {"no findings", "nessuna segnalazione"};
    if (input::stamp_of(file) != stamp.program) {
      changes_.repeat(file, Clock::now());
      return false;
    }
    if (const auto* problem = std::get_if<SourceFile::Problem>(&checked.opened)) {
      if (problem->is_in_use) changes_.repeat(file, Clock::now());
      if (problem->is_in_use && ++tries_[file] != kTries) return false;
      counts_.erase(file);
      unreadable_.insert(file);
      return true;
    }
    forget(file);
    counts_[file] = checked.counts();
    if (checked.report.findings.empty())
      notes_.push_back(fmt::format("{}: {}", checked.name, kNothing.in(style_.language)));
    return true;
  }

  /// Returns whether anything has been reported of the program.
  bool forget(const std::filesystem::path& file) {
    tries_.erase(file);
    return counts_.erase(file) + unreadable_.erase(file) > 0;
  }

  LintCounts total() const {
    LintCounts total;
    for (const auto& [file, counts] : counts_) total += counts;
    return total;
  }

  /// Names what has changed and has no findings, unless it is too much to be read.
  void summarize() {
    static constexpr dialect::Text kWatching = {"watching", "in attesa di modifiche"};
    static constexpr std::size_t kMaxNotes = 10;
    if (is_summarized_ && notes_.size() <= kMaxNotes)
      for (const std::string& note : notes_) complain(note);
    notes_.clear();
    is_summarized_ = true;
    std::cerr << fmt::format("{}; {}\n", summary_of(total(), options_), kWatching.in(style_.language));
  }

  const LintCommandOptions& options_;
  const formats::ReportStyle& style_;
  input::ProgramChanges changes_;
  input::Settling<Complaints> complaints_{Complaints()};
  std::optional<std::variant<selection::Baseline, std::string>> baseline_;  // Or the mistake in it.
  std::optional<input::FileStamp> baseline_stamp_;
  bool is_blocked_ = false;  // By mistakes.
  std::map<std::filesystem::path, LintCounts> counts_;
  std::set<std::filesystem::path> unreadable_;  // What has been complained of.
  std::map<std::filesystem::path, int> tries_;  // How often a file was in use by another program.
  std::vector<std::string> notes_;
  bool is_summarized_ = false;
  std::chrono::nanoseconds checking_{0};  // Of the last pass.
};

}  // namespace

ExitStatus watch(const LintCommandOptions& options, const formats::ReportStyle& style) {
  return Watch(options, style).run();
}

}  // namespace isocnc::analyzer
