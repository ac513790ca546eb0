#include "analyzer/command_line.h"

#include <cstdlib>

#include "analyzer/formats/renderers.h"
#include "analyzer/shards.h"
#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/source_options.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/terminal.h"
#include "interpreter/system/user_language.h"

namespace isocnc::analyzer {

using dialect::Language;

Language LintCommandOptions::reader_language() const {
  return dialect::language_named(language).value_or(system::user_language());
}

void LintCommandOptions::follow(const configuration::Configuration& configuration) {
  if (language.empty() && configuration.language) language = dialect::name_of(*configuration.language);
}

bool LintCommandOptions::wants_color() const {
  if (color != "auto") return color == "always";
  const int descriptor = prints_program() ? system::kStandardError : system::kStandardOutput;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets a variable.
  return output.empty() && system::is_terminal(descriptor) && std::getenv("NO_COLOR") == nullptr;
}

bool LintCommandOptions::prints_program() const { return fix && !diff && paths.size() == 1 && paths.front() == "-"; }

/// `text, concise, ...`, folded into lines that fit beside the options.
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

static void add_options(command_line::ProgramApp& program, LintCommandOptions& options) {
  static constexpr dialect::Text kCodes = {"CODES", "CODICI"};
  program.add_option(
      "PATH", options.paths, {"...", "..."},
      {"Programs, directories (searched for .iso .nc .cnc\n.tap .ngc), or - for standard input; else the\n"
       "current directory",
       "Programmi, directory (dove si cercano .iso .nc\n.cnc .tap .ngc), o - per lo standard input;\n"
       "altrimenti la directory corrente"});
  program.add_option("--explain", options.explain, {"CODE", "CODICE"},
                     {"Explain a code, such as ISO031", "Spiega un codice, per esempio ISO031"});
  program.add_flag("--list-rules", options.list_rules, {"List all codes", "Elenca tutti i codici"});

  program.begin_group({"What is reported", "Che cosa segnalare"});
  // Each option takes one word, so that in `--select ISO031 part.iso` the path stays a path.
  program
      .add_option("--select", options.selection.select, kCodes,
                  {"Only these: codes (ISO031), names, what codes\nstart with (W1), ALL; commas between them",
                   "Solo questi: codici (ISO031), nomi, inizi di codici\n(W1), ALL; separati da virgole"})
      .takes_one();
  program.add_option("--ignore", options.selection.ignore, kCodes, {"Not these", "Questi no"}).takes_one();
  program
      .add_option("--severity", options.selection.severities, {"CODE=LEVEL", "CODICE=LIVELLO"},
                  {"Report it as error, warning or info; or off", "Gli dà il peso error, warning, info oppure off"})
      .takes_one();
  const command_line::ProgramOption verify =
      program.add_flag("--verify", options.verify,
                       {"Run each program on the machine as well: joints\noutside their travel, gouges of compensation",
                        "Esegue anche ogni programma sulla macchina: assi\nfuori corsa, intacchi della correzione"});
  verify.without_exclusions();
  const command_line::MaterialProgramOptions material =
      command_line::add_material_values(program, options.material_values);
  material.resolution.needs(verify);
  material.window.needs(verify);
  const command_line::ProgramOption baseline =
      program.add_option("--baseline", options.baseline, command_line::kFileValue,
                         {"Not the findings recorded in this file", "Non le segnalazioni registrate in questo file"});
  const command_line::ProgramOption write_baseline =
      program
          .add_option(
              "--write-baseline", options.write_baseline, command_line::kFileValue,
              {"Record all findings in this file instead", "Registra invece tutte le segnalazioni in questo file"})
          .excludes(baseline);

  program.begin_group({"What is mended", "Che cosa correggere"});
  const command_line::ProgramOption fix =
      program.add_flag("--fix", options.fix,
                       {"Rewrite programs with their safe fixes", "Riscrive i programmi con le correzioni sicure"});
  fix.without_exclusions().excludes(write_baseline);
  program.add_flag("--unsafe-fixes", options.unsafe_fixes,
                   {"Count fixes as well that are likely, not certain", "Anche le correzioni probabili ma non certe"});
  const command_line::ProgramOption diff = program.add_flag(
      "--diff", options.diff,
      {"Show what --fix would change, and change nothing", "Mostra che cosa cambierebbe --fix, senza cambiarlo"});
  diff.without_exclusions().excludes(write_baseline).excludes(verify);

  program.begin_group({"How it is shown", "Come mostrarlo"});
  const std::string formats = listed(formats::format_names());
  const command_line::ProgramOption format =
      program.add_choice("--format", options.format, formats::format_names(), {"NAME", "NOME"}, {formats, formats});
  diff.excludes(format);
  const command_line::ProgramOption output = program.add_option(
      "--output", options.output, command_line::kFileValue,
      {"Write to this file, not to standard output", "Scrive in questo file, non sullo standard output"});
  output.check([](const std::string& given, dialect::Language language) {
    static constexpr dialect::Text kNoName = {"no name", "manca il nome"};
    return std::string(given.empty() ? kNoName.in(language) : "");
  });
  const command_line::ProgramOption statistics =
      program.add_flag("--statistics", options.statistics,
                       {"Show how many findings each code has", "Mostra quante segnalazioni ha ogni codice"});
  statistics.without_exclusions().excludes(diff);
  program.add_language(options.language,
                       {"en or it; else as the locale says", "en o it; altrimenti secondo il locale"});
  program.add_choice("--color", options.color, {"auto", "always", "never"}, {"WHEN", "QUANDO"},
                     {"auto, always, never", "auto, always, never"});
  program.add_option("--stdin-filename", options.stdin_name, {"NAME", "NOME"},
                     {"What to call standard input", "Come chiamare lo standard input"});

  program.begin_group({"How it is run", "Esecuzione"});
  const command_line::ProgramOption watch =
      program.add_flag("--watch", options.watch,
                       {"Check again what is written, until Ctrl-C", "Riverifica ciò che cambia, fino a Ctrl-C"});
  for (const command_line::ProgramOption& other : {write_baseline, fix, diff, output, statistics})
    watch.without_exclusions().excludes(other);
  const command_line::ProgramOption shard =
      program.add_option("--shard", options.shard, {"I/N", "I/N"},
                         {"Check one of N parts of the files: 2/8", "Verifica una di N parti dei file: 2/8"});
  shard.check([](const std::string& given, dialect::Language language) {
    static constexpr dialect::Text kNoShard = {"write it as 2/8, the second of eight",
                                               "si scrive 2/8, la seconda di otto"};
    return std::string(Shard::read(given) ? "" : kNoShard.in(language));
  });
  const command_line::ProgramOption merge =
      program.add_flag("--merge", options.merge,
                       {"Join reports of parts: PATH names files of\n--format json or sarif",
                        "Unisce i rapporti delle parti: PATH indica file\ndi --format json o sarif"});
  for (const command_line::ProgramOption& other : {watch, write_baseline}) shard.excludes(other);
  for (const command_line::ProgramOption& other :
       {shard, watch, baseline, write_baseline, fix, diff, format, statistics, verify})
    merge.without_exclusions().excludes(other);
  program.add_option("--max-warnings", options.max_warnings, {"N", "N"},
                     {"Fail when there are more warnings than N", "Fallisce se gli avvisi sono più di N"});
  program.add_flag("--exit-zero", options.exit_zero,
                   {"Do not fail because of findings", "Non fallisce per le segnalazioni"});
  program
      .add_option("--jobs,-j", options.jobs, {"N", "N"},
                  {"Threads; else one per core", "Thread; altrimenti uno per core"})
      .in_range(1, 1024);
  command_line::add_source_options(
      program, options.source,
      {"Read this, not the isocnc.json above each program", "Legge questo, non l'isocnc.json sopra ogni programma"});
  program.add_flag(
      "--show-config", options.show_config,
      {"Print the configuration of PATH, and where it is", "Stampa la configurazione di PATH, e dove si trova"});
  // Options that generate docs/isocnc.schema.json, a table of docs/configuration.md, docs/machine.md, docs/rules.md,
  // docs/messages.md, docs/other-controls.md and cmake/windows/notepad++/isocnc.xml; with --lang it, the pages of
  // docs/it/.
  program.add_flag("--config-schema", options.config_schema, {}).hidden();
  program.add_flag("--setup-schema", options.setup_schema, {}).hidden();
  program.add_flag("--config-keys", options.config_keys, {}).hidden();
  program.add_flag("--machine-page", options.machine_page, {}).hidden();
  program.add_flag("--rules-page", options.rules_page, {}).hidden();
  program.add_flag("--messages-page", options.messages_page, {}).hidden();
  program.add_flag("--foreign-page", options.foreign_page, {}).hidden();
  program.add_flag("--notepad-language", options.notepad_language, {}).hidden();

  std::vector<std::string> codes;
  for (const dialect::DiagnosticDef& def : dialect::kDiagnostics) codes.emplace_back(def.code);
  for (const char* const option : {"--explain", "--select", "--ignore", "--severity"}) program.suggest(option, codes);
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CommandLine read;
  command_line::ProgramApp program(
      argc, argv,
      {"Checks ISOCNC programs and reports what the control would stop at.",
       "Verifica i programmi ISOCNC e segnala dove il controllo si fermerebbe."},
      {.program = "isolint",
       .version = ISOCNC_VERSION,
       .purpose = {"check ISOCNC programs", "verifica i programmi ISOCNC"},
       .operands = "[PATH...]",
       .paragraphs =
           {{"isolint reports what the ISOCNC control would stop at (codes ISO and E), and what a machinist would "
             "frown at (W), at the place where it stands, on every path through IF and GOTO.",
             "isolint segnala dove il controllo ISOCNC si fermerebbe (codici ISO ed E) e ciò che farebbe storcere il "
             "naso a un operatore (W), nel punto esatto, su ogni percorso che passa per gli IF ... GOTO."},
            {"Comments in a program silence findings: (isolint: ignore ISO031) its line, (isolint: disable ISO031) and "
             "(isolint: enable ISO031) a stretch, (isolint: ignore-file) the program.",
             "I commenti in un programma tolgono le segnalazioni: (isolint: ignore ISO031) sulla sua linea, "
             "(isolint: disable ISO031) e (isolint: enable ISO031) in un tratto, (isolint: ignore-file) in tutto il "
             "programma."},
            {"What is reported, and the machine that programs are checked for, may be written into an isocnc.json "
             "beside the programs or above them.",
             "Che cosa segnalare, e per quale macchina, si può scrivere in un isocnc.json nella cartella dei "
             "programmi o in una sopra."}},
       .exit =
           {{"0",
             {"No errors; there may be warnings, within --max-warnings, and notes.",
              "Nessun errore; ci possono essere avvisi, entro --max-warnings, e note."}},
            {"1",
             {"Errors were found, or too many warnings, or with --diff a difference.",
              "Ci sono errori, o troppi avvisi, oppure con --diff una differenza."}},
            {"2",
             {"A mistake in the command or in an isocnc.json, or something could not be read or written.",
              "Un errore nel comando o in un isocnc.json, oppure qualcosa che non si è potuto leggere o scrivere."}}},
       .see_also = {"isofmt", "isorun"}});
  add_options(program, read.options);
  auto said = program.read(argc, argv);
  read.answer = std::move(said.answer);
  read.complaint = std::move(said.complaint);
  return read;
}

}  // namespace isocnc::analyzer
