#include "interpreter/tool_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "interpreter/command_line/program_main.h"
#include "interpreter/configuration/read.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/replace_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/lists.h"
#include "interpreter/text/unicode.h"
#include "interpreter/tool_library/columns.h"
#include "interpreter/tool_library/new_machine.h"
#include "interpreter/tool_library/read_library.h"
#include "interpreter/tool_library/tool_import.h"

namespace isocnc::interpreter {

using configuration::Configurations;
using dialect::Language;
using dialect::Text;
using system::ExitStatus;

namespace {

constexpr std::string_view kOptions[] = {"--import-tools", "--export-tools", "--new-machine"};

constexpr Text kNothingWritten{"nothing is written; --write writes {}", "non è scritto nulla; --write scrive {}"};
constexpr Text kNoFileToWrite{
    "--no-config reads no isocnc.json, so that --write has none to change: name one with --config or --machine",
    "--no-config non legge nessun isocnc.json, e --write non ne ha uno da cambiare: indicarlo con --config o "
    "--machine"};
constexpr Text kWritten{"{} is written", "{} è scritto"};
constexpr Text kNothingTaken{"no tool is taken: --map FILE says where they stand, such as {}",
                             "nessun utensile è preso: --map FILE dice dove stanno, per esempio {}"};
constexpr Text kNoTools{"{} lists no tools", "{} non elenca utensili"};
constexpr Text kNoConfiguration{"there is no isocnc.json here or above", "qui e sopra non c'è un isocnc.json"};
constexpr Text kHasMachine{"{} has a machine already", "{} ha già una macchina"};
constexpr Text kAnswersEnded{"the answers end before the questions; nothing is written",
                             "le risposte finiscono prima delle domande; non è scritto nulla"};
constexpr Text kNotCsv{
    "--export-tools writes a file whose name ends in .csv, or - for standard output, unlike {}",
    "--export-tools scrive un file il cui nome finisce in .csv, o - per lo standard output, non come {}"};
constexpr Text kNoKey{"{} is no key of a tool: {}", "{} non è una chiave di un utensile: {}"};
constexpr Text kIgnoredColumns{"columns that are not read: {}", "colonne che non vengono lette: {}"};
constexpr Text kTakesNone{"no tool is taken", "nessun utensile è preso"};
constexpr Text kDefect{"with these tools {} would be too large, or not valid; nothing is written",
                       "con questi utensili {} sarebbe troppo grande, o non valido; non è scritto nulla"};

void refuse_tools(std::string_view why) { command_line::complain("isorun", why); }

/// A file that is to be changed, or made.
class TargetFile {
 public:
  explicit TargetFile(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code ignored;
    if (std::filesystem::exists(path_, ignored)) replacement_.emplace(path_);
  }

  std::string name() const { return text::printable(system::generic_name(path_)); }
  std::filesystem::path folder() const { return configuration::real_path(path_).parent_path(); }

  /// The text; empty for a file that is not there yet. None after an error message.
  std::optional<std::string> read(Language language) const {
    if (!replacement_) return std::string();
    auto bytes = system::read_bytes(path_, configuration::kLongestFile, language);
    if (auto* const text = std::get_if<std::string>(&bytes)) return std::move(*text);
    refuse_tools(tool_library::unread_message(path_, std::get<system::FileBytesProblem>(bytes),
                                              configuration::mistakes::kTooLarge, language));
    return std::nullopt;
  }

  /// False after an error message.
  bool write(std::string_view text, Language language) {
    std::optional<std::string> problem;
    if (replacement_) {
      replacement_->write(text);
      problem = replacement_->commit(language);
      if (problem) problem = fmt::format("{}: {}", name(), *problem);
    } else {
      system::OutputFile file(path_);
      file.write(text);
      problem = system::commit(file, name(), language);
    }
    if (problem) refuse_tools(*problem);
    return !problem;
  }

 private:
  std::filesystem::path path_;
  std::optional<system::FileReplacement> replacement_;  // Looks at the file before it is read.
};

/// The machine that the tools belong to, and the file that describes it.
struct FoundMachine {
  configuration::MachineConfiguration machine;
  std::filesystem::path file;  ///< Empty if there is none.
  bool is_ignored = false;     ///< By --no-config, so that there is nothing to write to.
  Language language = Language::English;
};

/// None after error messages.
std::optional<FoundMachine> find_machine(const configuration::ConfigurationSource& source,
                                         const std::optional<std::string>& machine, std::string_view language_option) {
  Language language = dialect::language_named(language_option).value_or(system::user_language());
  Configurations found(machine ? configuration::ConfigurationSource{.file = machine} : source, language);
  const configuration::Configuration& configuration = found.in_folder("");
  if (language_option.empty() && configuration.language) language = *configuration.language;
  const std::vector<std::string> mistakes = found.mistakes(language);
  for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
  if (!mistakes.empty()) return std::nullopt;
  return FoundMachine{configuration.machine, configuration.file, !machine && source.none, language};
}

ExitStatus import_tools(const ToolCommandOptions& options, const FoundMachine& found) {
  const Language language = found.language;
  if (found.is_ignored && options.is_written) {
    refuse_tools(kNoFileToWrite.in(language));
    return ExitStatus::Failure;
  }
  const std::vector<std::string> keys = tool_library::tool_key_names();
  std::vector<std::string> kept;
  for (const std::string_view each : text::split_at_commas(options.kept))
    if (!each.empty()) kept.emplace_back(each);
  for (const std::string& key : kept)
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      refuse_tools(dialect::format(kNoKey, language, text::printable(key), fmt::format("{}", fmt::join(keys, ", "))));
      return ExitStatus::Failure;
    }
  tool_library::ToolMap map;
  if (!options.map_file.empty()) {
    auto read = tool_library::load_tool_map(options.map_file, language);
    if (const auto* const mistakes = std::get_if<std::string>(&read)) {
      std::cerr << *mistakes << '\n';
      return ExitStatus::Failure;
    }
    map = std::get<tool_library::ToolMap>(std::move(read));
  }
  // Before it is read: what others change meanwhile stays.
  TargetFile target(found.file.empty() ? std::filesystem::path(configuration::kFileName) : found.file);
  const std::optional<std::string> text = found.is_ignored ? std::string() : target.read(language);
  if (!text) return ExitStatus::Failure;
  const tool_library::Library library = tool_library::read_library(options.import_file, map.is_in_inches, language);
  for (const std::string& mistake : library.mistakes) std::cerr << mistake << '\n';
  if (!library.mistakes.empty()) return ExitStatus::Failure;
  const auto planned =
      tool_library::import_tools(found.machine, library, {.map = map, .kept = kept, .language = language});
  if (const auto* const why = std::get_if<std::string>(&planned)) {
    refuse_tools(*why);
    return ExitStatus::Failure;
  }
  const auto& import = std::get<tool_library::ToolImport>(planned);
  std::cout << shown_import(import, language);
  if (!library.ignored.empty())
    std::cout << dialect::format(kIgnoredColumns, language, fmt::format("{}", fmt::join(library.ignored, ", ")))
              << '\n';
  if (import.changes.empty() && import.unchanged == 0) {
    const auto lacks_place =
        std::find_if(library.tools.begin(), library.tools.end(),
                     [](const tool_library::LibraryTool& tool) { return !tool.has_place && tool.mistakes.empty(); });
    if (lacks_place == library.tools.end() || !options.map_file.empty()) {
      refuse_tools(kTakesNone.in(language));
      return ExitStatus::Failure;
    }
    const std::string number = lacks_place->number.empty() ? lacks_place->tool.name : lacks_place->number;
    refuse_tools(dialect::format(kNothingTaken, language,
                                 fmt::format(R"({{"tools": {{"{}": "T101001"}}}})", text::printable(number))));
    return ExitStatus::Failure;
  }
  // What is mistaken in the library does not keep the others out.
  const ExitStatus done = has_mistaken_entry(import) ? ExitStatus::Findings : ExitStatus::Success;
  if (found.is_ignored || (import.changes.empty() && import.holders.empty())) return done;
  const std::optional<std::string> changed = tool_library::with_import(*text, target.folder(), import);
  if (!changed) {
    refuse_tools(dialect::format(kDefect, language, target.name()));
    return ExitStatus::Failure;
  }
  if (!options.is_written) {
    std::cout << dialect::format(kNothingWritten, language, target.name()) << '\n';
    return done;
  }
  if (!target.write(*changed, language)) return ExitStatus::Failure;
  std::cout << dialect::format(kWritten, language, target.name()) << '\n';
  return done;
}

ExitStatus export_tools(const ToolCommandOptions& options, const FoundMachine& found) {
  const Language language = found.language;
  const bool is_standard_output = options.export_file == "-";
  if (!is_standard_output && !options.export_file.ends_with(".csv") && !options.export_file.ends_with(".CSV")) {
    refuse_tools(dialect::format(kNotCsv, language, options.export_file));
    return ExitStatus::Failure;
  }
  if (found.file.empty()) {
    refuse_tools(kNoConfiguration.in(language));
    return ExitStatus::Failure;
  }
  if (!found.machine.tools) {
    refuse_tools(dialect::format(kNoTools, language, text::printable(system::generic_name(found.file))));
    return ExitStatus::Failure;
  }
  const std::string table = options.is_for_presetter ? tool_library::presetter_list(*found.machine.tools, language)
                                                     : tool_library::columns_of(*found.machine.tools, language);
  if (is_standard_output) {
    std::cout << table << std::flush;
    return ExitStatus::Success;
  }
  system::OutputFile file{std::filesystem::path(options.export_file)};
  file.write(table);
  const std::optional<std::string> problem = system::commit(file, options.export_file, language);
  if (problem) refuse_tools(*problem);
  return problem ? ExitStatus::Failure : ExitStatus::Success;
}

ExitStatus make_machine(const std::string& file, std::string_view language_option) {
  const Language language = dialect::language_named(language_option).value_or(system::user_language());
  TargetFile target{std::filesystem::path(file)};
  const std::optional<std::string> text = target.read(language);
  if (!text) return ExitStatus::Failure;
  if (!text->empty()) {
    Configurations read({.file = file}, language);
    read.in_folder("");
    const std::vector<std::string> mistakes = read.mistakes(language);
    for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
    if (!mistakes.empty()) return ExitStatus::Failure;
    if (tool_library::has_machine(*text)) {
      refuse_tools(dialect::format(kHasMachine, language, target.name()));
      return ExitStatus::Failure;
    }
  }
  const std::optional<std::string> changed = tool_library::ask_for_machine(*text, std::cin, std::cout, language);
  if (!changed) {
    std::cout << '\n';
    refuse_tools(kAnswersEnded.in(language));
    return ExitStatus::Failure;
  }
  if (!target.write(*changed, language)) return ExitStatus::Failure;
  std::cout << '\n' << dialect::format(kWritten, language, target.name()) << '\n';
  return ExitStatus::Success;
}

}  // namespace

bool is_about_tools(std::span<const char* const> arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](std::string_view argument) {
    return std::any_of(std::begin(kOptions), std::end(kOptions), [&](std::string_view option) {
      return argument == option || (argument.starts_with(option) && argument.substr(option.size()).starts_with('='));
    });
  });
}

void add_tool_options(command_line::ProgramApp& program, ToolCommandOptions& options) {
  program.begin_group({"Tools and machine, without a program", "Utensili e macchina, senza programma"});
  const command_line::ProgramOption import =
      program.add_option("--import-tools", options.import_file, command_line::kFileValue,
                         {"Show what this library of tools would change in the\nisocnc.json: of Fusion, FreeCAD, "
                          "CAMotics, LinuxCNC,\nor a CSV",
                          "Mostra che cosa cambierebbe nell'isocnc.json questa\nlibreria di utensili: di Fusion, "
                          "FreeCAD, CAMotics,\nLinuxCNC, o un CSV"});
  program
      .add_option("--map", options.map_file, command_line::kFileValue,
                  {"Where the tools of a library stand, as JSON", "Dove stanno gli utensili di una libreria, in JSON"})
      .needs(import);
  program
      .add_option("--keep", options.kept, {"KEYS", "CHIAVI"},
                  {"Keys that stay as the machine has them, such as\nlength, which is measured there",
                   "Chiavi che restano come le ha la macchina, per\nesempio length, che si misura lì"})
      .needs(import);
  program
      .add_flag("--write", options.is_written, {"With --import-tools: change it", "Con --import-tools: cambia il file"})
      .needs(import);
  const command_line::ProgramOption exported = program.add_option(
      "--export-tools", options.export_file, command_line::kFileValue,
      {"Write the tools of the isocnc.json as FILE.csv", "Scrive gli utensili dell'isocnc.json come FILE.csv"});
  program
      .add_flag("--presetter", options.is_for_presetter,
                {"With --export-tools: with columns to measure into", "Con --export-tools: con colonne per le misure"})
      .needs(exported);
  const command_line::ProgramOption machine = program.add_option(
      "--new-machine", options.new_machine, command_line::kFileValue,
      {"Ask about a machine, and write it as an isocnc.json", "Chiede com'è la macchina, e ne scrive l'isocnc.json"});
  import.excludes(exported);
  import.excludes(machine);
  exported.excludes(machine);
}

ExitStatus run_tool_command(const ToolCommandOptions& options, const configuration::ConfigurationSource& source,
                            const std::optional<std::string>& machine, std::string_view language) {
  if (!options.new_machine.empty()) return make_machine(options.new_machine, language);
  const std::optional<FoundMachine> found = find_machine(source, machine, language);
  if (!found) return ExitStatus::Failure;
  return options.import_file.empty() ? export_tools(options, *found) : import_tools(options, *found);
}

}  // namespace isocnc::interpreter
