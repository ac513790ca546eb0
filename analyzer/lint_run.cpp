#include "analyzer/lint_run.h"

#include <algorithm>
#include <iostream>
#include <utility>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/fixing/program_fixing.h"
#include "analyzer/input/files.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/verified.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/process.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/text/unicode.h"
#include "interpreter/threads/side_by_side.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::analyzer {

using system::ExitStatus;
using system::SourceFile;

/// A program of this size gets all threads.
static constexpr std::size_t kLargeFile = 8 * 1024 * 1024;

LintCounts CheckedFile::counts() const {
  LintCounts counts = {.files = 1, .known = known, .fixed = fixed ? fixed->fixed : 0};
  counts.add(report);
  return counts;
}

LintRun::LintRun(const LintCommandOptions& options, const formats::ReportStyle& style,
                 std::unique_ptr<formats::Renderer> renderer, const selection::Baseline* baseline, Programs programs)
    : options_(options),
      style_(style),
      baseline_(baseline),
      files_(std::move(programs.files)),
      settings_(std::move(programs.settings)),
      renderer_(std::move(renderer)),
      jobs_(options.jobs > 0 ? options.jobs : system::processor_count()),
      scenes_(style.language),
      progress_(command_line::terminal_writer(), input::bytes_of(files_)),
      output_(options) {}

ExitStatus LintRun::run(bool failed) {
  failed_ = failed;
  if (!show_all()) return ExitStatus::Failure;
  if (options_.format == "text") {
    std::cerr << summary_of(counts_, options_) << '\n';
  } else if (options_.fix) {
    std::cerr << fixed_in_words(counts_.fixed, options_) << '\n';
  }
  if (failed_) return ExitStatus::Failure;
  const ExitStatus status = status_of(counts_, options_);
  return has_difference_ && !options_.exit_zero ? ExitStatus::Findings : status;
}

bool LintRun::run_for_watch(Filter filter) {
  filter_ = std::move(filter);
  return show_all();
}

bool LintRun::show_all() {
  if (output_.has_failed()) {
    output_.finish();
    return false;
  }
  renderer_->begin(output_.buffer());
  const auto workers = std::min<std::size_t>(static_cast<std::size_t>(jobs_), files_.size());
  threads::side_by_side(static_cast<int>(workers), [this] { work(); });
  progress_.clear();
  for (const std::string& mistake : scenes_.mistakes(style_.language)) {
    std::cerr << mistake << '\n';
    failed_ = true;
  }
  renderer_->end(output_.buffer());
  if (!output_.finish()) return false;
  std::cerr << std::exchange(certificates_, {});
  if (program_.flush() == 0) return true;
  complain(fmt::format("<stdout>: {}", system::cannot_write(program_.error(), style_.language)));
  return false;
}

void LintRun::work() {
  for (std::size_t index = next_++; index < files_.size(); index = next_++) {
    std::optional<CheckedFile> checked;  // Once the end is requested, programs have their turn and nothing else.
    if (!system::is_end_requested()) checked.emplace(check(files_[index], settings_[index]));
    std::unique_lock lock(mutex_);
    turn_changed_.wait(lock, [&] { return turn_ == index; });
    if (checked && (!filter_ || filter_(index, *checked))) show(*checked);
    ++turn_;
    turn_changed_.notify_all();
  }
}

std::variant<SourceFile, SourceFile::Problem> LintRun::open(const std::filesystem::path& path) const {
  if (path == "-") return SourceFile::read_stream(system::kStandardInput, style_.language);
  // A mapped file could neither be cut short while a watch checks it nor, on Windows, be written.
  return options_.watch ? SourceFile::open_unmapped(path, style_.language) : SourceFile::open(path, style_.language);
}

CheckedFile LintRun::check(const std::filesystem::path& path, const selection::ProgramSettings& settings) {
  const bool from_stdin = path == "-";
  std::optional<fixing::FileFixing> fixing;
  if (options_.fix && !options_.diff && !from_stdin) fixing.emplace(path);  // Before the file is read.
  CheckedFile checked{system::generic_name(from_stdin ? std::filesystem::path(options_.stdin_name) : path), open(path),
                      settings};
  const auto* const source = std::get_if<SourceFile>(&checked.opened);
  if (!source) return checked;
  if (options_.fix || options_.diff) {
    fix(checked);
    if (fixing) checked.why_not_fixed = fixing->finish(*source, *checked.fixed, style_.language);
    if (checked.why_not_fixed) checked.fixed.reset();
    if (checked.fixed && !options_.verify) {
      checked.known = checked.fixed->filtered_out;
      return checked;
    }
  }
  const std::string_view text = checked.text();
  std::size_t progress_bytes = 0;
  const auto advance_to = [&](std::size_t bytes) { progress_.add(bytes - std::exchange(progress_bytes, bytes)); };
  const auto filter = [&](check::Report report, std::string_view) {
    const std::size_t all = check::folded_size(report);
    report = without_known(std::move(report), checked.name, text);
    checked.known += all - check::folded_size(report);
    return report;
  };
  check::Report found = check::check_text(text, settings.setup, jobs_for(text), advance_to);
  if (!options_.verify) {
    checked.report = selection::shown_report(std::move(found), text, settings.selection, filter);
    return checked;
  }
  verify(checked, std::move(found), filter);
  return checked;
}

/// Adds what a run on the machine shows to what a check has found.
void LintRun::verify(CheckedFile& checked, check::Report found, const selection::FindingFilter& filter) {
  const std::string_view text = checked.text();
  const selection::ProgramSettings& settings = checked.settings;
  const auto scene = options_.source.none ? nullptr : scenes_.of(settings.configuration, checked.name);
  const int jobs = jobs_for(text);
  const auto together = [jobs](const std::function<void()>& work) { threads::side_by_side(jobs, work); };
  const verification::VerifiedRun run =
      selection::verified(text, settings, scene.get(), {.together = together, .material = options_.material});
  if (run.certificate) checked.certificate = verification::in_words(*run.certificate, style_.language);
  checked.report = selection::shown_report_with_run(std::move(found), run.outcome, text, settings.selection, filter);
}

void LintRun::fix(CheckedFile& checked) const {
  const std::string_view text = checked.original();
  const fixing::FixOptions fix_options{.selection = checked.settings.selection,
                                       .setup = checked.settings.setup,
                                       .unsafe = options_.unsafe_fixes,
                                       .jobs = jobs_for(text),
                                       .finding_filter = [&](check::Report report, std::string_view version) {
                                         return without_known(std::move(report), checked.name, version);
                                       }};
  checked.fixed = fixing::fix_text(text, fix_options);
  checked.report = checked.fixed->report;
}

int LintRun::jobs_for(std::string_view text) const {
  return files_.size() == 1 || text.size() > kLargeFile ? jobs_ : 1;
}

check::Report LintRun::without_known(check::Report report, const std::string& name, std::string_view text) const {
  return baseline_ ? baseline_->without_known(std::move(report), name, text) : report;
}

void LintRun::show(const CheckedFile& checked) {
  progress_.clear();
  if (const auto* problem = std::get_if<SourceFile::Problem>(&checked.opened)) {
    complain(fmt::format("{}: {}", checked.name, problem->message));
    failed_ = true;
    return;
  }
  if (checked.why_not_fixed) {
    complain(fmt::format("{}: {}", checked.name, *checked.why_not_fixed));
    failed_ = true;
  }
  counts_ += checked.counts();
  if (options_.format == "text" && !checked.certificate.empty())
    certificates_ += fmt::format("{}: {}\n", text::printable(checked.name), text::printable(checked.certificate));
  if (options_.prints_program())
    fixing::write_fixed(std::get<SourceFile>(checked.opened), *checked.fixed,
                        [&](std::string_view text) { program_.write(text); });
  if (output_.has_failed()) return;
  if (options_.diff) return show_difference(checked);
  renderer_->file({checked.name, checked.text(), checked.report, checked.settings.setup, checked.certificate}, output_);
}

void LintRun::show_difference(const CheckedFile& checked) {
  const auto& source = std::get<SourceFile>(checked.opened);
  has_difference_ |= fixing::write_diff(checked.name, source, *checked.fixed, [&](std::string_view text) {
    output_.buffer() += text;
    output_.drain();
  });
}

}  // namespace isocnc::analyzer
