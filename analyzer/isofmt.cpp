#include <charconv>
#include <functional>
#include <iostream>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/fixing/unified_diff.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/formatting/program_formatter.h"
#include "analyzer/input/files.h"
#include "analyzer/revisions/same_behavior.h"
#include "analyzer/transforming/transform.h"
#include "analyzer/transforming/transform_request.h"
#include "analyzer/translation/translator.h"
#include "interpreter/command_line/program_app.h"
#include "interpreter/command_line/program_main.h"
#include "interpreter/command_line/progress.h"
#include "interpreter/command_line/source_options.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/paths.h"
#include "interpreter/system/replace_file.h"
#include "interpreter/system/source_file.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/system/terminal.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/unicode.h"

namespace isocnc::analyzer {
namespace {

using dialect::Language;
using dialect::Text;
using system::SourceFile;

using system::ExitStatus;

enum class OutputMode { Check, Diff, Stdout, InPlace };

/// The options as given on the command line.
struct FormatCommandOptions {
  std::vector<std::string> paths;
  bool check = false;
  bool diff = false;
  bool to_stdout = false;
  bool in_place = false;
  bool word_order = false;
  bool no_word_order = false;
  bool renumber_all = false;
  bool verify = false;
  std::string decimals;  // Empty, like the others: by the configuration.
  std::string renumber;
  std::string modal;
  std::string g_digits;
  std::string language;
  transforming::TransformRequest transform;
  configuration::ConfigurationSource source;
  std::string stdin_name = "<stdin>";
  std::string from;  // Empty, like the next two: nothing is translated.
  std::string map;
  std::vector<std::string> zeros;

  /// Whether one of them asks for another way of writing, or for its proof.
  bool changes_style() const {
    return word_order || no_word_order || renumber_all || verify || !decimals.empty() || !renumber.empty() ||
           !modal.empty() || !g_digits.empty() || !from.empty();
  }
  Language reader_language() const { return dialect::language_named(language).value_or(system::user_language()); }
  OutputMode mode() const {
    if (check) return OutputMode::Check;
    if (diff) return OutputMode::Diff;
    return in_place ? OutputMode::InPlace : OutputMode::Stdout;
  }
};

void complain(std::string_view what) { command_line::complain("isofmt", what); }

constexpr Text kWrongRenumber{"--renumber takes a start and a step, such as 10:10 or 5:5, or keep, not {}",
                              "--renumber vuole un inizio e un passo, come 10:10 o 5:5, oppure keep, non {}"};
constexpr Text kRenumberAllAlone{"--renumber-all goes with --renumber START:STEP",
                                 "--renumber-all va con --renumber INIZIO:PASSO"};
constexpr Text kOneProgram{"standard output takes one program; choose --check, --diff or -i for {}",
                           "lo standard output riceve un solo programma; per {} scegliere --check, --diff o -i"};
constexpr Text kStandardInputInPlace{"standard input cannot be written in place (-i)",
                                     "lo standard input non si può riscrivere sul posto (-i)"};
constexpr Text kNotRenumbered{"not renumbered: {}", "non rinumerato: {}"};
constexpr Text kNotTransformed{"not changed: {}", "non modificato: {}"};
constexpr Text kOnlyTransforms{
    "--mirror, --rotate, --shift and --scale-feed change nothing else: format the result in a second run",
    "--mirror, --rotate, --shift e --scale-feed non cambiano altro: formattare il risultato con un secondo comando"};
constexpr Text kNotVerified{"not formatted, since it is not certain that it does the same: {}",
                            "non formattato, perché non è certo che faccia lo stesso: {}"};
constexpr Text kWouldBeChanged{"{} of {} programs would be changed", "programmi da modificare: {} di {}"};
constexpr Text kWereChanged{"{} of {} programs changed", "programmi modificati: {} di {}"};

constexpr Text kOneTranslation{"--from takes one program, not {}", "--from vuole un solo programma, non {}"};
constexpr Text kNoZero{"--zero takes a zero point in machine coordinates, such as G54=350,220,-185.5, not {}",
                       "--zero vuole un'origine in coordinate di macchina, come G54=350,220,-185.5, non {}"};
constexpr Text kStopsTranslation{"not translated: the control would stop at {} of the translation, {}",
                                 "non tradotto: il controllo si fermerebbe a {} della traduzione, {}"};
constexpr Text kTranslated{"places to look at: {}", "punti da controllare: {}"};

/// Reads a start and a step, such as 10:10; the step must be at least 1.
std::optional<formatting::NumberStyle> read_numbers(std::string_view text) {
  formatting::NumberStyle style;
  const char* const end = text.data() + text.size();
  const auto start = std::from_chars(text.data(), end, style.start);
  if (start.ec != std::errc{} || start.ptr == end || *start.ptr != ':') return std::nullopt;
  const auto step = std::from_chars(start.ptr + 1, end, style.step);
  static constexpr std::uint64_t kMaxNumber = configuration::Renumber::kMaxNumber;
  if (step.ec != std::errc{} || step.ptr != end || style.step < 1 || style.step > kMaxNumber ||
      style.start > kMaxNumber)
    return std::nullopt;
  return style;
}

/// Overrides a value of the configuration with an option: a number, or `keep` for none.
void override_value(std::optional<int>& value, const std::string& option) {
  if (option.empty()) return;
  value = option == "keep" ? std::nullopt : std::optional(std::stoi(option));
}

/// The configuration's style, overridden by the command line. The options must be valid.
formatting::ProgramStyle style_from(configuration::Format format, const FormatCommandOptions& options) {
  if (options.word_order || options.no_word_order) format.word_order = options.word_order;
  override_value(format.decimals, options.decimals);
  override_value(format.g_digits, options.g_digits);
  if (!options.modal.empty()) format.modal = options.modal;
  formatting::ProgramStyle style = formatting::style_by(format);
  if (!options.renumber.empty()) style.numbers = read_numbers(options.renumber);
  const bool numbers_all = options.renumber_all || (format.renumber && format.renumber->all_lines);
  if (style.numbers && numbers_all) style.numbers->all_lines = true;
  return style;
}

/// Whether the options are valid; if not, an error has been printed.
bool check_options(const FormatCommandOptions& options) {
  const Language language = options.reader_language();
  const auto transformation = options.transform.read(language);
  if (const auto* wrong = std::get_if<std::string>(&transformation)) {
    complain(*wrong);
    return false;
  }
  if (std::get<0>(transformation) && options.changes_style()) {
    complain(kOnlyTransforms.in(language));
    return false;
  }
  const bool renumbers = !options.renumber.empty() && options.renumber != "keep";
  if (renumbers && !read_numbers(options.renumber)) {
    complain(dialect::format(kWrongRenumber, language, options.renumber));
    return false;
  }
  if (options.renumber_all && !renumbers) {
    complain(kRenumberAllAlone.in(language));
    return false;
  }
  return true;
}

/// 0, 1, ... and `keep`.
std::vector<std::string> decimals_choices() {
  std::vector<std::string> choices;
  for (int maximum = 0; maximum <= configuration::Format::kMaxDecimals; ++maximum)
    choices.push_back(std::to_string(maximum));
  choices.emplace_back("keep");
  return choices;
}

/// What one file is formatted by.
struct FileSettings {
  formatting::ProgramStyle style;
  const configuration::MachineConfiguration& machine;  ///< For the proof.
};

/// Gives the pieces of a program and of its new text, one after another, and nothing after the last.
using NextPiece = std::function<std::optional<formatting::FormattedPiece>()>;

/// Formats programs one after another.
class FormatRun {
 public:
  FormatRun(const FormatCommandOptions& options, const input::FileSelection& selection)
      : options_(options),
        transformation_(std::get<0>(options.transform.read(options.reader_language()))),
        selection_(selection),
        mode_(options.mode()),
        language_(options.reader_language()),
        progress_(shares_terminal() ? nullptr : command_line::terminal_writer(), input::bytes_of(selection.files)) {}

  /// `settings` holds those of each file.
  ExitStatus run(const std::vector<FileSettings>& settings) {
    failed_ = !selection_.problems.empty();
    for (std::size_t i = 0; i < selection_.files.size(); ++i) {
      format_file(selection_.files[i], settings[i]);
      if (output_.error() != 0) break;
    }
    progress_.clear();
    if (output_.flush() != 0) {
      complain(fmt::format("<stdout>: {}", system::cannot_write(output_.error(), language_)));
      return ExitStatus::Failure;
    }
    if (mode_ != OutputMode::Stdout) {
      const Text& summary = mode_ == OutputMode::InPlace ? kWereChanged : kWouldBeChanged;
      std::cerr << dialect::format(summary, language_, changed_, read_) << '\n';
    }
    if (failed_) return ExitStatus::Failure;
    return changed_ > 0 && (mode_ == OutputMode::Check || mode_ == OutputMode::Diff) ? ExitStatus::Findings
                                                                                     : ExitStatus::Success;
  }

 private:
  /// Whether the output would overwrite the progress bar.
  bool shares_terminal() const { return mode_ != OutputMode::InPlace && system::is_terminal(system::kStandardOutput); }

  void fail(std::string_view name, std::string_view why) {
    progress_.clear();
    complain(fmt::format("{}: {}", name, why));
    failed_ = true;
  }

  /// Why it is not certain that the formatted program does the same; none if it does.
  std::optional<std::string> doubt(std::string_view program, const FileSettings& settings) const {
    std::string formatted;
    formatting::ProgramFormatter formatter(program, settings.style);
    while (const auto piece = formatter.next()) formatted += piece->after;
    const selection::Selection selection;
    const auto revision = [&](std::string_view text) {
      return revisions::Revision{text, settings.machine.timed, settings.machine.setup, selection};
    };
    const revisions::Revision before = revision(program);
    const revisions::Revision after = revision(formatted);
    return revisions::why_not_same({before, after}, {}, language_);
  }

  void format_file(const std::filesystem::path& file, const FileSettings& settings) {
    const bool from_stdin = file == "-";
    const std::string name = system::generic_name(from_stdin ? std::filesystem::path(options_.stdin_name) : file);
    std::optional<system::FileReplacement> replacement;
    if (mode_ == OutputMode::InPlace) replacement.emplace(file);  // Before the file is read.
    const auto opened =
        from_stdin ? SourceFile::read_stream(system::kStandardInput, language_) : SourceFile::open(file, language_);
    if (const auto* problem = std::get_if<SourceFile::Problem>(&opened)) return fail(name, problem->message);
    const auto& source = std::get<SourceFile>(opened);
    ++read_;
    shown_bytes_ = 0;
    if (transformation_) {
      transform_file(source, settings, replacement, name);
    } else {
      formatting::ProgramFormatter formatter(source.text(), settings.style);
      if (const auto& obstacle = formatter.obstacle())
        return fail(name, dialect::format(kNotRenumbered, language_, obstacle->message(language_)));
      if (options_.verify)
        if (const auto why = doubt(source.text(), settings))
          return fail(name, dialect::format(kNotVerified, language_, *why));
      put_out([&] { return formatter.next(); }, source, replacement, name);
    }
    progress_.add(source.text().size() - shown_bytes_);
  }

  void transform_file(const SourceFile& source, const FileSettings& settings,
                      std::optional<system::FileReplacement>& replacement, const std::string& name) {
    const auto made = transforming::transform(source.text(), *transformation_, settings.machine.setup, language_);
    if (const auto* refusal = std::get_if<transforming::TransformationRefusal>(&made))
      return fail(name, dialect::format(kNotTransformed, language_, refusal->message(language_)));
    std::optional<formatting::FormattedPiece> whole;
    if (!source.text().empty()) whole = {source.text(), std::get<std::string>(made)};
    put_out([&] { return std::exchange(whole, std::nullopt); }, source, replacement, name);
  }

  void put_out(const NextPiece& next, const SourceFile& source, std::optional<system::FileReplacement>& replacement,
               const std::string& name) {
    switch (mode_) {
      case OutputMode::Check:
        check(next, name);
        break;
      case OutputMode::Diff:
        show_difference(next, name, source.has_byte_order_mark());
        break;
      case OutputMode::Stdout:
        print(next, source);
        break;
      case OutputMode::InPlace:
        replace(next, source, *replacement, name);
        break;
    }
  }

  std::optional<formatting::FormattedPiece> next_piece(const NextPiece& next) {
    const std::optional<formatting::FormattedPiece> piece = next();
    if (piece) {
      shown_bytes_ += piece->before.size();
      progress_.add(piece->before.size());
    }
    return piece;
  }

  void check(const NextPiece& next, const std::string& name) {
    while (const auto piece = next_piece(next)) {
      if (!piece->is_changed()) continue;
      ++changed_;
      return output_.write(text::printable(name) + '\n');
    }
  }

  void show_difference(const NextPiece& next, const std::string& name, bool has_byte_order_mark) {
    fixing::UnifiedDiff diff(name, has_byte_order_mark, [&](std::string_view text) { output_.write(text); });
    while (const auto piece = next_piece(next)) diff.add(piece->before, piece->after);
    diff.finish();
    changed_ += diff.has_changes() ? 1 : 0;
  }

  void print(const NextPiece& next, const SourceFile& source) {
    if (source.has_byte_order_mark()) output_.write(system::kByteOrderMark);
    while (const auto piece = next_piece(next)) output_.write(piece->after);
  }

  /// Replaces the file; leaves a file that needs no change untouched.
  void replace(const NextPiece& next, const SourceFile& source, system::FileReplacement& replacement,
               const std::string& name) {
    bool is_changed = false;
    while (const auto piece = next_piece(next)) {
      if (!is_changed && !piece->is_changed()) continue;
      if (!is_changed) {
        if (source.has_byte_order_mark()) replacement.write(system::kByteOrderMark);
        const std::string_view text = source.text();
        replacement.write(text.substr(0, static_cast<std::size_t>(piece->before.data() - text.data())));
        is_changed = true;
      }
      replacement.write(piece->after);
    }
    if (!is_changed) return;
    if (const auto why_not = replacement.commit(language_)) return fail(name, *why_not);
    ++changed_;
  }

  const FormatCommandOptions& options_;
  const std::optional<transforming::Transformation> transformation_;
  const input::FileSelection& selection_;
  const OutputMode mode_;
  const Language language_;
  command_line::Progress progress_;
  std::size_t shown_bytes_ = 0;  // Bytes of the file that the progress bar has counted.
  system::OutputFile output_{system::kStandardOutput};
  std::size_t read_ = 0;
  std::size_t changed_ = 0;
  bool failed_ = false;
};

/// Translates one program, prints it, and reports what it could not say.
class TranslationCommand {
 public:
  TranslationCommand(const FormatCommandOptions& options, const FileSettings& settings)
      : options_(options), settings_(settings), language_(options.reader_language()) {}

  ExitStatus run(const std::filesystem::path& file) {
    if (!read_setup()) return ExitStatus::Failure;
    const bool from_stdin = file == "-";
    const std::string name = system::generic_name(from_stdin ? std::filesystem::path(options_.stdin_name) : file);
    const auto opened =
        from_stdin ? SourceFile::read_stream(system::kStandardInput, language_) : SourceFile::open(file, language_);
    if (const auto* problem = std::get_if<SourceFile::Problem>(&opened)) return fail(name, problem->message);
    const translation::Translation translation = translation::translate(std::get<SourceFile>(opened).text(), setup_);
    if (translation.refusal) {
      report(name, *translation.refusal);
      return ExitStatus::Failure;
    }
    formatting::ProgramFormatter formatter(translation.program, settings_.style);
    std::string formatted;
    while (const auto piece = formatter.next()) formatted += piece->after;
    if (const auto why = first_error(formatted)) return fail(name, *why);
    for (const translation::TranslationFinding& finding : translation.findings) report(name, finding);
    if (!translation.findings.empty())
      std::cerr << dialect::format(kTranslated, language_, translation.findings.size()) << '\n';
    system::OutputFile output{system::kStandardOutput};
    output.write(formatted);
    if (output.flush() != 0) return fail("<stdout>", system::cannot_write(output.error(), language_));
    return translation.findings.empty() ? ExitStatus::Success : ExitStatus::Findings;
  }

 private:
  ExitStatus fail(std::string_view name, std::string_view why) const {
    complain(fmt::format("{}: {}", text::printable(name), why));
    return ExitStatus::Failure;
  }

  void report(std::string_view name, const translation::TranslationFinding& finding) const {
    std::cerr << fmt::format("{}:{}:{}: {}\n", text::printable(name), finding.line, finding.column,
                             finding.message(language_));
  }

  /// Takes the map, the zero points of the command, which outweigh it, and the machine's own.
  bool read_setup() {
    setup_.control = *translation::control_named(options_.from);
    setup_.language = language_;
    setup_.home = settings_.machine.setup.home.tip;
    setup_.arc_tolerance = settings_.machine.setup.arc_tolerance;
    if (const auto& functions = settings_.machine.setup.functions)
      setup_.named_functions.insert(functions->begin(), functions->end());
    if (!options_.map.empty()) {
      auto map = translation::load_translation_map(options_.map, language_);
      if (const auto* messages = std::get_if<std::string>(&map)) {
        std::cerr << *messages << '\n';
        return false;
      }
      setup_.map = std::move(std::get<translation::TranslationMap>(map));
    }
    for (const std::string& text : options_.zeros) {
      const auto zero = translation::read_zero_option(text);
      if (!zero) {
        complain(dialect::format(kNoZero, language_, text::printable(text)));
        return false;
      }
      setup_.map.zeros[zero->first] = zero->second;
    }
    return true;
  }

  /// Why the control would stop, as with a tool that the machine does not have; nothing is written then.
  std::optional<std::string> first_error(std::string_view program) const {
    const check::Report found = check::check_text(program, {.machine = settings_.machine.setup});
    for (const check::LocatedFinding& located : found.findings) {
      if (located.severity() != dialect::Severity::Error) continue;
      std::string_view rest = program;
      for (std::size_t line = 0; line < located.line; ++line) rest.remove_prefix(rest.find('\n') + 1);
      const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
      const std::string what = formats::message_of(located, found, line, language_);
      return dialect::format(kStopsTranslation, language_, fmt::format("{} ({})", located.line + 1, line), what);
    }
    return std::nullopt;
  }

  const FormatCommandOptions& options_;
  const FileSettings& settings_;
  const Language language_;
  translation::TranslationSetup setup_;
};

/// Formats the files. The first path's configuration decides the language: a command uses one language.
ExitStatus format(FormatCommandOptions options) {
  configuration::Configurations configurations(options.source, options.reader_language());
  const auto& first = configurations.of(input::place_of_program(options.paths.front(), options.stdin_name));
  if (options.language.empty() && first.language) options.language = dialect::name_of(*first.language);
  const Language language = options.reader_language();
  if (!check_options(options)) return ExitStatus::Failure;
  const input::FileSelection selection = input::select_programs(options.paths, configurations, language);
  std::vector<FileSettings> settings;
  for (const std::filesystem::path& file : selection.files) {
    const configuration::Configuration& configuration =
        configurations.in_folder(input::place_of_program(file, options.stdin_name).parent_path());
    settings.push_back({style_from(configuration.format, options), configuration.machine});
  }
  const std::vector<std::string> mistakes = configurations.mistakes(language);
  for (const std::string& mistake : mistakes) std::cerr << mistake << '\n';
  if (!mistakes.empty()) return ExitStatus::Failure;
  for (const std::string& problem : selection.problems) complain(problem);
  if (selection.is_refused) return ExitStatus::Failure;
  if (!options.from.empty()) {
    if (selection.problems.empty() && selection.files.size() == 1)
      return TranslationCommand(options, settings.front()).run(selection.files.front());
    if (selection.problems.empty()) complain(dialect::format(kOneTranslation, language, selection.files.size()));
    return ExitStatus::Failure;
  }
  if (options.mode() == OutputMode::Stdout && selection.files.size() > 1) {
    complain(dialect::format(kOneProgram, language, selection.files.size()));
    return ExitStatus::Failure;
  }
  if (options.mode() == OutputMode::InPlace && options.paths.front() == "-") {
    complain(kStandardInputInPlace.in(language));
    return ExitStatus::Failure;
  }
  return FormatRun(options, selection).run(settings);
}

void add_transform_options(command_line::ProgramApp& program, transforming::TransformRequest& options) {
  program.begin_group({"What programs are to do instead", "Che cosa devono fare invece i programmi"});
  program.add_choice("--mirror", options.mirror, {"X", "Y"}, {"AXIS", "ASSE"},
                     {"Mirrored: X or Y on the other side of --about", "Specchiati: X o Y oltre la quota --about"});
  program.add_option("--rotate", options.rotate, {"DEGREES", "GRADI"},
                     {"Turned counterclockwise around --about", "Ruotati in senso antiorario intorno ad --about"});
  program.add_option("--shift", options.shift, {"X,Y[,Z]", "X,Y[,Z]"}, {"Moved by these mm", "Spostati di questi mm"});
  program.add_option(
      "--repeat", options.repeat, {"NX,NY,DX,DY", "NX,NY,DX,DY"},
      {"NX columns, DX mm apart, and NY rows, DY mm apart", "NX colonne ogni DX mm, e NY righe ogni DY mm"});
  program.add_option("--about", options.about, {"MM", "MM"},
                     {"The place of --mirror on its axis, or X,Y of\n--rotate",
                      "La quota di --mirror sul suo asse, o X,Y di\n--rotate"});
  program.add_option("--scale-feed", options.scale_feed, {"FACTOR", "FATTORE"},
                     {"Each F multiplied by it", "Ogni F moltiplicata per questo"});
}

void add_options(command_line::ProgramApp& program, FormatCommandOptions& options) {
  program
      .add_option("PATH", options.paths, {"...", "..."},
                  {"Programs, directories (searched for .iso .nc .cnc\n.tap .ngc), or - for standard input",
                   "Programmi, directory (dove si cercano .iso .nc\n.cnc .tap .ngc), o - per lo standard input"})
      .required();

  program.begin_group({"What to do", "Che cosa fare"});
  const command_line::ProgramOption modes[] = {
      program.add_flag("--check", options.check,
                       {"Name the programs that would be changed", "Elenca i programmi da modificare"}),
      program.add_flag("--diff", options.diff, {"Show what would be changed", "Mostra che cosa cambierebbe"}),
      program.add_flag("--stdout", options.to_stdout,
                       {"Print the formatted program, as by default",
                        "Stampa il programma formattato; così anche senza\nnessuna di queste"}),
      program.add_flag("-i,--in-place", options.in_place, {"Rewrite the programs", "Riscrive i programmi"}),
  };
  for (const command_line::ProgramOption& mode : modes)
    for (const command_line::ProgramOption& other : modes)
      if (&mode != &other) mode.excludes(other).without_exclusions();

  program.begin_group({"What programs are to look like", "Come scrivere i programmi"});
  const command_line::ProgramOption word_order =
      program
          .add_flag("--word-order", options.word_order,
                    {"N first, arguments as X Y Z A B C I J K P Q R,\nthen F",
                     "Prima N, argomenti come X Y Z A B C I J K P Q R,\npoi F"})
          .without_exclusions();
  program
      .add_flag("--no-word-order", options.no_word_order,
                {"Keep the order of the words", "Parole nell'ordine in cui si trovano"})
      .excludes(word_order)
      .without_exclusions();
  program.add_choice("--decimals", options.decimals, decimals_choices(), {"MAX", "MAX"},
                     {"Zeros that mean nothing dropped, .5 as 0.5;\nnumbers are never rounded; or keep",
                      "Senza zeri superflui, .5 come 0.5; i numeri non\nvengono mai arrotondati; oppure keep"});
  program.add_choice("--g-digits", options.g_digits, {"1", "2", "keep"}, {"WIDTH", "CIFRE"},
                     {"1: G1; 2: G01; keep", "1: G1; 2: G01; keep"});
  program.add_choice("--modal", options.modal, {"write", "fold", "keep"}, {"HOW", "COME"},
                     {"Motion Gs: write on each line, fold where\nrepeated, keep",
                      "G di movimento: write su ogni linea, fold senza\nripetizioni, keep"});
  program.add_option("--renumber", options.renumber, {"START:STEP", "INIZIO:PASSO"},
                     {"New line numbers where there are some; labels of\nGOTO follow; or keep",
                      "Nuovi numeri di riga dove ci sono; le etichette\ndei GOTO li seguono; oppure keep"});
  program.add_flag("--renumber-all", options.renumber_all,
                   {"With --renumber: on every line with a block", "Con --renumber: su ogni linea con un blocco"});

  add_transform_options(program, options.transform);
  program.begin_group({"Programs of other controls", "Programmi di altri controlli"});
  const command_line::ProgramOption from =
      program.add_choice("--from", options.from, {"fanuc", "linuxcnc", "grbl"}, {"CONTROL", "CONTROLLO"},
                         {"Translate a program of this control, and print it:\nfanuc, linuxcnc or grbl",
                          "Traduce un programma di questo controllo, e lo\nstampa: fanuc, linuxcnc o grbl"});
  for (const command_line::ProgramOption& mode : {modes[0], modes[1], modes[3]}) from.excludes(mode);
  program
      .add_option("--map", options.map, command_line::kFileValue,
                  {"What its machine knows: tools, zero points, M\nfunctions, as JSON",
                   "Ciò che sa la sua macchina: utensili, origini,\nfunzioni M, in JSON"})
      .needs(from);
  program
      .add_option("--zero", options.zeros, {"G54=X,Y,Z", "G54=X,Y,Z"},
                  {"A zero point, in machine coordinates and mm", "Un'origine, in coordinate di macchina e mm"})
      .takes_one()
      .needs(from);

  program.begin_group({"How it is run", "Esecuzione"});
  program
      .add_flag("--verify", options.verify,
                {"Run both texts, and format only what does the same",
                 "Esegue i due testi, e formatta solo ciò che fa lo\nstesso"})
      .excludes(from)
      .without_exclusions();
  program.add_option("--stdin-filename", options.stdin_name, {"NAME", "NOME"},
                     {"What to call standard input", "Come chiamare lo standard input"});
  program.add_language(options.language,
                       {"en or it; else as the locale says", "en o it; altrimenti secondo il locale"});
  command_line::add_source_options(
      program, options.source,
      {"Read this, not the isocnc.json above each program", "Legge questo, non l'isocnc.json sopra ogni programma"});
}

ExitStatus run_main(int argc, char** argv) {
  FormatCommandOptions options;
  command_line::ProgramApp program(
      argc, argv,
      {"Formats ISOCNC programs. What a program does stays as it is.",
       "Formatta i programmi ISOCNC. Ciò che un programma fa non cambia."},
      {.program = "isofmt",
       .version = ISOCNC_VERSION,
       .purpose = {"format ISOCNC programs", "formatta i programmi ISOCNC"},
       .operands = "PATH...",
       .paragraphs = {{"isofmt writes words in upper case with one blank between them. Comments, line ends and the end "
                       "of the last "
                       "line stay as they are, and so does all that a program does.",
                       "isofmt scrive le parole in maiuscolo, separate da uno spazio. I commenti, i terminatori di "
                       "linea e la fine dell'ultima linea restano come sono, e così tutto ciò che un programma fa."},
                      {"With --mirror, --rotate, --shift or --scale-feed it changes what programs do instead, and "
                       "nothing else in them. Both texts are run and compared before one is written.",
                       "Con --mirror, --rotate, --shift o --scale-feed cambia invece ciò che i programmi fanno, e "
                       "nient'altro. I due testi vengono eseguiti e confrontati prima di scriverne uno."},
                      {"A program that is rewritten in place is either the old or the new one, whole, whatever happens "
                       "meanwhile.",
                       "Un programma riscritto sul posto è quello vecchio o quello nuovo, sempre intero, qualunque "
                       "cosa succeda nel frattempo."},
                      {"With --from, isofmt translates a program of another control. What cannot be said in this "
                       "dialect stays as a comment, and is reported with its line and the reason.",
                       "Con --from isofmt traduce un programma di un altro controllo. Ciò che in questo dialetto non "
                       "si può dire resta come commento, e viene segnalato con la linea e la ragione."}},
       .exit =
           {{"0",
             {"Done; with --check and --diff, nothing would be changed.",
              "Fatto; con --check e --diff: non c'è nulla da cambiare."}},
            {"1",
             {"With --check or --diff: a program would be changed. With --from: something is left as a comment.",
              "Con --check o --diff: c'è un programma da cambiare. Con --from: qualcosa è rimasto come commento."}},
            {"2",
             {"A mistake in the command, in an isocnc.json or in a map, or something could not be read, translated or "
              "written.",
              "Un errore nel comando, in un isocnc.json o in una mappa, oppure qualcosa che non si è potuto leggere, "
              "tradurre o scrivere."}}},
       .see_also = {"isolint", "isorun"}});
  add_options(program, options);
  if (const auto status = program.answer(argc, argv)) return *status;
  return format(options);
}

}  // namespace
}  // namespace isocnc::analyzer

int main(int argc, char** argv) {
  return isocnc::command_line::program_main("isofmt", isocnc::analyzer::run_main, argc, argv);
}
