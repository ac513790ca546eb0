#include <unistd.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/running/output_file.h"
#include "interpreter/running/program_app.h"
#include "interpreter/running/restart.h"
#include "interpreter/running/run_report.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/source_file.h"
#include "interpreter/running/system_texts.h"
#include "interpreter/running/write_atomically.h"
#include "interpreter/syntax/number.h"
#include "interpreter/syntax/unicode.h"

namespace isocnc::running {
namespace {

using dialect::Language;
using dialect::Text;

enum ExitStatus { kRan = 0, kStopped = 1, kTrouble = 2 };

/// As they stand on the command line. Numbers are read later, when the language to complain in is known.
struct Options {
  std::string file;
  std::string trace;
  std::string samples;
  std::string sample_seconds = "0.01";
  std::string plot;
  bool json = false;
  std::string language;
  std::vector<std::string> settings;
  std::string vgpl = "0";
  std::string until;
  std::optional<std::string> restart_at;
  std::string output;
  std::optional<std::string> clearance;
  std::string approach_feed = "1000";
  configuration::Source source;
  std::optional<std::string> machine;

  Language reader_language() const {
    if (language.empty()) return dialect::language_of_environment();
    return language == "it" ? Language::Italian : Language::English;
  }
  bool reads_stdin() const { return file == "-"; }
  std::string shown_file() const { return reads_stdin() ? "<stdin>" : file; }
};

void complain(std::string_view what) { std::cerr << "isorun: " << syntax::printable(what) << '\n'; }

/// A number as programs write it, and nothing else: sign, digits, point.
std::optional<double> read_decimal(std::string_view text) {
  if (text.empty() || text.find_first_not_of("+-.0123456789") != std::string_view::npos) return std::nullopt;
  const syntax::Number number = syntax::scan_number(text.data(), text.data() + text.size());
  if (number.malformed || std::isnan(number.value)) return std::nullopt;
  return number.value;
}

/// A number from 1, of digits alone; none when it is more than `most`.
std::optional<std::uint64_t> read_count(std::string_view text, std::uint64_t most) {
  std::uint64_t count = 0;
  const char* const end = text.data() + text.size();
  const auto [behind, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || behind != end || count < 1 || count > most) return std::nullopt;
  return count;
}

/// V3=1.5
bool read_register(std::string_view setting, RunOptions& run) {
  const std::size_t equals = setting.find('=');
  if (!setting.starts_with('V') || equals == std::string_view::npos) return false;
  const auto reg = read_count(setting.substr(1, equals - 1), dialect::kRegisterCount);
  const auto value = read_decimal(setting.substr(equals + 1));
  if (!reg || !value) return false;
  run.registers[*reg] = *value;
  return true;
}

constexpr Text kWrongSetting{"--set wants a register and a plain number, V1=0 to V30=-2.5, not {}",
                             "--set vuole un registro e un numero semplice, da V1=0 a V30=-2.5, non {}"};
constexpr Text kWrongVgpl{"--vgpl wants a plain number, such as -2.5, not {}",
                          "--vgpl vuole un numero semplice, come -2.5, non {}"};
constexpr Text kWrongUntil{"--until wants a line, from 1, not {}", "--until vuole una riga, da 1, non {}"};
constexpr Text kWrongRestart{"--restart-at wants a line, from 1, not {}", "--restart-at vuole una riga, da 1, non {}"};
constexpr Text kWrongClearance{"--clearance wants a plain number of mm, such as 30, not {}",
                               "--clearance vuole un numero semplice in mm, come 30, non {}"};
constexpr Text kWrongApproachFeed{
    "--approach-feed wants a plain number of mm/min above 0, such as 1000, not {}",
    "--approach-feed vuole un numero semplice in mm/min maggiore di 0, come 1000, non {}"};
constexpr Text kRestartOverwrites{"the restart program would overwrite the program",
                                  "il programma di ripresa sovrascriverebbe il programma"};
constexpr Text kOverwritesProgram{"this would overwrite the program", "così si sovrascriverebbe il programma"};
constexpr Text kWrongSeconds{"--dt wants a plain number of seconds, from 0.0001, such as 0.01, not {}",
                             "--dt vuole un numero semplice di secondi, da 0.0001, come 0.01, non {}"};
constexpr Text kWrongPlot{"--plot writes SVG, so the name has to end in .svg, unlike {}",
                          "--plot scrive SVG: il nome deve finire in .svg, non come {}"};
constexpr Text kOneStandardOutput{"--trace - and --samples - both want standard output",
                                  "--trace - e --samples - vogliono tutti e due lo standard output"};

/// Nothing, after a complaint.
std::nullopt_t refuse(const Text& why, std::string_view value, const Options& options) {
  complain(fmt::format(fmt::runtime(why.in(options.reader_language())), value));
  return std::nullopt;
}

/// What is asked of the run; nothing after a complaint.
std::optional<RunOptions> read_run_options(const Options& options) {
  RunOptions run;
  for (const std::string& setting : options.settings)
    if (!read_register(setting, run)) return refuse(kWrongSetting, setting, options);
  const auto vgpl = read_decimal(options.vgpl);
  if (!vgpl) return refuse(kWrongVgpl, options.vgpl, options);
  run.vgpl = *vgpl;
  if (!options.until.empty()) {
    const auto until = read_count(options.until, std::numeric_limits<std::uint64_t>::max());
    if (!until) return refuse(kWrongUntil, options.until, options);
    run.until = *until - 1;
  }
  return run;
}

/// What is to be written, and where; nothing after a complaint.
std::optional<RunOutputs> read_outputs(const Options& options) {
  constexpr double kShortest = 1e-4;
  RunOutputs outputs{.trace = options.trace,
                     .samples = options.samples,
                     .plot = options.plot,
                     .json = options.json,
                     .program_name = options.shown_file(),
                     .language = options.reader_language()};
  const auto seconds = read_decimal(options.sample_seconds);
  if (!seconds || !(*seconds >= kShortest)) return refuse(kWrongSeconds, options.sample_seconds, options);
  outputs.sample_seconds = *seconds;
  if (!options.plot.empty() && !options.plot.ends_with(".svg")) return refuse(kWrongPlot, options.plot, options);
  if (options.trace == "-" && options.samples == "-") return refuse(kOneStandardOutput, "", options);
  return outputs;
}

/// How the program is to be taken up again; nothing after a complaint.
std::optional<RestartOptions> read_restart_options(const Options& options, const RunOptions& run) {
  RestartOptions restart;
  restart.run = run;
  restart.language = options.reader_language();
  restart.name = options.reads_stdin() ? "<stdin>" : std::filesystem::path(options.file).filename().string();
  const auto line = read_count(*options.restart_at, std::numeric_limits<std::uint64_t>::max());
  if (!line) return refuse(kWrongRestart, *options.restart_at, options);
  restart.line = *line - 1;
  if (options.clearance) {
    restart.clearance = read_decimal(*options.clearance);
    if (!restart.clearance) return refuse(kWrongClearance, *options.clearance, options);
  }
  const auto feed = read_decimal(options.approach_feed);
  if (!feed || !(*feed > 0)) return refuse(kWrongApproachFeed, options.approach_feed, options);
  restart.approach_feed = *feed;
  return restart;
}

void print_error(const Options& options, const RunResult& result) {
  const Language language = options.reader_language();
  const syntax::Span span = result.error.span;
  const std::string_view marked = result.line_text.substr(span.begin, span.end - span.begin);
  const dialect::DiagnosticDef& def = dialect::definition(result.error.id);
  const std::string message = dialect::message(result.error.id, language, marked, result.error.values);
  std::cerr << syntax::printable(fmt::format("{}:{}: {}: {} [{}]", options.shown_file(), result.line + 1,
                                             dialect::severity_name(def.severity, language), message, def.code))
            << '\n';
}

/// Flushes an output; false, after a complaint, when anything written to it has been lost.
bool finish(OutputFile& output, std::string_view name, Language language) {
  if (output.flush() == 0) return true;
  complain(fmt::format("{}: {}", name, cannot_write(output.error(), language)));
  return false;
}

/// Writing to the file that is being read would take the program away.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored);
}

int run_program(std::string_view program, const Options& options, const RunOptions& run_options,
                const RunOutputs& outputs, const TimedMachine& machine) {
  RunReport report(outputs, machine);
  std::optional<RunResult> result;
  if (report.is_ready()) {
    result = run(program, run_options, [&](const Event& event) { report.take(event); });
    report.finish(*result);
    if (result->ending == Ending::Error) print_error(options, *result);
  }
  for (const std::string& problem : report.problems()) complain(problem);
  if (!report.problems().empty()) return kTrouble;
  return result->ending == Ending::Error ? kStopped : kRan;
}

/// To a file all at once, so that nobody ever loads half of a program.
bool write_restart(std::string_view program, const Options& options) {
  const Language language = options.reader_language();
  if (options.output.empty() || options.output == "-") {
    OutputFile standard_output(STDOUT_FILENO);
    standard_output.write(program);
    return finish(standard_output, "<stdout>", language);
  }
  const int error = write_atomically(options.output, program);
  if (error != 0) complain(fmt::format("{}: {}", options.output, cannot_write(error, language)));
  return error == 0;
}

int restart(const SourceFile& source, const Options& options, const RestartOptions& restart_options) {
  const auto made = restart_program(source.text(), restart_options);
  if (const auto* const program = std::get_if<std::string>(&made)) {
    const std::string_view mark = source.has_byte_order_mark() ? kByteOrderMark : "";
    return write_restart(std::string(mark) + *program, options) ? kRan : kTrouble;
  }
  const auto& refusal = std::get<RestartRefusal>(made);
  if (refusal.obstacle == Obstacle::ProgramError) {
    print_error(options, refusal.run);
    return kStopped;
  }
  complain(fmt::format("{}: {}", options.shown_file(), message(refusal, options.reader_language())));
  return refusal.obstacle == Obstacle::NoSuchLine ? kTrouble : kStopped;
}

/// What the checks know of the machine; none, after a complaint, when a file is wrong. The program's configuration also
/// tells the language to speak, unless the command line does.
std::optional<configuration::Machine> read_machine(Options& options) {
  using configuration::Configurations;
  const Language language = options.reader_language();
  Configurations found(options.source, language);
  Configurations given({.file = options.machine, .none = !options.machine}, language);
  const std::filesystem::path program = options.reads_stdin() ? "" : options.file;
  const configuration::Configuration& configuration = found.in_folder(program.parent_path());
  const configuration::Configuration& machine =
      options.machine ? given.in_folder(program.parent_path()) : configuration;
  if (options.language.empty() && configuration.language)
    options.language = configuration::name_of(*configuration.language);
  bool is_right = true;
  for (const Configurations* read : {&found, &given})
    for (const std::string& mistake : read->mistakes(options.reader_language())) {
      std::cerr << mistake << '\n';
      is_right = false;
    }
  return is_right ? std::optional(machine.machine) : std::nullopt;
}

int run_file(Options options) {
  const std::optional<configuration::Machine> machine = read_machine(options);
  if (!machine) return kTrouble;
  const Language language = options.reader_language();
  std::optional<RunOptions> run_options = read_run_options(options);
  if (!run_options) return kTrouble;
  run_options->setup = machine->setup;
  const std::optional<RunOutputs> outputs = read_outputs(options);
  if (!outputs) return kTrouble;
  for (const std::string* const file : {&options.trace, &options.samples, &options.plot})
    if (!options.reads_stdin() && is_same_file(options.file, *file)) {
      complain(fmt::format("{}: {}", *file, kOverwritesProgram.in(language)));
      return kTrouble;
    }
  std::optional<RestartOptions> restart_options;
  if (options.restart_at) {
    restart_options = read_restart_options(options, *run_options);
    if (!restart_options) return kTrouble;
  }
  if (!options.reads_stdin() && is_same_file(options.file, options.output)) {
    complain(fmt::format("{}: {}", options.output, kRestartOverwrites.in(language)));
    return kTrouble;
  }
  const auto opened = options.reads_stdin() ? SourceFile::read_stream(STDIN_FILENO, language)
                                            : SourceFile::open(options.file, language);
  if (const auto* problem = std::get_if<SourceFile::Problem>(&opened)) {
    complain(fmt::format("{}: {}", options.shown_file(), problem->message));
    return kTrouble;
  }
  const auto& source = std::get<SourceFile>(opened);
  if (restart_options) return restart(source, options, *restart_options);
  return run_program(source.text(), options, *run_options, *outputs, machine->timed);
}

/// What --help and --version ask for.
int say(std::string_view text, Language language) {
  OutputFile standard_output(STDOUT_FILENO);
  standard_output.write(text);
  return finish(standard_output, "<stdout>", language) ? kRan : kTrouble;
}

int run_main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // A closed pipe is a write that fails, and is told as one.
  Options options;
  ProgramApp program(
      "Runs an ISOCNC program and tells what it does.",
      {.program = "isorun",
       .version = ISOCNC_VERSION,
       .purpose = "run an ISOCNC program",
       .operands = "FILE",
       .paragraphs = {"isorun runs a program block by block as the control would, up to M02 or to the first error, "
                      "and tells what it does.",
                      "With --restart-at it writes a program that brings the machine into the state before that line, "
                      "approaches from above, and goes on with the lines from there. Where that is not safe it says "
                      "why, and names the nearest lines where it is."},
       .exit = {{"0",
                 "The program ran to its M02, or to the line of --until; or the restart program has been written."},
                {"1",
                 "An error stopped the program, as it would stop the control; or there is no safe restart before the "
                 "line."},
                {"2", "A mistake in the command or in an isocnc.json, or something could not be read or written."}},
       .see_also = {"isolint", "isofmt"}});
  CLI::App& app = program.options();
  app.add_option("FILE", options.file, "The program, or - for standard input")->required()->option_text(" ");
  CLI::Option* const trace =
      app.add_option("--trace", options.trace, "What happens, as JSON lines; - for standard output")
          ->option_text("FILE");
  CLI::Option* const samples =
      app.add_option("--samples", options.samples, "Where the machine is, in steps of time, as JSON lines")
          ->option_text("FILE");
  app.add_option("--dt", options.sample_seconds, "The step of --samples in seconds (else 0.01)")
      ->option_text("SECONDS")
      ->needs(samples);
  CLI::Option* const plot =
      app.add_option("--plot", options.plot, "A picture of the path: FILE.svg")->option_text("FILE");
  CLI::Option* const json = app.add_flag("--json", options.json, "The summary as JSON")->option_text(" ");
  app.add_option("--vgpl", options.vgpl, "Value of VGPL (else 0)")->option_text("VALUE");
  app.add_option("--set", options.settings, "Value of a register at the start: V3=1.5")
      ->option_text("V=VALUE")
      ->allow_extra_args(false);
  app.add_option("--machine", options.machine, "The machine of this file, not of the isocnc.json")->option_text("FILE");
  CLI::Option* const config =
      app.add_option("--config", options.source.file, "Read this, not the isocnc.json above the program")
          ->option_text("FILE");
  app.add_flag("--no-config", options.source.none, "Read no isocnc.json")->excludes(config)->option_text(" ");
  CLI::Option* const until = app.add_option("--until", options.until, "Stop before this line")->option_text("LINE");
  program.add_choice("--lang", options.language, {"en", "it"}, "LANG", "en or it; else as the locale says");
  CLI::Option* const restart_at =
      app.add_option("--restart-at", options.restart_at, "Write a program that goes on from this line")
          ->option_text("LINE")
          ->excludes(until)
          ->excludes(trace)
          ->excludes(samples)
          ->excludes(plot)
          ->excludes(json);
  const std::vector<CLI::Option*> restarting = {
      app.add_option("-o,--output", options.output, "Where to write it; else to standard output")->option_text("FILE"),
      app.add_option("--clearance", options.clearance, "Go down in rapid to this Z; else machine.clearance")
          ->option_text("Z"),
      app.add_option("--approach-feed", options.approach_feed, "Go on down at most at this F (else 1000)")
          ->option_text("F")};
  restart_at->group("Restart");
  for (CLI::Option* const option : restarting) option->needs(restart_at)->group("Restart");
  const ProgramApp::Said said = program.read(argc, argv, [&] { return options.reader_language(); });
  if (said.answer) return say(*said.answer, options.reader_language());
  if (said.complaint) {
    complain(*said.complaint);
    std::cerr << "isorun --help\n";
    return kTrouble;
  }
  return run_file(options);
}

}  // namespace
}  // namespace isocnc::running

int main(int argc, char** argv) {
  try {
    return isocnc::running::run_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "isorun: internal error: " << error.what() << '\n';
    return 2;
  }
}
