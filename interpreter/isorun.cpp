#include <filesystem>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "analyzer/formats/renderers.h"
#include "analyzer/formats/way_errors.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/verified.h"
#include "analyzer/transforming/transform.h"
#include "interpreter/command_line/material_values.h"
#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/command_line/progress.h"
#include "interpreter/command_line/run_values.h"
#include "interpreter/command_line/source_options.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/outline/outline_program.h"
#include "interpreter/plot/page_template.h"
#include "interpreter/plot/plot_tools.h"
#include "interpreter/restart/restart.h"
#include "interpreter/run_report.h"
#include "interpreter/running/error_message.h"
#include "interpreter/running/runner.h"
#include "interpreter/sheet_report.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/terminal.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_command.h"
#include "interpreter/verification/verification_report.h"

namespace isocnc::interpreter {
namespace {

using namespace dialect::literals;
using dialect::Language;
using dialect::Text;

using command_line::read_count;
using command_line::read_decimal;
using system::ExitStatus;

/// The options of the command line as text. Numbers are parsed later, when the language of error messages is known.
struct RunCommandOptions {
  std::string file;
  std::string trace;
  std::string samples;
  std::string sample_seconds = "0.01";
  std::string plot;
  std::string sheet;
  std::string stock_out;
  command_line::MaterialValues material;
  bool json = false;
  bool verify = false;
  std::string language;
  command_line::RunValues values;
  std::string until;
  std::optional<std::string> restart_at;
  std::string output;
  std::optional<std::string> clearance;
  std::optional<std::string> approach_feed;
  std::optional<std::string> outline;
  std::optional<std::string> tool;
  std::optional<std::string> lift;
  configuration::ConfigurationSource source;
  std::optional<std::string> machine;
  ToolCommandOptions tools;

  Language reader_language() const { return dialect::language_named(language).value_or(system::user_language()); }
  bool reads_stdin() const { return file == "-"; }
  /// Whether a program is written instead of a report.
  bool makes_program() const { return restart_at || outline || tool || lift; }
  /// The path of the program file for the system.
  std::string program_file() const { return reads_stdin() ? "/dev/stdin" : file; }
  std::string shown_file() const { return reads_stdin() ? "<stdin>" : system::generic_name(file); }
};

void complain(std::string_view what) { command_line::complain("isorun", what); }

constexpr Text kWrongUntil{"--until takes a line, counted from 1, not {}",
                           "--until vuole una riga, contata da 1, non {}"};
constexpr Text kWrongRestart{"--restart-at takes a line, counted from 1, not {}",
                             "--restart-at vuole una riga, contata da 1, non {}"};
constexpr Text kWrongClearance{"--clearance takes a plain number of mm, such as 30, not {}",
                               "--clearance vuole un numero semplice in mm, come 30, non {}"};
constexpr Text kWrongApproachFeed{
    "--approach-feed takes a plain number of mm/min above 0, such as 1000, not {}",
    "--approach-feed vuole un numero semplice in mm/min maggiore di 0, come 1000, non {}"};
constexpr Text kWrongOutline{"--outline takes rectangle, hull or path, not {}",
                             "--outline vuole rectangle, hull o path, non {}"};
constexpr Text kWrongTool{"--tool takes a tool such as T102003, or with the line of its M06 T102003@40, not {}",
                          "--tool vuole un utensile come T102003, o con la riga della sua M06 T102003@40, non {}"};
constexpr Text kNotMounted{"{} is mounted by no M06 that the run comes to",
                           "nessuna M06 a cui arriva l'esecuzione monta {}"};
constexpr Text kNotMountedThere{"{} is not mounted there, but by the M06 of: line {}",
                                "{} non viene montato lì, ma dalla M06 di: riga {}"};
constexpr Text kMountedTwice{"{0} is mounted more than once, by the M06 of lines {1}; --tool {0}@{2} means the first",
                             "{0} viene montato più di una volta, dalle M06 delle righe {1}; --tool {0}@{2} intende "
                             "la prima"};
constexpr Text kWrongLift{"--lift takes a plain number of mm above 0, such as 50, not {}",
                          "--lift vuole un numero semplice in mm maggiore di 0, come 50, non {}"};
constexpr Text kNotLifted{"the raised program is not written: {}", "il programma alzato non viene scritto: {}"};
constexpr Text kOfMadePrograms{"{} goes with --restart-at, --tool, --lift or --outline",
                               "{} va con --restart-at, --tool, --lift o --outline"};
constexpr Text kNoProgram{"--import-tools, --export-tools and --new-machine run no program, such as {}",
                          "--import-tools, --export-tools e --new-machine non eseguono programmi, come {}"};
constexpr Text kCutsNothing{"there is no outline: the program has no feed move with a tool",
                            "non c'è un contorno: il programma non ha movimenti di lavoro con un utensile"};
constexpr Text kOperationHits{"{} alone is not written: on its way, {}",
                              "{} da solo non viene scritto: lungo il percorso, {}"};
constexpr Text kCutsNoMaterial{"{} goes with --verify, --stock-out or --plot FILE.html, which cut the stock",
                               "{} va con --verify, --stock-out o --plot FILE.html, che tagliano il grezzo"};
constexpr Text kNoWayAround{"no outline is written: on its way, {}; --clearance sets another height",
                            "il contorno non viene scritto: lungo il percorso, {}; --clearance sceglie un'altra "
                            "quota"};
constexpr Text kOverwrites{"this would overwrite {}", "così si sovrascriverebbe {}"};
constexpr Text kProgram{"the program", "il programma"};
constexpr Text kConfiguration{"the configuration", "la configurazione"};
constexpr Text kMachineFile{"the machine's file", "il file della macchina"};
constexpr Text kOneFile{"{} and {} would both be written there", "ci scriverebbero sia {} sia {}"};
constexpr Text kStandardOutput{"standard output", "lo standard output"};
constexpr Text kWrongSeconds{"--dt takes a plain number of seconds, from 0.0001, such as 0.01, not {}",
                             "--dt vuole un numero semplice di secondi, da 0.0001, come 0.01, non {}"};
constexpr Text kWrongPlot{"--plot writes a file whose name ends in .svg or .html, unlike {}",
                          "--plot scrive un file il cui nome finisce in .svg o .html, non come {}"};
constexpr Text kWrongSheet{"--sheet writes a file whose name ends in .html or .pdf, unlike {}",
                           "--sheet scrive un file il cui nome finisce in .html o .pdf, non come {}"};
constexpr Text kNoPage{
    "this isorun draws no {}: it was built without npm, which --plot FILE.html takes; --plot FILE.svg works",
    "questo isorun non disegna {}: è stato compilato senza npm, che serve per --plot FILE.html; --plot FILE.svg "
    "funziona"};
constexpr Text kWrongStock{"--stock-out writes a file whose name ends in .stl or .stock, unlike {}",
                           "--stock-out scrive un file il cui nome finisce in .stl o .stock, non come {}"};
constexpr Text kEmptyWindow{"in the window {} there is nothing of the stock, which reaches from X{} Y{} to X{} Y{}",
                            "nella finestra {} non c'è nulla del grezzo, che va da X{} Y{} a X{} Y{}"};
constexpr Text kPartOfAStock{
    "{}: with --window only a part of the blank is cut, and a later setup would take it for all of it; write an .stl, "
    "or leave --window out",
    "{}: con --window si taglia solo una parte del grezzo, e un attrezzaggio successivo la prenderebbe per tutto; "
    "scrivere un .stl, o togliere --window"};
constexpr Text kTooFine{
    "a resolution of {} mm takes more memory than there is for the stock; {:.2g} mm would fit",
    "una risoluzione di {} mm occupa più memoria di quella prevista per il grezzo; con {:.2g} mm ci "
    "sta"};
constexpr Text kNoStock{"{} takes a setup with a stock (docs/verification.md), and {} has none",
                        "{} vuole un attrezzaggio con un grezzo (docs/it/verifica.md), e {} non ne ha"};
constexpr Text kOneStandardOutput{"--trace - and --samples - both take standard output",
                                  "--trace - e --samples - vogliono tutti e due lo standard output"};

/// Prints an error and returns none.
std::nullopt_t refuse(const Text& why, std::string_view value, const RunCommandOptions& options) {
  complain(dialect::format(why, options.reader_language(), value));
  return std::nullopt;
}

/// The options of the run; none after an error message.
std::optional<running::RunOptions> read_run_options(const RunCommandOptions& options) {
  running::RunOptions run;
  if (const auto problem = command_line::set_run_values(options.values, options.reader_language(), run)) {
    complain(*problem);
    return std::nullopt;
  }
  if (!options.until.empty()) {
    const auto until = read_count(options.until, std::numeric_limits<std::size_t>::max());
    if (!until) return refuse(kWrongUntil, options.until, options);
    run.until = *until - 1;
  }
  return run;
}

/// The outputs and their destinations; none after an error message.
std::optional<RunOutputs> read_outputs(const RunCommandOptions& options) {
  constexpr double kShortest = 1e-4;
  RunOutputs outputs{.trace = options.trace,
                     .samples = options.samples,
                     .plot = options.plot,
                     .json = options.json,
                     .stock_out = options.stock_out,
                     .program_name = options.shown_file(),
                     .language = options.reader_language()};
  const auto seconds = read_decimal(options.sample_seconds);
  if (!seconds || !(*seconds >= kShortest)) return refuse(kWrongSeconds, options.sample_seconds, options);
  outputs.sample_seconds = *seconds;
  const auto format = plot::plot_format(options.plot);
  if (!options.plot.empty() && !format) return refuse(kWrongPlot, options.plot, options);
  if (format == plot::PlotFormat::Html && plot::kPageTemplate.empty()) return refuse(kNoPage, options.plot, options);
  if (!options.sheet.empty() && !is_sheet_name(options.sheet)) return refuse(kWrongSheet, options.sheet, options);
  if (!options.stock_out.empty() && !options.stock_out.ends_with(".stl") && !options.stock_out.ends_with(".stock"))
    return refuse(kWrongStock, options.stock_out, options);
  if (const auto mistake = set_material_values(options.material, options.reader_language(), outputs.material)) {
    complain(*mistake);
    return std::nullopt;
  }
  if (options.material.window && options.stock_out.ends_with(".stock"))
    return refuse(kPartOfAStock, options.stock_out, options);
  // Cutting takes longer than the rest, and nothing else shows it.
  const bool shows_cuts = options.verify || !options.stock_out.empty() || format == plot::PlotFormat::Html;
  if (!shows_cuts && options.material.resolution) return refuse(kCutsNoMaterial, "--resolution", options);
  if (!shows_cuts && options.material.window) return refuse(kCutsNoMaterial, "--window", options);
  outputs.material.is_cut = shows_cuts || !options.sheet.empty();
  if (options.trace == "-" && options.samples == "-") return refuse(kOneStandardOutput, "", options);
  return outputs;
}

/// How a program that is written comes near the work.
struct ApproachValues {
  std::optional<double> clearance;  ///< mm.
  double feed = 1000;               ///< mm/min.
};

/// None after an error message.
std::optional<ApproachValues> read_approach(const RunCommandOptions& options) {
  ApproachValues read;
  if (options.clearance) {
    read.clearance = read_decimal(*options.clearance);
    if (!read.clearance) return refuse(kWrongClearance, *options.clearance, options);
  }
  if (options.approach_feed) {
    const auto feed = read_decimal(*options.approach_feed);
    if (!feed || !(*feed > 0)) return refuse(kWrongApproachFeed, *options.approach_feed, options);
    read.feed = *feed;
  }
  return read;
}

/// The name of the program in the comments of those that are made of it.
std::string name_in_comments(const RunCommandOptions& options) {
  return options.reads_stdin() ? "<stdin>" : std::filesystem::path(options.file).filename().generic_string();
}

/// The operation that --tool means.
struct ToolChoice {
  execution::ToolCode tool;
  std::optional<std::size_t> change;  ///< The line of its M06, from 0.
};

/// None after an error message.
std::optional<ToolChoice> read_tool(const RunCommandOptions& options) {
  constexpr std::size_t kLargest = 999'999;
  std::string_view word = *options.tool;
  ToolChoice choice;
  if (const std::size_t sign = word.find('@'); sign != std::string_view::npos) {
    const auto line = read_count(word.substr(sign + 1), std::numeric_limits<std::size_t>::max());
    if (!line) return refuse(kWrongTool, *options.tool, options);
    choice.change = *line - 1;
    word = word.substr(0, sign);
  }
  if (word.starts_with('T') || word.starts_with('t')) word.remove_prefix(1);
  const auto number = read_count(word, kLargest);
  if (!number) return refuse(kWrongTool, *options.tool, options);
  choice.tool = execution::tool_code(static_cast<int>(*number));
  return choice;
}

/// The options of a restart, or of an operation alone; none after an error message.
std::optional<restart::RestartOptions> read_restart_options(const RunCommandOptions& options,
                                                            const running::RunOptions& run) {
  restart::RestartOptions restart;
  if (options.restart_at) {
    const auto line = read_count(*options.restart_at, std::numeric_limits<std::size_t>::max());
    if (!line) return refuse(kWrongRestart, *options.restart_at, options);
    restart.line = *line - 1;
  }
  const std::optional<ApproachValues> approach = read_approach(options);
  if (!approach) return std::nullopt;
  restart.run = run;
  restart.clearance = approach->clearance;
  restart.approach_feed = approach->feed;
  restart.name = name_in_comments(options);
  restart.language = options.reader_language();
  return restart;
}

/// The options of the outline; none after an error message.
std::optional<outline::OutlineOptions> read_outline_options(const RunCommandOptions& options,
                                                            const running::RunOptions& run) {
  const auto shape = outline::outline_shape(*options.outline);
  if (!shape) return refuse(kWrongOutline, *options.outline, options);
  const std::optional<ApproachValues> approach = read_approach(options);
  if (!approach) return std::nullopt;
  outline::OutlineOptions outline;
  outline.run = run;
  outline.shape = *shape;
  outline.height = approach->clearance;
  outline.feed = approach->feed;
  outline.name = name_in_comments(options);
  outline.language = options.reader_language();
  return outline;
}

/// Prints a finding in the format of compilers.
void print_finding(const RunCommandOptions& options, std::size_t line, dialect::DiagnosticId id,
                   dialect::Severity severity, std::string_view message) {
  std::cerr << text::printable(fmt::format("{}:{}: {}: {} [{}]", options.shown_file(), line + 1,
                                           dialect::severity_name(severity, options.reader_language()), message,
                                           dialect::definition(id).code))
            << '\n';
}

void print_error(const RunCommandOptions& options, const running::RunResult& result) {
  print_finding(options, result.line, result.error.id, dialect::definition(result.error.id).severity,
                running::error_message(result, options.reader_language()));
}

/// A program, and what is to be said about it.
struct CheckedRun {
  std::string_view program;
  check::Report report;
  const rules::CheckSetup& setup;
  const std::optional<verification::Certificate>& certificate;
};

/// Prints those findings that the summary does not tell, and those that make the run fail.
void print_findings(const RunCommandOptions& options, const CheckedRun& run) {
  syntax::LineFinder lines(run.program);
  for (const check::LocatedFinding& located : run.report.findings) {
    const bool is_in_summary = !dialect::definition(located.finding.id).is_reported_by_runs();
    if (located.finding.id == "not-verified"_diag) continue;  // The error that it is about is printed.
    if (is_in_summary && located.severity() != dialect::Severity::Error) continue;
    print_finding(options, located.line, located.finding.id, located.severity(),
                  formats::message_of(located, run.report, lines.line(located.line), options.reader_language()));
  }
}

/// A buffer for findings as text.
class FindingsText final : public formats::Output {
 public:
  std::string take() {
    flush();
    return std::move(text_);
  }

 protected:
  void write(std::string_view text) override { text_ += text; }

 private:
  std::string text_;
};

/// The findings in the words of isolint, as text or JSON.
std::string shown_findings(const RunCommandOptions& options, const CheckedRun& run) {
  const auto renderer = formats::make_renderer(options.json ? "json" : "text", {.language = options.reader_language()});
  FindingsText output;
  renderer->begin(output.buffer());
  renderer->file({options.shown_file(), run.program, run.report, run.setup}, output);
  renderer->end(output.buffer());
  if (run.certificate && !options.json) output.buffer() += in_words(*run.certificate, options.reader_language()) + '\n';
  return output.take();
}

/// A file that the run reads or writes, with its name for users.
struct NamedFile {
  std::string path;
  std::string_view what;
};

/// All files to be written, including standard output, which may be a file.
std::vector<NamedFile> files_written(const RunCommandOptions& options) {
  std::vector<NamedFile> files;
  const auto add = [&](const std::string& file, std::string_view option) {
    if (!file.empty() && file != "-") files.push_back({file, option});
  };
  add(options.trace, "--trace");
  add(options.samples, "--samples");
  add(options.plot, "--plot");
  add(options.sheet, "--sheet");
  add(options.stock_out, "--stock-out");
  add(options.output, "--output");
  const bool leaves_standard_output_alone = options.makes_program() && files.size() == 1;
  if (!leaves_standard_output_alone) files.push_back({"/dev/stdout", kStandardOutput.in(options.reader_language())});
  return files;
}

/// Whether no file is both read and written or written twice; false after an error message.
bool files_are_apart(const RunCommandOptions& options, const std::filesystem::path& configuration) {
  const Language language = options.reader_language();
  const NamedFile read[] = {{options.program_file(), kProgram.in(language)},
                            {system::generic_name(configuration), kConfiguration.in(language)},
                            {options.machine.value_or(""), kMachineFile.in(language)}};
  const std::vector<NamedFile> written = files_written(options);
  const auto refuse_file = [&](const NamedFile& file, const Text& why, auto... what) {
    complain(fmt::format("{}: {}", file.path, dialect::format(why, language, what...)));
    return false;
  };
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const NamedFile& each : read)
      if (system::is_same_file(each.path, written[i].path)) return refuse_file(written[i], kOverwrites, each.what);
    for (std::size_t k = i + 1; k < written.size(); ++k)
      if (system::is_same_file(written[i].path, written[k].path))
        return refuse_file(written[i], kOneFile, written[i].what, written[k].what);
  }
  return true;
}

/// The machine and the isocnc.json that have been read for the program.
struct RunSettings {
  configuration::MachineConfiguration machine;
  std::filesystem::path configuration;  ///< Path of the isocnc.json; empty without one.
  selection::Selection selection;
  rules::CheckSetup setup;
  std::shared_ptr<const verification::Scene> scene;  ///< Null if nothing is known of what surrounds the program.
};

/// Runs the program with a progress bar on the terminal.
running::RunResult run_with_progress(std::string_view program, running::RunOptions options, const RunOutputs& outputs,
                                     RunReport& report) {
  constexpr std::size_t kPace = 4096;  // Bytes: asking the clock on every line would cost more than the line.
  const bool shares_terminal =
      (outputs.trace == "-" || outputs.samples == "-") && system::is_terminal(system::kStandardOutput);
  command_line::Progress progress(shares_terminal ? nullptr : command_line::terminal_writer(), program.size());
  std::size_t progress_bytes = 0;
  options.before_block = [&](const running::Block& block) {
    report.take(block);
    const auto reached = static_cast<std::size_t>(block.tree.text.data() - program.data());
    if (reached >= progress_bytes + kPace) progress.add(reached - std::exchange(progress_bytes, reached));
  };
  return run(program, options, [&](const running::Event& event) { report.take(event); });
}

bool has_error(const check::Report& report) {
  return std::any_of(report.findings.begin(), report.findings.end(), [](const check::LocatedFinding& located) {
    return located.severity() == dialect::Severity::Error;
  });
}

ExitStatus run_program(std::string_view program, const RunCommandOptions& options,
                       const running::RunOptions& run_options, const RunOutputs& outputs, const RunSettings& settings) {
  RunReport report(outputs, settings.machine.timed);
  bool has_errors = false;
  if (report.is_ready()) {
    const running::RunResult result = run_with_progress(program, run_options, outputs, report);
    verification::VerifiedRun verified = report.end_run(program, result);
    selection::add_other_paths(verified, program);
    const CheckedRun checked{program, selection::shown_run_report(verified.outcome, program, settings.selection),
                             settings.setup, verified.certificate};
    const bool shows_with_summary = options.verify && report.has_summary();
    report.finish(result, verified, shows_with_summary ? shown_findings(options, checked) : "");
    if (options.verify && !shows_with_summary) std::cerr << shown_findings(options, checked);
    if (!options.verify) print_findings(options, checked);
    const bool is_stopped = result.ending == running::Ending::Error;
    if (is_stopped) print_error(options, result);
    has_errors = is_stopped || has_error(checked.report);
  }
  for (const std::string& problem : report.problems()) complain(problem);
  if (!report.problems().empty()) return ExitStatus::Failure;
  return has_errors ? ExitStatus::Findings : ExitStatus::Success;
}

/// Writes a program to where --output says; false after an error message.
bool write_made(std::string_view program, const RunCommandOptions& options) {
  const bool is_file = !options.output.empty() && options.output != "-";
  std::optional<system::OutputFile> output;
  if (is_file) {
    output.emplace(std::filesystem::path(options.output));
  } else {
    output.emplace(system::kStandardOutput);
  }
  output->write(program);
  const std::optional<std::string> problem =
      system::commit(*output, is_file ? options.output : "<stdout>", options.reader_language());
  if (problem) complain(*problem);
  return !problem;
}

/// Writes the setup sheet; false after an error message.
bool write_sheet(const system::SourceFile& source, const RunCommandOptions& options,
                 const running::RunOptions& run_options, const RunSettings& settings) {
  const std::string marked =
      source.has_byte_order_mark() ? fmt::format("{}{}", system::kByteOrderMark, source.text()) : "";
  const sheet::SheetSubject subject{.text = source.text(),
                                    .name = name_in_comments(options),
                                    .bytes = marked.empty() ? source.text() : std::string_view(marked),
                                    .run = run_options,
                                    .machine = settings.machine,
                                    .scene = settings.scene.get(),
                                    .language = options.reader_language()};
  system::OutputFile output{std::filesystem::path(options.sheet)};
  output.write(sheet_file(options.sheet, subject, settings.setup, settings.selection));
  const std::optional<std::string> problem = system::commit(output, options.sheet, options.reader_language());
  if (problem) complain(*problem);
  return !problem;
}

/// Writes a program that holds parts of the original, with its byte-order mark.
ExitStatus write_part(std::string_view program, const system::SourceFile& source, const RunCommandOptions& options) {
  const std::string_view mark = source.has_byte_order_mark() ? system::kByteOrderMark : "";
  return write_made(fmt::format("{}{}", mark, program), options) ? ExitStatus::Success : ExitStatus::Failure;
}

/// Says why there is no restart.
ExitStatus refuse(const restart::RestartRefusal& refusal, const RunCommandOptions& options) {
  if (refusal.obstacle == restart::RestartObstacle::ProgramError) {
    print_error(options, refusal.run);
    return ExitStatus::Findings;
  }
  complain(fmt::format("{}: {}", options.shown_file(), message(refusal, options.reader_language())));
  return refusal.obstacle == restart::RestartObstacle::NoSuchLine ? ExitStatus::Failure : ExitStatus::Findings;
}

formats::TrialMachine trial_machine(const RunCommandOptions& options, const RunSettings& settings) {
  return {settings.machine.timed, settings.scene.get(), settings.selection, options.reader_language()};
}

ExitStatus restart(const system::SourceFile& source, const RunCommandOptions& options,
                   const restart::RestartOptions& restart_options, const RunSettings& settings) {
  const auto made = restart::restart_program(source.text(), restart_options);
  const auto* const program = std::get_if<std::string>(&made);
  if (program == nullptr) return refuse(std::get<restart::RestartRefusal>(made), options);
  const std::string obstacle =
      obstacle_on_the_way_there(*program, source.text(), restart_options.run, trial_machine(options, settings));
  if (obstacle.empty()) return write_part(*program, source, options);
  complain(fmt::format("{}: {}", options.shown_file(),
                       formats::restart_hits(restart_options.line, obstacle, options.reader_language())));
  return ExitStatus::Findings;
}

ExitStatus write_operation(const system::SourceFile& source, const RunCommandOptions& options,
                           const restart::RestartOptions& restart_options, const ToolChoice& choice,
                           const RunSettings& settings) {
  const auto made = restart::operation_program(source.text(), restart_options, choice.tool, choice.change);
  const Language language = options.reader_language();
  const std::string tool = running::tool_name(choice.tool);
  if (const auto* const program = std::get_if<std::string>(&made)) {
    const std::string obstacle =
        obstacle_on_the_way_there(*program, source.text(), restart_options.run, trial_machine(options, settings));
    if (obstacle.empty()) return write_part(*program, source, options);
    complain(fmt::format("{}: {}", options.shown_file(), dialect::format(kOperationHits, language, tool, obstacle)));
    return ExitStatus::Findings;
  }
  const auto& refusal = std::get<restart::OperationRefusal>(made);
  if (refusal.restart) return refuse(*refusal.restart, options);
  std::string lines;
  for (const std::size_t line : refusal.changes) lines += fmt::format("{}{}", lines.empty() ? "" : ", ", line + 1);
  std::string why;
  if (refusal.changes.empty()) {
    why = dialect::format(kNotMounted, language, tool);
  } else if (choice.change) {
    why = dialect::format(kNotMountedThere, language, tool, lines);
  } else {
    why = dialect::format(kMountedTwice, language, tool, lines, refusal.changes.front() + 1);
  }
  complain(fmt::format("{}: {}", options.shown_file(), why));
  return ExitStatus::Failure;
}

/// What would stop a program, or be hit on its way: the first error, for an operator; empty for none.
std::string obstacle_on_the_way(std::string_view program, const RunCommandOptions& options,
                                const running::RunOptions& run_options, const RunSettings& settings) {
  const std::vector<formats::WayError> errors =
      errors_on_the_way(program, run_options, trial_machine(options, settings), true);
  return errors.empty() ? "" : errors.front().message;
}

ExitStatus write_outline(const system::SourceFile& source, const RunCommandOptions& options,
                         const outline::OutlineOptions& outline_options, const RunSettings& settings) {
  const Language language = options.reader_language();
  const auto made = outline::outline_program(source.text(), outline_options);
  if (const auto* const refusal = std::get_if<outline::OutlineRefusal>(&made)) {
    if (refusal->run.ending == running::Ending::Error) {
      print_error(options, refusal->run);
    } else {
      complain(fmt::format("{}: {}", options.shown_file(), kCutsNothing.in(language)));
    }
    return ExitStatus::Findings;
  }
  const auto& program = std::get<std::string>(made);
  const std::string obstacle = obstacle_on_the_way(program, options, outline_options.run, settings);
  if (!obstacle.empty()) {
    complain(fmt::format("{}: {}", options.shown_file(), dialect::format(kNoWayAround, language, obstacle)));
    return ExitStatus::Findings;
  }
  return write_made(program, options) ? ExitStatus::Success : ExitStatus::Failure;
}

/// Writes the same program higher by so many mm.
ExitStatus write_lifted(const system::SourceFile& source, const RunCommandOptions& options, double lift,
                        const running::RunOptions& run_options, const RunSettings& settings) {
  const Language language = options.reader_language();
  const transforming::Transformation up{.movement = transforming::Movement::Shift, .place = {0, 0, lift}};
  const auto made = transforming::transform(source.text(), up, settings.machine.setup, language);
  if (const auto* const refusal = std::get_if<transforming::TransformationRefusal>(&made)) {
    complain(fmt::format("{}:{}: {}", options.shown_file(), refusal->line + 1,
                         dialect::format(kNotLifted, language, refusal->message(language))));
    return ExitStatus::Findings;
  }
  const auto& program = std::get<std::string>(made);
  const std::string obstacle = obstacle_on_the_way(program, options, run_options, settings);
  if (!obstacle.empty()) {
    complain(fmt::format("{}: {}", options.shown_file(), dialect::format(kNotLifted, language, obstacle)));
    return ExitStatus::Findings;
  }
  return write_part(program, source, options);
}

/// The settings of the run; none, after an error message, if a file is invalid. The program's configuration also sets
/// the language, unless the command line does.
std::optional<RunSettings> find_settings(RunCommandOptions& options) {
  using configuration::Configurations;
  const Language language = options.reader_language();
  Configurations found(options.source, language);
  Configurations given({.file = options.machine, .none = !options.machine}, language);
  const std::filesystem::path program = options.reads_stdin() ? "" : options.file;
  selection::SettingsFinder finder(found, {});
  const configuration::Configuration& configuration = found.in_folder(program.parent_path());
  const configuration::Configuration& machine =
      options.machine ? given.in_folder(program.parent_path()) : configuration;
  if (options.language.empty() && configuration.language) options.language = dialect::name_of(*configuration.language);
  bool is_right = true;
  for (const Configurations* read : {&found, &given})
    for (const std::string& mistake : read->mistakes(options.reader_language())) {
      std::cerr << mistake << '\n';
      is_right = false;
    }
  if (!is_right) return std::nullopt;
  const selection::ProgramSettings& settings = finder.of(program);
  configuration::Configuration surrounded = configuration;
  surrounded.machine = machine.machine;
  configuration::Scenes scenes(options.reader_language());
  RunSettings found_settings{machine.machine, configuration.file, settings.selection, settings.setup,
                             options.source.none ? nullptr : scenes.of(surrounded, program)};
  const std::vector<std::string> mistakes = scenes.mistakes(options.reader_language());
  for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
  return mistakes.empty() ? std::optional(std::move(found_settings)) : std::nullopt;
}

plot::PlotSubject plot_subject(std::string_view program, const configuration::MachineConfiguration& machine,
                               const RunCommandOptions& options) {
  return {.name = std::filesystem::path(options.shown_file()).filename().generic_string(),
          .program = program,
          .home = machine.setup.home,
          .tools = plot::plot_tools(machine),
          .page = plot::kPageTemplate,
          .language = options.reader_language()};
}

/// Whether there is a stock for the options that take one, which fits the memory; false after an error message.
bool can_cut(const RunCommandOptions& options, const RunOutputs& outputs) {
  if (options.stock_out.empty() && !options.material.resolution && !options.material.window) return true;
  std::optional<removal::Workpiece> workpiece;
  verification::MaterialOptions material = outputs.material;
  material.is_cut = true;
  if (outputs.subject.scene) workpiece = verification::workpiece_of(*outputs.subject.scene, {}, material);
  const Language language = options.reader_language();
  if (!workpiece) {
    const std::string_view option = options.material.resolution ? "--resolution"
                                    : options.material.window   ? "--window"
                                                                : "--stock-out";
    complain(dialect::format(kNoStock, language, option, options.shown_file()));
    return false;
  }
  if (options.material.window && stock::bounds_of(workpiece->blank, workpiece->window).isEmpty()) {
    const solids::BoundingBox blank = stock::bounds_of(workpiece->blank);
    complain(dialect::format(kEmptyWindow, language, *options.material.window, blank.min().x(), blank.min().y(),
                             blank.max().x(), blank.max().y()));
    return false;
  }
  const std::optional<double> fitting = verification::coarser_spacing(*workpiece);
  if (fitting) complain(dialect::format(kTooFine, language, workpiece->spacing, *fitting));
  return !fitting;
}

ExitStatus run_file(RunCommandOptions options) {
  const std::optional<RunSettings> found = find_settings(options);
  if (!found) return ExitStatus::Failure;
  const configuration::MachineConfiguration& machine = found->machine;
  const Language language = options.reader_language();
  std::optional<running::RunOptions> run_options = read_run_options(options);
  if (!run_options) return ExitStatus::Failure;
  run_options->setup = machine.setup;
  std::optional<RunOutputs> outputs = read_outputs(options);
  if (!outputs) return ExitStatus::Failure;
  std::optional<restart::RestartOptions> restart_options;
  if (options.restart_at || options.tool) {
    restart_options = read_restart_options(options, *run_options);
    if (!restart_options) return ExitStatus::Failure;
    restart_options->machine = machine.timed;
  }
  std::optional<ToolChoice> operation;
  if (options.tool) {
    operation = read_tool(options);
    if (!operation) return ExitStatus::Failure;
  }
  std::optional<double> lift;
  if (options.lift) {
    lift = read_decimal(*options.lift);
    if (!lift || !(*lift > 0) || *lift > transforming::kMaxPlace) {
      refuse(kWrongLift, *options.lift, options);
      return ExitStatus::Failure;
    }
  }
  std::optional<outline::OutlineOptions> outline_options;
  if (options.outline) {
    outline_options = read_outline_options(options, *run_options);
    if (!outline_options) return ExitStatus::Failure;
    outline_options->machine = machine.timed;
  }
  if (!files_are_apart(options, found->configuration)) return ExitStatus::Failure;
  const auto opened = options.reads_stdin() ? system::SourceFile::read_stream(system::kStandardInput, language)
                                            : system::SourceFile::open(options.file, language);
  if (const auto* problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    complain(fmt::format("{}: {}", options.shown_file(), problem->message));
    return ExitStatus::Failure;
  }
  const auto& source = std::get<system::SourceFile>(opened);
  if (operation) return write_operation(source, options, *restart_options, *operation, *found);
  if (restart_options) return restart(source, options, *restart_options, *found);
  if (lift) return write_lifted(source, options, *lift, *run_options, *found);
  if (outline_options) return write_outline(source, options, *outline_options, *found);
  outputs->subject = plot_subject(source.text(), machine, options);
  outputs->subject.scene = found->scene;
  if (!can_cut(options, *outputs)) return ExitStatus::Failure;
  if (found->scene) outputs->subject.origin = verification::first_workpiece_origin(source.text(), *run_options);
  const ExitStatus status = run_program(source.text(), options, *run_options, *outputs, *found);
  if (options.sheet.empty() || status == ExitStatus::Failure) return status;
  return write_sheet(source, options, *run_options, *found) ? status : ExitStatus::Failure;
}

/// An option that is given and says how a program is written; empty for none.
std::string_view option_of_made_programs(const RunCommandOptions& options) {
  if (!options.output.empty()) return "--output";
  if (options.clearance) return "--clearance";
  return options.approach_feed ? "--approach-feed" : "";
}

ExitStatus run_main(int argc, char** argv) {
  RunCommandOptions options;
  command_line::ProgramApp program(
      argc, argv,
      {"Runs an ISOCNC program and reports what it does.", "Esegue un programma ISOCNC e dice che cosa fa."},
      {.program = "isorun",
       .version = ISOCNC_VERSION,
       .purpose = {"run an ISOCNC program", "esegue un programma ISOCNC"},
       .operands = "FILE",
       .paragraphs = {{"isorun runs a program block by block as the control would, up to M02 or to the first error, "
                       "and reports what it does.",
                       "isorun esegue un programma blocco per blocco come il controllo, fino alla M02 o al primo "
                       "errore, e dice che cosa fa."},
                      {"With --restart-at it writes a program that brings the machine into the state before that line, "
                       "approaches from above, and goes on with the lines from there. Where that is not safe it says "
                       "why, and names the nearest lines where it is.",
                       "Con --restart-at scrive un programma che rimette la macchina nello stato prima di quella "
                       "linea, si avvicina dall'alto e prosegue con le linee da lì in poi. Dove non è sicuro dice "
                       "perché, e indica le linee più vicine da cui lo è."},
                      {"With --tool it writes a program that does one operation alone, begun as a restart is.",
                       "Con --tool scrive un programma che fa una sola lavorazione, iniziata come una ripresa."},
                      {"With --lift it writes the same program higher, to run it in the air.",
                       "Con --lift scrive lo stesso programma più in alto, per eseguirlo in aria."},
                      {"With --outline it writes a program that goes around the job, above it and with the spindle "
                       "off, to see before the first cut that everything has room. It is run on the simulated machine "
                       "first.",
                       "Con --outline scrive un programma che gira intorno al lavoro, sopra di esso e a mandrino "
                       "fermo, per vedere prima del primo taglio che tutto abbia posto. Prima lo esegue sulla macchina "
                       "simulata."}},
       .exit =
           {{"0",
             {"The program ran to its M02, or to the line of --until; or the program asked for has been written.",
              "Il programma è arrivato alla sua M02, o alla linea di --until; oppure il programma chiesto è stato "
              "scritto."}},
            {"1",
             {"An error stopped the program, as it would stop the control; or a finding of the machine is an error, "
              "such as a joint outside its travel; or there is no safe restart, or no free way for the outline; or an "
              "entry of a library of tools is mistaken, and the others are taken.",
              "Un errore ha fermato il programma, come fermerebbe il controllo; oppure una segnalazione della macchina "
              "è un errore, come un asse macchina fuori corsa; oppure non c'è una ripresa sicura, o per il contorno "
              "non c'è via libera; oppure una voce di una libreria di utensili è sbagliata, e le altre sono prese."}},
            {"2",
             {"A mistake in the command or in an isocnc.json, or something could not be read or written.",
              "Un errore nel comando o in un isocnc.json, oppure qualcosa che non si è potuto leggere o scrivere."}}},
       .see_also = {"isolint", "isofmt"}});
  const command_line::ProgramOption file =
      program.add_option("FILE", options.file, {" ", " "},
                         {"The program, or - for standard input", "Il programma, o - per lo standard input"});
  if (!is_about_tools(std::span(argv, static_cast<std::size_t>(argc)))) file.required();
  const command_line::ProgramOption trace =
      program.add_option("--trace", options.trace, command_line::kFileValue,
                         {"What happens, as JSON lines; - for standard output",
                          "Che cosa succede, in linee JSON; - per lo standard\noutput"});
  const command_line::ProgramOption samples =
      program.add_option("--samples", options.samples, command_line::kFileValue,
                         {"Where the machine is, in steps of time, as JSON lines",
                          "Dove si trova la macchina a passi di tempo, in linee\nJSON"});
  program
      .add_option(
          "--dt", options.sample_seconds, {"SECONDS", "SECONDI"},
          {"The step of --samples in seconds (else 0.01)", "Il passo di --samples in secondi (altrimenti 0.01)"})
      .needs(samples);
  const command_line::ProgramOption plot = program.add_option(
      "--plot", options.plot, command_line::kFileValue,
      {"A picture of the path: FILE.svg or, in 3-D, .html", "Un disegno del percorso: FILE.svg o, in 3D, .html"});
  const command_line::ProgramOption sheet =
      program.add_option("--sheet", options.sheet, command_line::kFileValue,
                         {"A setup sheet to print: FILE.html or .pdf", "Una scheda da stampare: FILE.html o .pdf"});
  const command_line::ProgramOption json =
      program.add_flag("--json", options.json, {"The summary as JSON", "Il riassunto in JSON"}).without_exclusions();
  const command_line::ProgramOption verify = program
                                                 .add_flag("--verify", options.verify,
                                                           {"Cut the stock, too, and print what the machine shows\n"
                                                            "as isolint does",
                                                            "Taglia anche il grezzo, e stampa ciò che la macchina\n"
                                                            "mostra come isolint"})
                                                 .without_exclusions();
  const command_line::ProgramOption stock_out = program.add_option(
      "--stock-out", options.stock_out, command_line::kFileValue,
      {"What is left of the blank, as FILE.stl or .stock", "Ciò che resta del grezzo, come FILE.stl o .stock"});
  command_line::add_material_values(program, options.material);
  command_line::add_run_values(program, options.values);
  program.add_option(
      "--machine", options.machine, command_line::kFileValue,
      {"The machine of this file, not of the isocnc.json", "La macchina di questo file, non dell'isocnc.json"});
  command_line::add_source_options(
      program, options.source,
      {"Read this, not the isocnc.json above the program", "Legge questo, non l'isocnc.json sopra il programma"});
  const command_line::ProgramOption until = program.add_option(
      "--until", options.until, {"LINE", "RIGA"}, {"Stop before this line", "Si ferma prima di questa riga"});
  program.add_language(options.language,
                       {"en or it; else as the locale says", "en o it; altrimenti secondo il locale"});

  program.begin_group({"Programs made of this one", "Programmi ricavati da questo"});
  const command_line::ProgramOption restart_at = program.add_option(
      "--restart-at", options.restart_at, {"LINE", "RIGA"},
      {"Write a program that goes on from this line", "Scrive un programma che riprende da questa riga"});
  const command_line::ProgramOption tool = program.add_option(
      "--tool", options.tool, {"T", "T"},
      {"Write a program of the operation of this tool alone;\nT@LINE: that of this M06",
       "Scrive un programma della sola lavorazione di questo\nutensile; T@RIGA: quella di questa M06"});
  const command_line::ProgramOption lift = program.add_option(
      "--lift", options.lift, {"MM", "MM"},
      {"Write the same program higher by so many mm", "Scrive lo stesso programma più in alto di tanti mm"});
  const command_line::ProgramOption outline = program.add_option(
      "--outline", options.outline, {"SHAPE", "FORMA"},
      {"Write a program that goes around the job:\nrectangle, hull or path",
       "Scrive un programma che gira intorno al lavoro:\nrectangle (rettangolo), hull (convesso) o path\n"
       "(contorno)"});
  // One of them, instead of a report.
  const command_line::ProgramOption makers[] = {restart_at, tool, lift, outline};
  for (const command_line::ProgramOption* maker = std::begin(makers); maker != std::end(makers); ++maker) {
    for (const command_line::ProgramOption* other = std::begin(makers); other != maker; ++other)
      maker->excludes(*other);
    for (const command_line::ProgramOption& other : {until, trace, samples, plot, sheet, stock_out, verify, json})
      maker->excludes(other);
  }
  program.add_option(
      "-o,--output", options.output, command_line::kFileValue,
      {"Where to write it; else to standard output", "Dove scriverlo; altrimenti sullo standard output"});
  program.add_option("--clearance", options.clearance, {"Z", "Z"},
                     {"Restart: go down in rapid to this Z, else to\nmachine.clearance; outline: go around there",
                      "Ripresa: scende in rapido fino a questa Z, altrimenti\na machine.clearance; contorno: gira lì"});
  program.add_option("--approach-feed", options.approach_feed, {"F", "F"},
                     {"Restart: then feed down at most at this F (else\n1000); outline: go around at it",
                      "Ripresa: poi scende al più con questa F (altrimenti\n1000); contorno: gira con questa"});
  add_tool_options(program, options.tools);
  if (const auto status = program.answer(argc, argv)) return *status;
  if (options.tools.is_given()) {
    if (options.file.empty()) return run_tool_command(options.tools, options.source, options.machine, options.language);
    complain(dialect::format(kNoProgram, options.reader_language(), options.file));
    return ExitStatus::Failure;
  }
  if (const std::string_view lonely = option_of_made_programs(options); !lonely.empty() && !options.makes_program()) {
    complain(dialect::format(kOfMadePrograms, options.reader_language(), lonely));
    return ExitStatus::Failure;
  }
  return run_file(options);
}

}  // namespace
}  // namespace isocnc::interpreter

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isorun", isocnc::interpreter::run_main, argc, argv);
}
