#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <iostream>
#include <mutex>
#include <thread>
#include <variant>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "analyzer/check/side_by_side.h"
#include "analyzer/command_line.h"
#include "analyzer/explain.h"
#include "analyzer/fixing/fixer.h"
#include "analyzer/fixing/program_fixing.h"
#include "analyzer/foreign_page.h"
#include "analyzer/formats/renderers.h"
#include "analyzer/input/files.h"
#include "analyzer/messages_page.h"
#include "analyzer/selection/baseline.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/shown_report.h"
#include "analyzer/selection/tally.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/command_line/progress.h"
#include "interpreter/configuration/show.h"
#include "interpreter/dialect/format.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::analyzer {
namespace {

using namespace dialect::literals;
using dialect::Language;
using system::SourceFile;

using system::ExitStatus;

void complain(std::string_view what) { command_line::complain("isolint", what); }

/// Reports errors in the configurations read so far; returns whether there are any.
bool complain_of(const configuration::Configurations& configurations, Language language) {
  const std::vector<std::string> mistakes = configurations.mistakes(language);
  for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
  return !mistakes.empty();
}

/// The output of findings and all other answers.
class LintOutput final : public formats::Output {
 public:
  explicit LintOutput(const LintCommandOptions& options)
      : path_(options.output),
        language_(options.reader_language()),
        descriptor_(options.prints_program() ? system::kStandardError : system::kStandardOutput),
        file_(path_.empty() ? system::OutputFile(descriptor_) : system::OutputFile(std::filesystem::path(path_))) {}

  /// Writes the rest; returns false, after an error message, if output has been lost.
  bool finish() {
    flush();
    const std::string standard = descriptor_ == system::kStandardOutput ? "<stdout>" : "<stderr>";
    const std::optional<std::string> problem = system::commit(file_, path_.empty() ? standard : path_, language_);
    if (problem) complain(*problem);
    return !problem;
  }
  bool has_failed() const { return file_.error() != 0; }

 protected:
  void write(std::string_view text) override { file_.write(text); }

 private:
  const std::string path_;
  const Language language_;
  const int descriptor_;
  system::OutputFile file_;
};

/// Prints an answer other than findings.
ExitStatus say(std::string_view text, const LintCommandOptions& options) {
  LintOutput answer(options);
  answer.buffer() += text;
  return answer.finish() ? ExitStatus::Success : ExitStatus::Failure;
}

/// The files to check, and the settings of each.
struct Programs {
  std::vector<std::filesystem::path> files;
  std::vector<std::reference_wrapper<const selection::ProgramSettings>> settings;
};

/// Checks files in parallel and shows the findings in the order of the files.
class LintRun {
 public:
  LintRun(const LintCommandOptions& options, const formats::ReportStyle& style,
          std::unique_ptr<formats::Renderer> renderer, std::optional<selection::Baseline> baseline, Programs programs)
      : options_(options),
        style_(style),
        baseline_(std::move(baseline)),
        files_(std::move(programs.files)),
        settings_(std::move(programs.settings)),
        renderer_(std::move(renderer)),
        jobs_(options.jobs > 0 ? options.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
        progress_(command_line::terminal_writer(), input::bytes_of(files_)),
        output_(options) {}

  ExitStatus run(bool failed) {
    failed_ = failed;
    if (output_.has_failed()) {
      output_.finish();
      return ExitStatus::Failure;
    }
    renderer_->begin(output_.buffer());
    const auto workers = std::min<std::size_t>(static_cast<std::size_t>(jobs_), files_.size());
    check::side_by_side(static_cast<int>(workers), [this] { work(); });
    progress_.clear();
    renderer_->end(output_.buffer());
    if (!output_.finish()) return ExitStatus::Failure;
    if (program_.flush() != 0) {
      complain(fmt::format("<stdout>: {}", system::cannot_write(program_.error(), style_.language)));
      return ExitStatus::Failure;
    }
    if (options_.format == "text") {
      summarize();
    } else if (options_.fix) {
      std::cerr << fixed_in_words() << '\n';
    }
    if (failed_) return ExitStatus::Failure;
    return options_.exit_zero || is_good_enough() ? ExitStatus::Success : ExitStatus::Findings;
  }

 private:
  /// A program and its findings.
  struct CheckedFile {
    std::string name;
    std::variant<SourceFile, SourceFile::Problem> opened;
    const selection::ProgramSettings& settings;
    check::Report report = {};
    std::optional<fixing::FixedText> fixed = {};
    std::optional<std::string> why_not_fixed = {};

    std::string_view original() const { return std::get<SourceFile>(opened).text(); }
    std::string_view text() const { return fixed ? fixed->text : original(); }
  };

  void work() {
    for (std::size_t index = next_++; index < files_.size(); index = next_++) {
      const CheckedFile checked = check(files_[index], settings_[index]);
      std::unique_lock lock(mutex_);
      turn_changed_.wait(lock, [&] { return turn_ == index; });
      show(checked);
      ++turn_;
      turn_changed_.notify_all();
    }
  }

  CheckedFile check(const std::filesystem::path& path, const selection::ProgramSettings& settings) {
    const bool from_stdin = path == "-";
    std::optional<fixing::FileFixing> fixing;
    if (options_.fix && !options_.diff && !from_stdin) fixing.emplace(path);  // Before the file is read.
    CheckedFile checked{from_stdin ? options_.stdin_name : path.generic_string(),
                        from_stdin ? SourceFile::read_stream(system::kStandardInput, style_.language)
                                   : SourceFile::open(path, style_.language),
                        settings};
    const auto* const source = std::get_if<SourceFile>(&checked.opened);
    if (!source) return checked;
    if (options_.fix || options_.diff) {
      fix(checked);
      if (fixing) checked.why_not_fixed = fixing->finish(*source, *checked.fixed, style_.language);
      if (!checked.why_not_fixed) {
        known_ += checked.fixed->filtered_out;
        return checked;
      }
      checked.fixed.reset();
    }
    const std::string_view text = source->text();
    std::size_t progress_bytes = 0;
    const auto advance_to = [&](std::size_t bytes) { progress_.add(bytes - std::exchange(progress_bytes, bytes)); };
    const auto filter = [&](check::Report report, std::string_view) {
      const std::size_t all = check::folded_size(report);
      report = without_known(std::move(report), checked.name, text);
      known_ += all - check::folded_size(report);
      return report;
    };
    checked.report = selection::shown_report(check::check_text(text, settings.setup, jobs_for(text), advance_to), text,
                                             settings.selection, filter);
    return checked;
  }

  void fix(CheckedFile& checked) {
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

  int jobs_for(std::string_view text) const { return files_.size() == 1 || text.size() > kLargeFile ? jobs_ : 1; }

  check::Report without_known(check::Report report, const std::string& name, std::string_view text) const {
    return baseline_ ? baseline_->without_known(std::move(report), name, text) : report;
  }

  void show(const CheckedFile& checked) {
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
    tally_.add(checked.report);
    ++files_checked_;
    if (checked.fixed) fixed_ += checked.fixed->fixed;
    if (options_.prints_program())
      fixing::write_fixed(std::get<SourceFile>(checked.opened), *checked.fixed,
                          [&](std::string_view text) { program_.write(text); });
    if (output_.has_failed()) return;
    if (options_.diff) return show_difference(checked);
    renderer_->file({checked.name, checked.text(), checked.report, checked.settings.setup}, output_);
  }

  void show_difference(const CheckedFile& checked) {
    const auto& source = std::get<SourceFile>(checked.opened);
    has_difference_ |= fixing::write_diff(checked.name, source, *checked.fixed, [&](std::string_view text) {
      output_.buffer() += text;
      output_.drain();
    });
  }

  std::size_t count(dialect::Severity severity) const { return tally_.of(severity); }

  bool is_good_enough() const {
    const std::size_t warnings = count(dialect::Severity::Warning);
    const bool too_many = options_.max_warnings && warnings > *options_.max_warnings;
    if (too_many)
      complain(style_.language == Language::Italian
                   ? fmt::format("troppi avvisi: {}, ammessi {}", warnings, *options_.max_warnings)
                   : fmt::format("too many warnings: {}, and {} allowed", warnings, *options_.max_warnings));
    return !too_many && !has_difference_ && count(dialect::Severity::Error) == 0;
  }

  /// The number of fixed findings, such as `3 fixed`.
  std::string fixed_in_words() const {
    const bool italian = style_.language == Language::Italian;
    if (options_.diff) return fmt::format("{} {}", fixed_, italian ? "correggibili" : "would be fixed");
    return fmt::format("{} {}", fixed_, italian ? (fixed_ == 1 ? "corretto" : "corretti") : "fixed");
  }

  void summarize() const {
    const bool italian = style_.language == Language::Italian;
    const auto plural = [](std::size_t n, std::string_view one, std::string_view many) {
      return fmt::format("{} {}", n, n == 1 ? one : many);
    };
    const std::size_t errors = count(dialect::Severity::Error);
    const std::size_t warnings = count(dialect::Severity::Warning);
    const std::size_t infos = count(dialect::Severity::Info);
    std::string line = italian ? plural(errors, "errore", "errori") + ", " + plural(warnings, "avviso", "avvisi")
                               : plural(errors, "error", "errors") + ", " + plural(warnings, "warning", "warnings");
    if (infos > 0) line += ", " + plural(infos, italian ? "nota" : "note", italian ? "note" : "notes");
    line += " in " + plural(files_checked_, "file", italian ? "file" : "files");
    if (baseline_) line += fmt::format("; {} {}", known_.load(), italian ? "nella baseline" : "in the baseline");
    if (options_.fix || options_.diff) line += "; " + fixed_in_words();
    std::cerr << line << '\n';
  }

  static constexpr std::size_t kLargeFile = 8 * 1024 * 1024;

  const LintCommandOptions& options_;
  const formats::ReportStyle& style_;
  const std::optional<selection::Baseline> baseline_;
  const std::vector<std::filesystem::path> files_;
  const std::vector<std::reference_wrapper<const selection::ProgramSettings>> settings_;
  std::unique_ptr<formats::Renderer> renderer_;
  const int jobs_;
  command_line::Progress progress_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::size_t> known_ = 0;  // The number of findings that the baseline knows.
  std::mutex mutex_;
  std::condition_variable turn_changed_;
  std::size_t turn_ = 0;  // Guarded by mutex_, like the members below.
  LintOutput output_;
  selection::Tally tally_;
  system::OutputFile program_{system::kStandardOutput};  // The output of --fix -.
  std::size_t files_checked_ = 0;
  std::size_t fixed_ = 0;
  bool has_difference_ = false;
  bool failed_ = false;
};

/// Records findings instead of showing them.
class Recorder final : public formats::Renderer {
 public:
  explicit Recorder(selection::Baseline& baseline) : baseline_(baseline) {}
  void file(const formats::CheckedProgram& program, formats::Output&) override {
    baseline_.add(program.name, program.text, program.report);
  }

 private:
  selection::Baseline& baseline_;
};

/// Checks, and writes all findings as a baseline, unless programs would be missing from it.
ExitStatus record(LintCommandOptions options, const formats::ReportStyle& style, Programs programs, bool failed) {
  const bool italian = style.language == Language::Italian;
  const std::string& file = options.write_baseline;
  options.exit_zero = true;  // Findings that are recorded are no failure.
  selection::Baseline baseline(file);
  if (LintRun(options, style, std::make_unique<Recorder>(baseline), {}, std::move(programs)).run(failed) !=
      ExitStatus::Success) {
    complain(fmt::format("{}: {}", file, italian ? "non scritto" : "not written"));
    return ExitStatus::Failure;
  }
  system::OutputFile output{std::filesystem::path(file)};
  output.write(baseline.to_json());
  const std::optional<std::string> problem = system::commit(output, file, style.language);
  if (problem) complain(*problem);
  return problem ? ExitStatus::Failure : ExitStatus::Success;
}

/// The programs to check; nothing, after an error message, if the check cannot start.
std::optional<Programs> find_programs(const LintCommandOptions& options, configuration::Configurations& configurations,
                                      selection::SettingsFinder& settings, bool& failed) {
  const Language language = options.reader_language();
  input::FileSelection found = input::select_programs(options.paths, configurations, language);
  // Tools that read JSON compare arrays, so the order must not depend on how the files were named.
  if (options.format == "json")
    std::sort(found.files.begin(), found.files.end(),
              [](const auto& a, const auto& b) { return a.generic_string() < b.generic_string(); });
  Programs programs{.files = std::move(found.files), .settings = {}};
  for (const std::filesystem::path& file : programs.files)
    programs.settings.emplace_back(settings.of(input::place_of_program(file, options.stdin_name)));
  if (complain_of(configurations, language)) return std::nullopt;
  for (const std::string& problem : found.problems) complain(problem);
  failed = !found.problems.empty();
  if (found.is_refused) return std::nullopt;
  return programs;
}

/// The reason why `written` must not be overwritten: it is one of the programs, which would lose their lines during the
/// check, or another input. Null if it is neither.
const dialect::Text* overwritten_input(const std::string& written, const Programs& programs,
                                       const LintCommandOptions& options,
                                       configuration::Configurations& configurations) {
  static constexpr dialect::Text kProgram = {"is one of the programs to be checked",
                                             "è uno dei programmi da verificare"};
  static constexpr dialect::Text kConfiguration = {"is the configuration", "è la configurazione"};
  static constexpr dialect::Text kBaseline = {"is the baseline", "è la baseline"};
  static constexpr dialect::Text kTwice = {"is written by --write-baseline", "viene scritto da --write-baseline"};
  const bool is_output = &written == &options.output;
  if (written.empty()) return nullptr;
  if (is_output && system::is_same_file(written, options.baseline)) return &kBaseline;
  if (is_output && system::is_same_file(written, options.write_baseline)) return &kTwice;
  for (const std::filesystem::path& file : programs.files) {
    if (system::is_same_file(written, file)) return &kProgram;
    const std::filesystem::path place = input::place_of_program(file, options.stdin_name);
    if (system::is_same_file(written, configurations.of(place).file)) return &kConfiguration;
  }
  return nullptr;
}

/// Checks the files. The first path's configuration decides the language: a command uses one language.
ExitStatus check(LintCommandOptions options) {
  if (options.paths.empty()) options.paths = {"."};
  configuration::Configurations configurations(options.source, options.reader_language());
  options.follow(configurations.of(input::place_of_program(options.paths.front(), options.stdin_name)));
  const formats::ReportStyle style{
      .language = options.reader_language(), .color = options.wants_color(), .unsafe_fixes = options.unsafe_fixes};
  const std::vector<std::string> problems = selection::Selection().follow(options.selection, style.language);
  for (const std::string& problem : problems) complain(problem);
  if (!problems.empty()) return ExitStatus::Failure;
  std::unique_ptr<formats::Renderer> renderer = options.statistics
                                                    ? formats::make_statistics_renderer(options.format, style)
                                                    : formats::make_renderer(options.format, style);
  if (!renderer) {
    complain(fmt::format("--statistics: {} text, concise, json",
                         style.language == Language::Italian ? "solo con --format" : "only with --format"));
    return ExitStatus::Failure;
  }
  bool failed = false;
  selection::SettingsFinder settings(configurations, options.selection);
  auto programs = find_programs(options, configurations, settings, failed);
  if (!programs) return ExitStatus::Failure;
  for (const std::string* written : {&options.output, &options.write_baseline}) {
    const dialect::Text* const what = overwritten_input(*written, *programs, options, configurations);
    if (!what) continue;
    complain(fmt::format("{}: {}", *written, what->in(style.language)));
    return ExitStatus::Failure;
  }
  if (!options.write_baseline.empty()) return record(options, style, *std::move(programs), failed);
  std::optional<selection::Baseline> baseline;
  if (!options.baseline.empty()) {
    auto read = selection::Baseline::read(options.baseline, style.language);
    if (const auto* mistake = std::get_if<std::string>(&read)) {
      complain(*mistake);
      return ExitStatus::Failure;
    }
    baseline = std::get<selection::Baseline>(std::move(read));
  }
  return LintRun(options, style, std::move(renderer), std::move(baseline), *std::move(programs)).run(failed);
}

ExitStatus explain_code(const LintCommandOptions& options) {
  const Language language = options.reader_language();
  if (const auto id = dialect::find_diagnostic(options.explain)) return say(explain(*id, language), options);
  complain(selection::unknown_code(options.explain, language));
  return ExitStatus::Failure;
}

/// The configuration with only those overrides for some files that apply to this program.
configuration::Configuration without_other_files(configuration::Configuration shown,
                                                 const std::filesystem::path& program) {
  const std::filesystem::path real = configuration::real_path(program.parent_path()) / program.filename();
  std::erase_if(shown.lint.files,
                [&](const configuration::FileOverrides& files) { return !files.patterns.match(real); });
  return shown;
}

/// Prints a configuration as its file could write it, and the file that it comes from.
ExitStatus show_config(LintCommandOptions options) {
  static constexpr dialect::Text kFrom = {"configuration: {}", "configurazione: {}"};
  static constexpr dialect::Text kDefaults = {"no isocnc.json: these are the defaults",
                                              "nessun isocnc.json: valgono questi valori predefiniti"};
  static constexpr dialect::Text kOnePath = {"--show-config takes one path", "--show-config vuole un solo percorso"};
  if (options.paths.empty()) options.paths = {"."};
  configuration::Configurations configurations(options.source, options.reader_language());
  const std::filesystem::path place = input::place_of_program(options.paths.front(), options.stdin_name);
  const configuration::Configuration& shown = configurations.of(place);
  options.follow(shown);
  const Language language = options.reader_language();
  if (complain_of(configurations, language)) return ExitStatus::Failure;
  if (options.paths.size() > 1) {
    complain(kOnePath.in(language));
    return ExitStatus::Failure;
  }
  complain(shown.file.empty() ? std::string(kDefaults.in(language))
                              : dialect::format(kFrom, language, shown.file.generic_string()));
  std::error_code unknown;
  const bool is_folder = std::filesystem::is_directory(place, unknown);
  return say(configuration::to_json(is_folder ? shown : without_other_files(shown, place)), options);
}

ExitStatus run_main(int argc, char** argv) {
  const CommandLine command = read_command_line(argc, argv);
  const LintCommandOptions& options = command.options;
  if (command.answer) return say(*command.answer, options);
  if (command.complaint) {
    command_line::complain_of_command("isolint", *command.complaint);
    return ExitStatus::Failure;
  }
  if (options.rules_page) return say(rules_page(options.reader_language()), options);
  if (options.messages_page) return say(messages_page(), options);
  if (options.foreign_page) return say(foreign_page(options.reader_language()), options);
  if (options.config_schema) return say(configuration::json_schema(), options);
  if (options.config_keys) return say(configuration::key_page(options.reader_language()), options);
  if (options.machine_page) return say(configuration::machine_page(options.reader_language()), options);
  if (options.show_config) return show_config(options);
  if (options.list_rules) return say(list_rules(options.reader_language()), options);
  if (!options.explain.empty()) return explain_code(options);
  return check(options);
}

}  // namespace
}  // namespace isocnc::analyzer

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isolint", isocnc::analyzer::run_main, argc, argv);
}
