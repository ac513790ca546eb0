#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "analyzer/check/jump_map.h"
#include "analyzer/check/side_by_side.h"
#include "analyzer/revisions/path_comparison.h"
#include "analyzer/revisions/revision_report.h"
#include "analyzer/selection/program_settings.h"
#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/command_line/run_values.h"
#include "interpreter/command_line/source_options.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/overlay/comparison_page.h"
#include "interpreter/plot/page_template.h"
#include "interpreter/plot/plot_tools.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/terminal.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/lists.h"

namespace isocnc::interpreter {
namespace {

using dialect::Language;
using dialect::Text;
using system::ExitStatus;

/// The options of the command line as text. Numbers are parsed later, when the language of error messages is known.
struct DiffCommandOptions {
  std::string old_file;
  std::string new_file;
  std::string tolerance = "0.001";
  std::string format = "text";
  std::string output;
  std::string color = "auto";
  bool all_paths = false;
  bool verify = false;
  std::vector<std::string> ignored;
  std::string language;
  command_line::RunValues values;
  configuration::ConfigurationSource source;
  std::optional<std::string> machine;

  Language reader_language() const { return dialect::language_named(language).value_or(system::user_language()); }
  bool has_output_file() const { return !output.empty() && output != "-"; }
  bool wants_color() const {
    if (color != "auto") return color == "always";
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets a variable.
    return !has_output_file() && system::is_terminal(system::kStandardOutput) && std::getenv("NO_COLOR") == nullptr;
  }
};

constexpr Text kWrongTolerance{"--tolerance takes a plain number of mm above 0, such as 0.001, not {}",
                               "--tolerance vuole un numero semplice in mm maggiore di 0, come 0.001, non {}"};
constexpr Text kWrongIgnored{"--ignore takes feed, speed, time or comments, not {}",
                             "--ignore vuole feed, speed, time o comments, non {}"};
constexpr Text kOneStandardInput{"only one of the programs can come from standard input",
                                 "solo uno dei programmi può arrivare dallo standard input"};
constexpr Text kNoPage{"this isodiff writes no html: it was built without npm, which that takes",
                       "questo isodiff non scrive html: è stato compilato senza npm, che serve per questo"};
constexpr Text kOnePath{"--format html shows both programs on one path: name it by --vgpl instead of --all-paths",
                        "--format html mostra i due programmi su una sola via: indicarla con --vgpl invece di "
                        "--all-paths"};
constexpr Text kPageToTerminal{"--format html writes a page, which a terminal does not show: name a file with --output",
                               "--format html scrive una pagina, che un terminale non mostra: indicare un file con "
                               "--output"};
constexpr Text kNoScene{
    "{}: no setup is for this program, so contacts and material are not compared",
    "{}: nessun attrezzaggio è per questo programma, quindi contatti e materiale non si confrontano"};
constexpr Text kOverwrites{"{}: this would overwrite {}", "{}: così si sovrascriverebbe {}"};

void complain(std::string_view what) { command_line::complain("isodiff", what); }

bool is_standard_input(const std::string& file) { return file == "-" || file == "/dev/stdin"; }

/// None after an error message.
std::optional<comparison::ComparisonOptions> read_comparison_options(const DiffCommandOptions& options) {
  const Language language = options.reader_language();
  comparison::ComparisonOptions read;
  const std::optional<double> tolerance = command_line::read_decimal(options.tolerance);
  if (!tolerance || !(*tolerance > 0)) {
    complain(dialect::format(kWrongTolerance, language, options.tolerance));
    return std::nullopt;
  }
  read.tolerance = *tolerance;
  for (const std::string& list : options.ignored)
    for (const std::string_view ignored : text::split_at_commas(list)) {
      if (ignored == "feed") {
        read.ignores_feed = true;
      } else if (ignored == "speed") {
        read.ignores_speed = true;
      } else if (ignored == "time") {
        read.ignores_time = true;
      } else if (ignored != "comments") {  // Comments never count.
        complain(dialect::format(kWrongIgnored, language, ignored));
        return std::nullopt;
      }
    }
  return read;
}

/// Reads both programs; none after an error message.
std::optional<std::array<system::SourceFile, 2>> read_sources(const DiffCommandOptions& options) {
  const Language language = options.reader_language();
  std::vector<system::SourceFile> sources;
  for (const std::string* const file : {&options.old_file, &options.new_file}) {
    auto opened = is_standard_input(*file) ? system::SourceFile::read_stream(system::kStandardInput, language)
                                           : system::SourceFile::open(*file, language);
    if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
      complain(fmt::format("{}: {}", is_standard_input(*file) ? "<stdin>" : *file, problem->message));
      return std::nullopt;
    }
    sources.push_back(std::move(std::get<system::SourceFile>(opened)));
  }
  return std::array{std::move(sources[0]), std::move(sources[1])};
}

/// Whether the output is none of the files that are read; false after an error message.
bool is_apart(const DiffCommandOptions& options, const std::vector<std::filesystem::path>& configurations) {
  if (!options.has_output_file()) return true;
  std::vector<std::string> read = {options.old_file, options.new_file, options.machine.value_or("")};
  for (const std::filesystem::path& file : configurations) read.push_back(file.generic_string());
  for (const std::string& file : read) {
    if (file.empty() || is_standard_input(file) || !system::is_same_file(file, options.output)) continue;
    complain(dialect::format(kOverwrites, options.reader_language(), options.output, file));
    return false;
  }
  return true;
}

/// Whether a page can be written, and somebody can open it; false after an error message.
bool can_write_page(const DiffCommandOptions& options) {
  if (options.format != "html") return true;
  if (plot::kPageTemplate.empty()) {
    complain(kNoPage.in(options.reader_language()));
    return false;
  }
  if (options.all_paths) {
    complain(kOnePath.in(options.reader_language()));
    return false;
  }
  if (options.has_output_file() || !system::is_terminal(system::kStandardOutput)) return true;
  complain(kPageToTerminal.in(options.reader_language()));
  return false;
}

/// Opens the output, lets `write` write to it, and closes it; false after an error message.
bool write_result(const DiffCommandOptions& options, const std::function<void(system::OutputFile&)>& write) {
  std::optional<system::OutputFile> output;
  if (options.has_output_file()) {
    output.emplace(std::filesystem::path(options.output));
  } else {
    output.emplace(system::kStandardOutput);
  }
  write(*output);
  const std::optional<std::string> problem =
      system::commit(*output, options.has_output_file() ? options.output : "<stdout>", options.reader_language());
  if (problem) complain(*problem);
  return !problem;
}

/// What one of the programs runs on, and what is shown of it.
struct ProgramMachine {
  std::unique_ptr<const configuration::Configuration> configuration;  ///< With the machine that is given, if one is.
  selection::Selection selection;
  std::shared_ptr<const verification::Scene> scene;  ///< Null unless it is to be verified.

  const configuration::MachineConfiguration& machine() const { return configuration->machine; }
};

/// An empty path for standard input.
std::filesystem::path program_path(const std::string& file) { return is_standard_input(file) ? "" : file; }

/// Prints mistakes, if there are any.
bool has_mistakes(const std::vector<std::vector<std::string>>& lists) {
  bool has_any = false;
  for (const std::vector<std::string>& mistakes : lists)
    for (const std::string& mistake : mistakes) {
      std::cerr << mistake << '\n';
      has_any = true;
    }
  return has_any;
}

/// Finds the machines of both programs. The configurations also set the language, unless the command line does. None
/// after error messages.
std::optional<std::array<ProgramMachine, 2>> find_machines(DiffCommandOptions& options, configuration::Scenes& scenes,
                                                           configuration::Configurations& found) {
  configuration::Configurations given({.file = options.machine, .none = !options.machine}, options.reader_language());
  selection::SettingsFinder settings(found, {});
  std::vector<ProgramMachine> machines;
  for (const std::string* const file : {&options.old_file, &options.new_file}) {
    const std::filesystem::path program = program_path(*file);
    const configuration::Configuration& configuration = found.in_folder(program.parent_path());
    if (options.language.empty() && configuration.language)
      options.language = dialect::name_of(*configuration.language);
    auto surrounded = std::make_unique<configuration::Configuration>(configuration);
    if (options.machine) surrounded->machine = given.in_folder(program.parent_path()).machine;
    machines.push_back({std::move(surrounded), settings.of(program).selection, nullptr});
  }
  if (has_mistakes({found.mistakes(options.reader_language()), given.mistakes(options.reader_language())}))
    return std::nullopt;
  if (options.verify && !options.source.none) {
    machines[0].scene = scenes.of(*machines[0].configuration, program_path(options.old_file));
    machines[1].scene = scenes.of(*machines[1].configuration, program_path(options.new_file));
  }
  if (has_mistakes({scenes.mistakes(options.reader_language())})) return std::nullopt;
  if (options.verify)
    for (std::size_t side = 0; side < 2; ++side)
      if (!machines[side].scene)
        complain(dialect::format(kNoScene, options.reader_language(), side == 0 ? options.old_file : options.new_file));
  return std::array{std::move(machines[0]), std::move(machines[1])};
}

/// How both are run and compared; none after an error message.
std::optional<revisions::CompareOptions> read_compare_options(const DiffCommandOptions& options) {
  revisions::CompareOptions read;
  if (const auto problem = command_line::set_run_values(options.values, options.reader_language(), read.run)) {
    complain(*problem);
    return std::nullopt;
  }
  const auto comparison_options = read_comparison_options(options);
  if (!comparison_options) return std::nullopt;
  read.comparison = *comparison_options;
  read.together = [](const std::function<void()>& work) {
    check::side_by_side(std::max(1, static_cast<int>(std::thread::hardware_concurrency())), work);
  };
  return read;
}

/// The registers of --set, which have been read before.
check::RegisterSet set_registers(const DiffCommandOptions& options) {
  check::RegisterSet registers = 0;
  for (const std::string& setting : options.values.settings) {
    const auto reg = command_line::read_count(setting.substr(1, setting.find('=') - 1), dialect::kRegisterCount);
    registers |= check::register_bit(static_cast<int>(reg.value_or(0)));
  }
  return registers;
}

/// The result as text or JSON, and the exit status.
struct DiffResult {
  std::string text;
  ExitStatus status = ExitStatus::Success;
};

/// On the path that the values of the command lead along.
DiffResult compare_once(const revisions::RevisionPair& pair, const revisions::CompareOptions& compare_options,
                        const DiffCommandOptions& options) {
  const Language language = options.reader_language();
  const revisions::RevisionComparison compared = revisions::compare(pair, compare_options);
  return {options.format == "json" ? json_of(compared, language)
                                   : text_of(compared, {.language = language, .color = options.wants_color()}),
          compared.is_same() ? ExitStatus::Success : ExitStatus::Findings};
}

/// What has not been compared may differ: then the result is not known.
DiffResult compare_all_paths(const revisions::RevisionPair& pair, const revisions::CompareOptions& compare_options,
                             const DiffCommandOptions& options) {
  const comparison::TextStyle style{.language = options.reader_language(), .color = options.wants_color()};
  const revisions::PathComparison compared =
      revisions::compare_on_paths(pair, compare_options, set_registers(options), style);
  const ExitStatus same = compared.is_complete() ? ExitStatus::Success : ExitStatus::Failure;
  return {options.format == "json" ? json_of(compared) : text_of(compared, style),
          compared.is_same() ? same : ExitStatus::Findings};
}

plot::PlotSubject subject_of(const DiffCommandOptions& options, const std::string& file,
                             const revisions::Revision& revision, const ProgramMachine& machine) {
  return {.name = is_standard_input(file) ? "<stdin>" : std::filesystem::path(file).filename().generic_string(),
          .program = revision.text,
          .home = revision.setup.home,
          .tools = plot::plot_tools(machine.machine()),
          .page = plot::kPageTemplate,
          .language = options.reader_language()};
}

/// Both programs on one path each, as a page.
ExitStatus write_page(const DiffCommandOptions& options, const revisions::RevisionPair& pair,
                      const std::array<ProgramMachine, 2>& machines, const revisions::CompareOptions& compare_options) {
  const plot::PlotSubject old_subject = subject_of(options, options.old_file, pair.old_revision, machines[0]);
  const plot::PlotSubject new_subject = subject_of(options, options.new_file, pair.new_revision, machines[1]);
  running::RunOptions old_run = compare_options.run;
  running::RunOptions new_run = compare_options.run;
  old_run.setup = pair.old_revision.setup;
  new_run.setup = pair.new_revision.setup;
  const revisions::RevisionComparison compared = revisions::compare(pair, compare_options);
  const overlay::ShownComparison shown{
      .old_run = compared.old_run.recorded,
      .new_run = compared.new_run.recorded,
      .facts = overlay::comparison_facts(to_json(compared, Language::English), to_json(compared, Language::Italian)),
      .tolerance = compare_options.comparison.tolerance};
  const bool is_written = write_result(options, [&](system::OutputFile& output) {
    overlay::write_page(output, {old_subject, old_run, pair.old_revision.machine},
                        {new_subject, new_run, pair.new_revision.machine}, shown);
  });
  if (!is_written) return ExitStatus::Failure;
  return compared.is_same() ? ExitStatus::Success : ExitStatus::Findings;
}

ExitStatus compare_files(DiffCommandOptions options) {
  configuration::Configurations found(options.source, options.reader_language());
  configuration::Scenes scenes(options.reader_language());
  const auto machines = find_machines(options, scenes, found);
  if (!machines) return ExitStatus::Failure;
  const auto compare_options = read_compare_options(options);
  if (!compare_options || !can_write_page(options) ||
      !is_apart(options, {(*machines)[0].configuration->file, (*machines)[1].configuration->file}))
    return ExitStatus::Failure;
  if (is_standard_input(options.old_file) && is_standard_input(options.new_file)) {
    complain(kOneStandardInput.in(options.reader_language()));
    return ExitStatus::Failure;
  }
  const auto sources = read_sources(options);
  if (!sources) return ExitStatus::Failure;
  const auto revision = [&](std::size_t side) {
    const ProgramMachine& machine = (*machines)[side];
    return revisions::Revision{(*sources)[side].text(), machine.machine().timed, machine.machine().setup,
                               machine.selection, machine.scene.get()};
  };
  const revisions::Revision old_revision = revision(0);
  const revisions::Revision new_revision = revision(1);
  const revisions::RevisionPair pair{old_revision, new_revision};
  if (options.format == "html") return write_page(options, pair, *machines, *compare_options);
  const DiffResult result = options.all_paths ? compare_all_paths(pair, *compare_options, options)
                                              : compare_once(pair, *compare_options, options);
  const bool is_written = write_result(options, [&](system::OutputFile& output) { output.write(result.text); });
  return is_written ? result.status : ExitStatus::Failure;
}

ExitStatus diff_main(int argc, char** argv) {
  DiffCommandOptions options;
  command_line::ProgramApp program(
      argc, argv, {"Compares what two ISOCNC programs do.", "Confronta che cosa fanno due programmi ISOCNC."},
      {.program = "isodiff",
       .version = ISOCNC_VERSION,
       .purpose = {"compare what two ISOCNC programs do", "confronta che cosa fanno due programmi ISOCNC"},
       .operands = "OLD NEW",
       .paragraphs = {{"isodiff runs both programs on the simulated machine and compares what it does: motions, feeds, "
                       "tools, the spindle, M functions, dwells, and how the run ends. How a program is written does "
                       "not count: numbers of lines, comments, G90 or G91, units, arcs by radius or center, one line "
                       "as two.",
                       "isodiff esegue i due programmi sulla macchina simulata e confronta che cosa fa: movimenti, "
                       "avanzamenti, utensili, mandrino, funzioni M, attese, e come finisce l'esecuzione. Come è "
                       "scritto un programma non conta: numeri di riga, commenti, G90 o G91, unità, archi con raggio o "
                       "centro, una linea divisa in due."},
                      {"Both run under the same VGPL and registers. Each program has the configuration that is found "
                       "above it, unless one is given.",
                       "Entrambi sono eseguiti con la stessa VGPL e gli stessi registri. Ogni programma ha la "
                       "configurazione che si trova sopra di lui, a meno che non ne sia data una."}},
       .exit =
           {{"0", {"Both do the same.", "Entrambi fanno lo stesso."}},
            {"1", {"They differ.", "Differiscono."}},
            {"2",
             {"A mistake in the command or in an isocnc.json, or something could not be read or written.",
              "Un errore nel comando o in un isocnc.json, oppure qualcosa che non si è potuto leggere o scrivere."}}},
       .see_also = {"isorun", "isofmt", "isolint"}});
  program
      .add_option("OLD", options.old_file, {" ", " "},
                  {"The old program, or - for standard input", "Il vecchio programma, o - per lo standard input"})
      .required();
  program
      .add_option("NEW", options.new_file, {" ", " "},
                  {"The new program, or - for standard input", "Il nuovo programma, o - per lo standard input"})
      .required();
  program.add_option(
      "--tolerance", options.tolerance, {"MM", "MM"},
      {"What is this near is the same (else 0.001)", "Ciò che è vicino così è lo stesso (altrimenti 0.001)"});
  program.add_choice("--format", options.format, {"text", "json", "html"}, {"FORMAT", "FORMATO"},
                     {"text, json or html (else text)", "text, json o html (altrimenti text)"});
  program.add_option("-o,--output", options.output, command_line::kFileValue,
                     {"Where to write; else to standard output", "Dove scrivere; altrimenti sullo standard output"});
  program
      .add_option(
          "--ignore", options.ignored, {"LIST", "ELENCO"},
          {"What does not count: feed, speed, time, comments", "Che cosa non conta: feed, speed, time, comments"})
      .takes_one();
  program.suggest("--ignore", {"feed", "speed", "time", "comments"});
  program.add_flag(
      "--verify", options.verify,
      {"Compare contacts and removed material as well", "Confronta anche i contatti e il materiale asportato"});
  program.add_flag("--all-paths", options.all_paths,
                   {"Compare on every path that the IFs tell apart", "Confronta su ogni via che gli IF distinguono"});
  program.add_choice("--color", options.color, {"auto", "always", "never"}, {"WHEN", "QUANDO"},
                     {"auto, always or never (else auto)", "auto, always o never (altrimenti auto)"});
  command_line::add_run_values(program, options.values);
  program.add_option(
      "--machine", options.machine, command_line::kFileValue,
      {"The machine of this file, not of the isocnc.json", "La macchina di questo file, non dell'isocnc.json"});
  command_line::add_source_options(
      program, options.source,
      {"Read this, not the isocnc.json above a program", "Legge questo, non l'isocnc.json sopra un programma"});
  program.add_language(options.language,
                       {"en or it; else as the locale says", "en o it; altrimenti secondo il locale"});
  if (const auto status = program.answer(argc, argv)) return *status;
  return compare_files(std::move(options));
}

}  // namespace
}  // namespace isocnc::interpreter

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isodiff", isocnc::interpreter::diff_main, argc, argv);
}
