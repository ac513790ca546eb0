#include <algorithm>
#include <functional>
#include <iostream>
#include <variant>

#include <fmt/format.h>

#include "analyzer/command_line.h"
#include "analyzer/explain.h"
#include "analyzer/foreign_page.h"
#include "analyzer/formats/renderers.h"
#include "analyzer/input/files.h"
#include "analyzer/lint_output.h"
#include "analyzer/lint_run.h"
#include "analyzer/messages_page.h"
#include "analyzer/notepad_language.h"
#include "analyzer/selection/baseline.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/shards.h"
#include "analyzer/watch.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/configuration/show.h"
#include "interpreter/dialect/format.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::analyzer {
namespace {

using namespace dialect::literals;
using dialect::Language;
using system::ExitStatus;

/// Reports errors in the configurations read so far; returns whether there are any.
bool complain_of(const configuration::Configurations& configurations, Language language) {
  const std::vector<std::string> mistakes = configurations.mistakes(language);
  for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
  return !mistakes.empty();
}

/// Prints an answer other than findings.
ExitStatus say(std::string_view text, const LintCommandOptions& options) {
  LintOutput answer(options);
  answer.buffer() += text;
  return answer.finish() ? ExitStatus::Success : ExitStatus::Failure;
}

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
  if (LintRun(options, style, std::make_unique<Recorder>(baseline), nullptr, std::move(programs)).run(failed) !=
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

/// Why these options do not go with --watch, if so; the command line knows the others.
std::optional<std::string> obstacle_to_watch(const LintCommandOptions& options) {
  static constexpr dialect::Text kFormats = {"--watch: only with --format text, concise",
                                             "--watch: solo con --format text, concise"};
  static constexpr dialect::Text kStdin = {"--watch: standard input cannot be watched",
                                           "--watch: lo standard input non si può tenere d'occhio"};
  const Language language = options.reader_language();
  if (options.format != "text" && options.format != "concise") return std::string(kFormats.in(language));
  if (std::find(options.paths.begin(), options.paths.end(), "-") != options.paths.end())
    return std::string(kStdin.in(language));
  return std::nullopt;
}

template <typename Name>
void sort_by_name(std::vector<std::filesystem::path>& files, Name&& name) {
  std::sort(files.begin(), files.end(), [&](const auto& a, const auto& b) { return name(a) < name(b); });
}

/// The programs to check; nothing, after an error message, if the check cannot start.
std::optional<Programs> find_programs(const LintCommandOptions& options, configuration::Configurations& configurations,
                                      selection::SettingsFinder& settings, bool& failed) {
  const Language language = options.reader_language();
  input::FileSelection found = input::select_programs(options.paths, configurations, language);
  if (const auto shard = Shard::read(options.shard))
    std::erase_if(found.files, [&](const std::filesystem::path& file) { return !shard->holds(file); });
  // Tools that read JSON compare arrays, so the order must not depend on how the files were named. Reports of parts are
  // joined in the same order.
  if (options.format == "json") sort_by_name(found.files, [](const auto& file) { return system::generic_name(file); });
  if (options.format == "sarif")
    sort_by_name(found.files, [](const auto& file) { return formats::plain_path(system::generic_name(file)); });
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
  const formats::ReportStyle style{.language = options.reader_language(),
                                   .color = options.wants_color(),
                                   .unsafe_fixes = options.unsafe_fixes,
                                   .shard = options.shard};
  const std::vector<std::string> problems = selection::Selection().follow(options.selection, style.language);
  for (const std::string& problem : problems) complain(problem);
  if (!problems.empty()) return ExitStatus::Failure;
  if (const auto mistake =
          command_line::set_material_values(options.material_values, style.language, options.material)) {
    complain(*mistake);
    return ExitStatus::Failure;
  }
  if (options.watch) return watch(options, style);
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
  const selection::Baseline* const known = baseline ? &*baseline : nullptr;
  return LintRun(options, style, std::move(renderer), known, *std::move(programs)).run(failed);
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
                              : dialect::format(kFrom, language, system::generic_name(shown.file)));
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
  if (options.notepad_language) return say(notepad_language(), options);
  if (options.config_schema) return say(configuration::json_schema(options.reader_language()), options);
  if (options.setup_schema) return say(configuration::setup_schema(options.reader_language()), options);
  if (options.config_keys) return say(configuration::key_page(options.reader_language()), options);
  if (options.machine_page) return say(configuration::machine_page(options.reader_language()), options);
  if (options.merge) return merge_shards(options);
  if (options.show_config) return show_config(options);
  if (options.list_rules) return say(list_rules(options.reader_language()), options);
  if (!options.explain.empty()) return explain_code(options);
  if (const auto obstacle = options.watch ? obstacle_to_watch(options) : std::nullopt) {
    command_line::complain_of_command("isolint", *obstacle);
    return ExitStatus::Failure;
  }
  return check(options);
}

}  // namespace
}  // namespace isocnc::analyzer

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isolint", isocnc::analyzer::run_main, argc, argv);
}
