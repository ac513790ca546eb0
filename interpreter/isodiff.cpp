#include <array>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/command_line/run_values.h"
#include "interpreter/command_line/source_options.h"
#include "interpreter/comparison/comparison_text.h"
#include "interpreter/configuration/configurations.h"
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
  std::vector<std::string> ignored;
  std::string language;
  command_line::RunValues values;
  configuration::ConfigurationSource source;
  std::optional<std::string> machine;

  Language reader_language() const { return dialect::language_named(language).value_or(system::user_language()); }
  bool has_output_file() const { return !output.empty() && output != "-"; }
};

/// One of the two programs.
struct ComparedProgram {
  system::SourceFile source;
  const configuration::MachineConfiguration& machine;
};

constexpr Text kWrongTolerance{"--tolerance takes a plain number of mm above 0, such as 0.001, not {}",
                               "--tolerance vuole un numero semplice in mm maggiore di 0, come 0.001, non {}"};
constexpr Text kWrongIgnored{"--ignore takes feed, speed, time or comments, not {}",
                             "--ignore vuole feed, speed, time o comments, non {}"};
constexpr Text kOneStandardInput{"only one of the programs can come from standard input",
                                 "solo uno dei programmi può arrivare dallo standard input"};
constexpr Text kNoPage{"this isodiff writes no html: it was built without npm, which that takes",
                       "questo isodiff non scrive html: è stato compilato senza npm, che serve per questo"};
constexpr Text kPageToTerminal{"--format html writes a page, which a terminal does not show: name a file with --output",
                               "--format html scrive una pagina, che un terminale non mostra: indicare un file con "
                               "--output"};
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

plot::PlotSubject subject_of(const DiffCommandOptions& options, const std::string& file,
                             const ComparedProgram& program) {
  return {.name = is_standard_input(file) ? "<stdin>" : std::filesystem::path(file).filename().generic_string(),
          .program = program.source.text(),
          .home = program.machine.setup.home,
          .tools = plot::plot_tools(program.machine),
          .page = plot::kPageTemplate,
          .language = options.reader_language()};
}

void write_page(system::OutputFile& output, const DiffCommandOptions& options,
                const std::array<ComparedProgram, 2>& programs, const running::RunOptions& run,
                const comparison::ComparedRuns& runs, double tolerance) {
  const auto& [old_program, new_program] = programs;
  const plot::PlotSubject old_subject = subject_of(options, options.old_file, old_program);
  const plot::PlotSubject new_subject = subject_of(options, options.new_file, new_program);
  running::RunOptions old_options = run;
  running::RunOptions new_options = run;
  old_options.setup = old_program.machine.setup;
  new_options.setup = new_program.machine.setup;
  overlay::write_page(output, {old_subject, old_options, old_program.machine.timed},
                      {new_subject, new_options, new_program.machine.timed}, runs, tolerance);
}

comparison::RecordedRun record(const ComparedProgram& program, running::RunOptions run) {
  run.setup = program.machine.setup;
  return comparison::record(program.source.text(), run, program.machine.timed);
}

ExitStatus compare_files(DiffCommandOptions options) {
  using configuration::Configurations;
  Configurations found(options.source, options.reader_language());
  Configurations given({.file = options.machine, .none = !options.machine}, options.reader_language());
  std::vector<const configuration::MachineConfiguration*> machines;
  std::vector<std::filesystem::path> files;
  for (const std::string* const file : {&options.old_file, &options.new_file}) {
    const std::filesystem::path program = is_standard_input(*file) ? "" : *file;
    const configuration::Configuration& configuration = found.in_folder(program.parent_path());
    files.push_back(configuration.file);
    if (options.language.empty() && configuration.language)
      options.language = dialect::name_of(*configuration.language);
    machines.push_back(&(options.machine ? given.in_folder(program.parent_path()) : configuration).machine);
  }
  bool is_right = true;
  for (const Configurations* const read : {&found, &given})
    for (const std::string& mistake : read->mistakes(options.reader_language())) {
      std::cerr << mistake << '\n';
      is_right = false;
    }
  if (!is_right) return ExitStatus::Failure;
  const Language language = options.reader_language();
  running::RunOptions run;
  if (const auto problem = command_line::set_run_values(options.values, language, run)) {
    complain(*problem);
    return ExitStatus::Failure;
  }
  const auto comparison_options = read_comparison_options(options);
  if (!comparison_options || !can_write_page(options) || !is_apart(options, files)) return ExitStatus::Failure;
  if (is_standard_input(options.old_file) && is_standard_input(options.new_file)) {
    complain(kOneStandardInput.in(language));
    return ExitStatus::Failure;
  }
  auto sources = read_sources(options);
  if (!sources) return ExitStatus::Failure;
  const std::array<ComparedProgram, 2> programs{ComparedProgram{std::move((*sources)[0]), *machines[0]},
                                                ComparedProgram{std::move((*sources)[1]), *machines[1]}};
  const comparison::RecordedRun old_run = record(programs[0], run);
  const comparison::RecordedRun new_run = record(programs[1], run);
  const std::vector<comparison::BehaviorChange> changes = comparison::compare(old_run, new_run, *comparison_options);
  const comparison::ComparedRuns compared{old_run, new_run, changes};
  const bool is_written = write_result(options, [&](system::OutputFile& output) {
    if (options.format == "html") {
      write_page(output, options, programs, run, compared, comparison_options->tolerance);
    } else {
      output.write(options.format == "json" ? json_of(compared, language) : text_of(compared, language));
    }
  });
  if (!is_written) return ExitStatus::Failure;
  return changes.empty() ? ExitStatus::Success : ExitStatus::Findings;
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
