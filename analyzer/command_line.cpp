#include "analyzer/command_line.h"

#include <unistd.h>

#include <cstdlib>

#include <fmt/format.h>

#include "analyzer/renderers.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/running/program_app.h"

namespace isocnc::analyzer {

using dialect::Language;

Language Options::reader_language() const {
  if (language == "it") return Language::Italian;
  if (language == "en") return Language::English;
  return dialect::language_of_environment();
}

void Options::follow(const configuration::Configuration& configuration) {
  if (language.empty() && configuration.language) language = configuration::name_of(*configuration.language);
}

bool Options::wants_color() const {
  if (color != "auto") return color == "always";
  const int descriptor = prints_program() ? STDERR_FILENO : STDOUT_FILENO;
  return output.empty() && isatty(descriptor) != 0 && std::getenv("NO_COLOR") == nullptr;
}

bool Options::prints_program() const { return fix && !diff && paths.size() == 1 && paths.front() == "-"; }

/// One word behind each option of a list, so that `--select ISO031 part.iso` leaves the path alone.
static void add_list(CLI::App& app, const std::string& name, std::vector<std::string>& list, const char* placeholder,
                     const std::string& description) {
  app.add_option(name, list, description)->allow_extra_args(false)->option_text(placeholder);
}

/// `text, concise, ...`, in lines that fit beside the options.
static std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kWidth = 50;
  std::string text;
  std::size_t width = 0;
  for (const std::string& name : names) {
    if (!text.empty()) text += width + name.size() > kWidth ? ",\n" : ", ";
    width = width + name.size() > kWidth ? 0 : width;
    text += name;
    width += name.size() + 2;
  }
  return text;
}

static void add_options(running::ProgramApp& program, Options& options) {
  CLI::App& app = program.options();
  app.add_option("PATH", options.paths,
                 "Programs, directories (searched for .iso .nc .cnc\n.tap .ngc), or - for standard input; else the\n"
                 "current directory")
      ->option_text("...");
  app.add_option("--explain", options.explain, "Tell all about a code, such as ISO031")->option_text("CODE");
  app.add_flag("--list-rules", options.list_rules, "List all codes");

  app.option_defaults()->group("What is reported");
  add_list(app, "--select", options.wishes.select, "CODES",
           "Only these: codes (ISO031), names, what codes\nbegin with (W1), ALL; commas between them");
  add_list(app, "--ignore", options.wishes.ignore, "CODES", "Not these");
  add_list(app, "--severity", options.wishes.severities, "CODE=LEVEL", "Weigh it as error, warning, info or off");
  CLI::Option* const baseline =
      app.add_option("--baseline", options.baseline, "Not the findings recorded in this file")->option_text("FILE");
  CLI::Option* const write_baseline =
      app.add_option("--write-baseline", options.write_baseline, "Record all findings in this file instead")
          ->option_text("FILE")
          ->excludes(baseline);

  app.option_defaults()->group("What is mended");
  app.add_flag("--fix", options.fix, "Rewrite programs with their safe fixes")
      ->option_text(" ")
      ->excludes(write_baseline);
  app.add_flag("--unsafe-fixes", options.unsafe_fixes, "Count fixes as well that are likely, not certain");
  CLI::Option* const diff = app.add_flag("--diff", options.diff, "Show what --fix would change, and change nothing");
  diff->option_text(" ")->excludes(write_baseline);

  app.option_defaults()->group("How it is shown");
  diff->excludes(program.add_choice("--format", options.format, format_names(), "NAME", listed(format_names())));
  app.add_option("--output", options.output, "Write to this file, not to standard output")->option_text("FILE");
  app.add_flag("--statistics", options.statistics, "Show how many findings each code has")
      ->option_text(" ")
      ->excludes(diff);
  program.add_choice("--lang", options.language, {"en", "it"}, "LANG", "en or it; else as the locale says");
  program.add_choice("--color", options.color, {"auto", "always", "never"}, "WHEN", "auto, always, never");
  app.add_option("--stdin-filename", options.stdin_name, "What to call standard input")->option_text("NAME");

  app.option_defaults()->group("How it is run");
  app.add_option("--max-warnings", options.max_warnings, "Fail when there are more warnings than N")
      ->check(CLI::Validator(
          [](const std::string& given) {
            const bool is_count =
                !given.empty() && given.size() <= 9 && given.find_first_not_of("0123456789") == std::string::npos;
            return is_count ? std::string() : given + " is no count of warnings";
          },
          ""))
      ->option_text("N");
  app.add_flag("--exit-zero", options.exit_zero, "Do not fail because of findings");
  app.add_option("--jobs,-j", options.jobs, "Threads; else one per core")->check(CLI::Range(1, 1024))->option_text("N");
  CLI::Option* const config =
      app.add_option("--config", options.source.file, "Read this, not the isocnc.json above each program")
          ->option_text("FILE");
  app.add_flag("--no-config", options.source.none, "Read no isocnc.json")->excludes(config);
  app.add_flag("--show-config", options.show_config, "Print the configuration of PATH, and where it is");
  app.add_flag("--config-schema", options.config_schema, "Print docs/isocnc.schema.json")->group("");
  app.add_flag("--config-keys", options.config_keys, "Print the keys for docs/configuration.md")->group("");
  app.add_flag("--rules-page", options.rules_page, "Print docs/rules.md")->group("");

  std::vector<std::string> codes;
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) codes.emplace_back(def.code);
  for (const char* const option : {"--explain", "--select", "--ignore", "--severity"}) program.suggest(option, codes);
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine read;
  running::ProgramApp program(
      "Checks ISOCNC programs and reports what the control would stop at.",
      {.program = "isolint",
       .version = ISOCNC_VERSION,
       .purpose = "check ISOCNC programs",
       .operands = "[PATH...]",
       .paragraphs =
           {"isolint reports what the ISOCNC control would stop at (codes ISO and E), and what a machinist would frown "
            "at (W), at the place where it stands, on every path through IF and GOTO.",
            "Comments in a program silence findings: (isolint: ignore ISO031) its line, (isolint: disable ISO031) and "
            "(isolint: enable ISO031) a stretch, (isolint: ignore-file) the program.",
            "What is reported, and the machine that programs are checked for, may be written into an isocnc.json "
            "beside the programs or above them."},
       .exit = {{"0", "No errors; there may be warnings, within --max-warnings, and notes."},
                {"1", "Errors were found, or too many warnings, or with --diff a difference."},
                {"2", "A mistake in the command or in an isocnc.json, or something could not be read or written."}},
       .see_also = {"isofmt", "isorun"}});
  add_options(program, read.options);
  auto said = program.read(argc, argv, [&] { return read.options.reader_language(); });
  read.answer = std::move(said.answer);
  read.complaint = std::move(said.complaint);
  return read;
}

}  // namespace isocnc::analyzer
