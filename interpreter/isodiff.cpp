#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "analyzer/check/jump_map.h"
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
#include "interpreter/diff_markdown.h"
#include "interpreter/diff_operand.h"
#include "interpreter/git/external_diff.h"
#include "interpreter/overlay/comparison_page.h"
#include "interpreter/plot/page_template.h"
#include "interpreter/plot/plot_tools.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/terminal.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/lists.h"
#include "interpreter/text/unicode.h"
#include "interpreter/threads/side_by_side.h"

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
  std::optional<std::vector<std::string>> git_arguments;  ///< All that follows --git.
  bool has_exit_code = false;                             ///< Of --git: whether the exit status tells of differences.

  Language reader_language() const { return dialect::language_named(language).value_or(system::user_language()); }
  bool has_output_file() const { return !output.empty() && output != "-"; }
  bool wants_color() const {
    if (color != "auto") return color == "always";
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets a variable.
    return !has_output_file() && system::is_terminal(system::kStandardOutput) && std::getenv("NO_COLOR") == nullptr;
  }
  comparison::TextStyle text_style() const {
    return {.language = reader_language(), .color = format == "text" && wants_color()};
  }
};

constexpr Text kWrongTolerance{"--tolerance takes a plain number of mm above 0, such as 0.001, not {}",
                               "--tolerance vuole un numero semplice in mm maggiore di 0, come 0.001, non {}"};
constexpr Text kWrongIgnored{"--ignore takes feed, speed, time or comments, not {}",
                             "--ignore vuole feed, speed, time o comments, non {}"};
constexpr Text kOneStandardInput{"only one of the programs can come from standard input",
                                 "solo uno dei programmi può arrivare dallo standard input"};
constexpr Text kNoScene{
    "{}: no setup is for this program, so contacts and material are not compared",
    "{}: nessun attrezzaggio è per questo programma, quindi contatti e materiale non si confrontano"};
constexpr Text kOtherConfigurations{
    "the programs have different configurations, {} and {}; --config takes one for both",
    "i programmi hanno configurazioni diverse, {} e {}; --config ne prende una per entrambi"};
constexpr Text kNone{"none", "nessuna"};
constexpr Text kGitArguments{"--git is followed by the arguments that git gives, 1, 7 or 9, and by no options",
                             "--git è seguito dagli argomenti che dà git, 1, 7 o 9, e da nessuna opzione"};
constexpr Text kGitFormat{"--git writes text or markdown, to standard output",
                          "--git scrive text o markdown, sullo standard output"};
constexpr Text kNoPage{"this isodiff writes no html: it was built without npm, which that takes",
                       "questo isodiff non scrive html: è stato compilato senza npm, che serve per questo"};
constexpr Text kOnePath{"--format html shows both programs on one path: name it by --vgpl instead of --all-paths",
                        "--format html mostra i due programmi su una sola via: indicarla con --vgpl invece di "
                        "--all-paths"};
constexpr Text kNoFindings{
    "--format html shows no contacts and no material: compare them by text or json, without html",
    "--format html non mostra né contatti né materiale: confrontarli con text o json, senza html"};
constexpr Text kPageToTerminal{"--format html writes a page, which a terminal does not show: name a file with --output",
                               "--format html scrive una pagina, che un terminale non mostra: indicare un file con "
                               "--output"};
constexpr Text kOverwrites{"{}: this would overwrite {}", "{}: così si sovrascriverebbe {}"};

void complain(std::string_view what) { command_line::complain("isodiff", what); }

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

/// Both programs as the command names them; none after an error message.
std::optional<DiffOperands> read_operands(const DiffCommandOptions& options) {
  DiffOperands operands;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& word = i == 0 ? options.old_file : options.new_file;
    auto read = diff_operand(word, options.reader_language());
    if (const auto* const problem = std::get_if<std::string>(&read)) {
      complain(fmt::format("{}: {}", system::generic_name(word), *problem));
      return std::nullopt;
    }
    operands[i] = std::move(std::get<DiffOperand>(read));
  }
  return operands;
}

/// Reads the texts of both programs; or says why one has none.
std::variant<std::array<system::SourceFile, 2>, std::string> read_sources(const DiffOperands& operands,
                                                                          Language language) {
  std::vector<system::SourceFile> sources;
  for (const DiffOperand& operand : operands) {
    auto opened = open(operand, language);
    if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened))
      return fmt::format("{}: {}", operand.name, problem->message);
    sources.push_back(std::move(std::get<system::SourceFile>(opened)));
  }
  return std::array{std::move(sources[0]), std::move(sources[1])};
}

/// Whether the output is none of the files that are read; false after an error message.
bool is_apart(const DiffCommandOptions& options, const DiffOperands& operands,
              const std::vector<std::filesystem::path>& configurations) {
  if (!options.has_output_file()) return true;
  std::vector<std::string> read = {operands[0].file, operands[1].file, options.machine.value_or("")};
  for (const std::filesystem::path& file : configurations) read.push_back(system::generic_name(file));
  const auto overwritten = std::find_if(read.begin(), read.end(), [&](const std::string& file) {
    return !file.empty() && system::is_same_file(file, options.output);
  });
  if (overwritten == read.end()) return true;
  complain(dialect::format(kOverwrites, options.reader_language(), options.output, *overwritten));
  return false;
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
  if (options.verify) {
    complain(kNoFindings.in(options.reader_language()));
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
  // Who leaves the pager of git wants no more; git would call another exit status the death of its diff.
  if (options.git_arguments && output->error() == EPIPE) return true;
  if (problem) complain(*problem);
  return !problem;
}

bool write_text(const DiffCommandOptions& options, std::string_view text) {
  return write_result(options, [text](system::OutputFile& output) { output.write(text); });
}

/// What one of the programs runs on, and what is shown of it.
struct ProgramMachine {
  std::unique_ptr<const configuration::Configuration> configuration;  ///< With the machine that is given, if one is.
  selection::Selection selection;
  std::shared_ptr<const verification::Scene> scene;  ///< Null unless it is to be verified.

  const configuration::MachineConfiguration& machine() const { return configuration->machine; }
};

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
std::optional<std::array<ProgramMachine, 2>> find_machines(DiffCommandOptions& options, const DiffOperands& operands,
                                                           configuration::Scenes& scenes,
                                                           configuration::Configurations& found) {
  configuration::Configurations given({.file = options.machine, .none = !options.machine}, options.reader_language());
  selection::SettingsFinder settings(found, {});
  std::vector<ProgramMachine> machines;
  for (const DiffOperand& operand : operands) {
    const std::filesystem::path folder = operand.place.parent_path();
    const configuration::Configuration& configuration = found.in_folder(folder);
    if (options.language.empty() && configuration.language)
      options.language = dialect::name_of(*configuration.language);
    auto surrounded = std::make_unique<configuration::Configuration>(configuration);
    if (options.machine) surrounded->machine = given.in_folder(folder).machine;
    machines.push_back({std::move(surrounded), settings.of(operand.place).selection, nullptr});
  }
  if (has_mistakes({found.mistakes(options.reader_language()), given.mistakes(options.reader_language())}))
    return std::nullopt;
  if (options.verify && !options.source.none) {
    for (std::size_t i = 0; i < machines.size(); ++i)
      machines[i].scene = scenes.of(*machines[i].configuration, operands[i].place);
  }
  if (has_mistakes({scenes.mistakes(options.reader_language())})) return std::nullopt;
  if (options.verify) {
    bool have_setups = true;
    for (std::size_t i = 0; i < machines.size(); ++i) {
      if (machines[i].scene && machines[i].scene->has_setup) continue;
      have_setups = false;
      complain(dialect::format(kNoScene, options.reader_language(), operands[i].name));
    }
    // The contacts of one of them alone would all be new or gone.
    if (!have_setups)
      for (ProgramMachine& machine : machines) machine.scene = nullptr;
  }
  return std::array{std::move(machines[0]), std::move(machines[1])};
}

/// Tells of two configurations: the machines may differ where the programs do not.
void tell_configurations(const DiffCommandOptions& options, const std::array<ProgramMachine, 2>& machines) {
  const std::filesystem::path& old_file = machines[0].configuration->file;
  const std::filesystem::path& new_file = machines[1].configuration->file;
  if (old_file == new_file) return;
  const Language language = options.reader_language();
  const auto shown = [&](const std::filesystem::path& file) {
    return file.empty() ? std::string(kNone.in(language)) : system::generic_name(file);
  };
  complain(dialect::format(kOtherConfigurations, language, shown(old_file), shown(new_file)));
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
  read.together = threads::on_all_processors;
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

/// What is shown in place of a comparison.
std::string shown_obstacle(std::string_view heading, std::string_view reason, const DiffCommandOptions& options) {
  const std::string text = text::printable(reason) + '\n';
  return options.format == "markdown" ? diff_markdown(heading, text) : text;
}

/// The result in the format of the command, and the exit status.
struct DiffResult {
  std::string text;
  ExitStatus status = ExitStatus::Success;
};

/// On the path that the values of the command lead along.
DiffResult compare_once(const revisions::RevisionPair& pair, const revisions::CompareOptions& compare_options,
                        const DiffCommandOptions& options) {
  const revisions::RevisionComparison compared = revisions::compare(pair, compare_options);
  const std::string text = options.format == "json" ? json_of(compared, options.reader_language())
                                                    : other_paths_text(compared, options.reader_language()) +
                                                          text_of(compared, options.text_style());
  return {text, compared.is_same() ? ExitStatus::Success : ExitStatus::Findings};
}

/// What has not been compared may differ: then the result is not known.
DiffResult compare_all_paths(const revisions::RevisionPair& pair, const revisions::CompareOptions& compare_options,
                             const DiffCommandOptions& options) {
  const revisions::PathComparison compared =
      revisions::compare_on_paths(pair, compare_options, set_registers(options), options.text_style());
  const ExitStatus same = compared.is_complete() ? ExitStatus::Success : ExitStatus::Failure;
  return {options.format == "json" ? json_of(compared) : text_of(compared, options.text_style()),
          compared.is_same() ? same : ExitStatus::Findings};
}

plot::PlotSubject subject_of(const DiffCommandOptions& options, const DiffOperand& operand,
                             const revisions::Revision& revision, const ProgramMachine& machine) {
  return {.name = operand.file.empty() ? operand.name : std::filesystem::path(operand.file).filename().generic_string(),
          .program = revision.text,
          .home = revision.setup.home,
          .tools = plot::plot_tools(machine.machine()),
          .page = plot::kPageTemplate,
          .language = options.reader_language()};
}

/// Both programs on one path each, as a page.
ExitStatus write_page(const DiffCommandOptions& options, const DiffOperands& operands,
                      const revisions::RevisionPair& pair, const std::array<ProgramMachine, 2>& machines,
                      const revisions::CompareOptions& compare_options) {
  const plot::PlotSubject old_subject = subject_of(options, operands[0], pair.old_revision, machines[0]);
  const plot::PlotSubject new_subject = subject_of(options, operands[1], pair.new_revision, machines[1]);
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

/// Writes what git shows of a file among others.
ExitStatus write_for_git(const DiffCommandOptions& options, std::string_view heading, std::string_view text) {
  const std::string_view gap = git::diffs_before() > 0 ? "\n" : "";
  const std::string title = options.format == "markdown" ? "" : text::printable(heading) + '\n';
  return write_text(options, fmt::format("{}{}{}", gap, title, text)) ? ExitStatus::Success : ExitStatus::Failure;
}

/// Compares two programs and writes what differs. `diff` is what git has asked, if it has.
ExitStatus compare_files(DiffCommandOptions options, const DiffOperands& operands,
                         const std::optional<git::ExternalDiff>& diff) {
  configuration::Configurations found(options.source, options.reader_language());
  configuration::Scenes scenes(options.reader_language());
  const auto machines = find_machines(options, operands, scenes, found);
  if (!machines) return ExitStatus::Failure;
  tell_configurations(options, *machines);
  const auto compare_options = read_compare_options(options);
  if (!compare_options || !can_write_page(options) ||
      !is_apart(options, operands, {(*machines)[0].configuration->file, (*machines)[1].configuration->file}))
    return ExitStatus::Failure;
  const Language language = options.reader_language();
  if (operands[0].is_standard_input() && operands[1].is_standard_input()) {
    complain(kOneStandardInput.in(language));
    return ExitStatus::Failure;
  }
  const std::string heading =
      diff ? diff->heading(language) : fmt::format("{} -> {}", operands[0].name, operands[1].name);
  const auto read = read_sources(operands, language);
  if (const auto* const problem = std::get_if<std::string>(&read)) {
    if (diff) return write_for_git(options, heading, shown_obstacle(heading, *problem, options));
    complain(*problem);
    return ExitStatus::Failure;
  }
  const auto& sources = std::get<std::array<system::SourceFile, 2>>(read);
  const auto revision = [&](std::size_t side) {
    const ProgramMachine& machine = (*machines)[side];
    return revisions::Revision{sources[side].text(), machine.machine().timed, machine.machine().setup,
                               machine.selection, machine.scene.get()};
  };
  const revisions::Revision old_revision = revision(0);
  const revisions::Revision new_revision = revision(1);
  const revisions::RevisionPair pair{old_revision, new_revision};
  if (options.format == "html") return write_page(options, operands, pair, *machines, *compare_options);
  DiffResult result = options.all_paths ? compare_all_paths(pair, *compare_options, options)
                                        : compare_once(pair, *compare_options, options);
  if (options.format == "markdown") result.text = diff_markdown(heading, result.text);
  if (!diff) return write_text(options, result.text) ? result.status : ExitStatus::Failure;
  const ExitStatus written = write_for_git(options, heading, result.text);
  const bool tells = options.has_exit_code && written == ExitStatus::Success && result.status == ExitStatus::Findings;
  return tells ? ExitStatus::Findings : written;
}

/// Compares the programs that the command names.
ExitStatus compare_named(const DiffCommandOptions& options) {
  const std::optional<DiffOperands> operands = read_operands(options);
  return operands ? compare_files(options, *operands, std::nullopt) : ExitStatus::Failure;
}

/// Compares what git gives. What cannot be compared is said in its place, since git would stop at another exit status.
ExitStatus compare_for_git(const DiffCommandOptions& options) {
  const Language language = options.reader_language();
  const std::optional<git::ExternalDiff> diff = git::read_external_diff(*options.git_arguments);
  const bool has_format = (options.format == "text" || options.format == "markdown") && options.output.empty();
  if (!diff || !has_format) {
    complain((diff ? kGitFormat : kGitArguments).in(language));
    return ExitStatus::Failure;
  }
  configuration::Configurations found(options.source, language);
  const auto operands = diff_operands(*diff, found.of(diff->new_version.path).lint.extensions, language);
  if (const auto* const both = std::get_if<DiffOperands>(&operands)) return compare_files(options, *both, diff);
  const std::string heading = diff->heading(language);
  return write_for_git(options, heading, shown_obstacle(heading, std::get<std::string>(operands), options));
}

/// Takes what follows --git from the arguments of the command: among it there may be names that begin with a minus.
std::optional<std::vector<std::string>> take_git_arguments(int& argc, char** argv) {
  const auto is_end = [](std::string_view word) { return word == "--git" || word == "--"; };
  const int at = static_cast<int>(std::find_if(argv + std::min(argc, 1), argv + argc, is_end) - argv);
  if (at == argc || argv[at] == std::string_view("--")) return std::nullopt;
  std::vector<std::string> taken(argv + at + 1, argv + argc);
  argc = at + 1;
  return taken;
}

ExitStatus diff_main(int argc, char** argv) {
  DiffCommandOptions options;
  bool is_for_git = false;
  options.git_arguments = take_git_arguments(argc, argv);
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
                      {"REV:FILE is the file of a revision in git, HEAD:part.iso. A file of this name is meant first.",
                       "REV:FILE è il file di una revisione in git, HEAD:part.iso. Un file con questo nome viene "
                       "prima."},
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
  const command_line::ProgramOption programs[] = {
      program.add_option(
          "OLD", options.old_file, {" ", " "},
          {"The old program, REV:FILE of git, or - for stdin", "Il vecchio programma, REV:FILE di git, o - per stdin"}),
      program.add_option("NEW", options.new_file, {" ", " "},
                         {"The new program, in the same ways", "Il nuovo programma, negli stessi modi"})};
  program.add_option(
      "--tolerance", options.tolerance, {"MM", "MM"},
      {"What is this near is the same (else 0.001)", "Ciò che è vicino così è lo stesso (altrimenti 0.001)"});
  program.add_choice("--format", options.format, {"text", "json", "html", "markdown"}, {"FORMAT", "FORMATO"},
                     {"text, json, html or markdown (else text)", "text, json, html o markdown (altrimenti text)"});
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
  const auto git = program.add_flag(
      "--git", is_for_git,
      {"As git calls its diff drivers; the last option", "Come git chiama i driver di diff; è l'ultima opzione"});
  program
      .add_flag("--exit-code", options.has_exit_code,
                {"With --git: exit with 1 if they differ", "Con --git: stato 1 se differiscono"})
      .needs(git);
  program.add_language(options.language,
                       {"en or it; else as the locale says", "en o it; altrimenti secondo il locale"});
  if (!options.git_arguments)
    for (const auto& operand : programs) operand.required();
  if (const auto status = program.answer(argc, argv)) return *status;
  return options.git_arguments ? compare_for_git(options) : compare_named(options);
}

}  // namespace
}  // namespace isocnc::interpreter

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isodiff", isocnc::interpreter::diff_main, argc, argv);
}
