#include "interpreter/command_line/program_app.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "interpreter/command_line/program_main.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/dialect/format.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/dialect/near_names.h"
#include "interpreter/system/user_language.h"

namespace isocnc::command_line {

using dialect::Language;
using dialect::Text;

static bool is_hidden(const CLI::Option& option) { return option.get_group().empty(); }
static bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

ProgramOption ProgramOption::required() const { return with(option_->required()); }

ProgramOption ProgramOption::excludes(ProgramOption other) const { return with(option_->excludes(other.option_)); }

ProgramOption ProgramOption::needs(ProgramOption other) const { return with(option_->needs(other.option_)); }

ProgramOption ProgramOption::without_exclusions() const { return with(option_->option_text(" ")); }

ProgramOption ProgramOption::takes_one() const { return with(option_->allow_extra_args(false)); }

ProgramOption ProgramOption::in_range(std::uint64_t minimum, std::uint64_t maximum) const {
  static constexpr Text kNotInRange = {"{} is not a whole number from {} to {}",
                                       "{} non è un numero intero da {} a {}"};
  return check([minimum, maximum](const std::string& given, Language language) -> std::string {
    std::uint64_t number = 0;
    const char* const end = given.data() + given.size();
    const auto [parsed_end, error] = std::from_chars(given.data(), end, number);
    if (error == std::errc() && parsed_end == end && minimum <= number && number <= maximum) return {};
    return dialect::format(kNotInRange, language, given, minimum, maximum);
  });
}

ProgramOption ProgramOption::check(std::function<std::string(const std::string&, Language)> find_fault) const {
  return with(option_->check([find_fault = std::move(find_fault), language = language_](
                                 const std::string& given) -> std::string { return find_fault(given, language); }));
}

ProgramOption ProgramOption::hidden() const { return with(option_->group("")); }

/// Whether the manual page is requested: by the first word, or by the first one after `--lang`.
static bool requests_manual_page(int argc, const char* const* argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  const int at = first == "--lang" ? 3 : first.starts_with("--lang=") ? 2 : 1;
  return argc > at && std::string_view(argv[at]) == "--manual-page";
}

/// The language given by `--lang`, otherwise by the environment. Words after -- are not options.
static Language language_of_command(int argc, const char* const* argv) {
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string_view argument = argv[i];
    const std::string_view next = i + 1 < argc ? argv[i + 1] : "";
    const std::string_view value = argument == "--lang"              ? next
                                   : argument.starts_with("--lang=") ? argument.substr(argument.find('=') + 1)
                                                                     : "";
    if (const auto language = dialect::language_named(value)) return *language;
  }
  return requests_manual_page(argc, argv) ? Language::English : system::user_language();
}

ProgramApp::ProgramApp(int argc, const char* const* argv, const Text& description, ManualTexts texts)
    : language_(language_of_command(argc, argv)),
      app_(std::make_unique<CLI::App>(text(description), texts.program)),
      texts_(std::move(texts)) {
  static constexpr Text kHelp = {"Print this help message and exit", "Mostra questo aiuto"};
  static constexpr Text kVersion = {"Display program version information and exit", "Mostra la versione del programma"};
  app_->set_help_flag("-h,--help", text(kHelp));
  app_->set_version_flag("--version", fmt::format("{} {}", texts_.program, texts_.version), text(kVersion));
  app_->get_formatter()->column_width(27);
  app_->allow_windows_style_options(false);  // /programs/part.iso is a file on Windows, too.
  if (language_ == Language::Italian) speak_italian();
}

ProgramApp::~ProgramApp() = default;

/// Translates the library's own words in --help.
void ProgramApp::speak_italian() {
  static constexpr std::pair<const char*, const char*> kLabels[] = {
      {"Usage", "Uso"},       {"Positionals", "Argomenti"}, {"OPTIONS", "OPZIONI"},
      {"Options", "Opzioni"}, {"Needs", "Richiede"},        {"Excludes", "Esclude"}};
  for (const auto& [english, italian] : kLabels) app_->get_formatter()->label(english, italian);
  app_->option_defaults()->group("Opzioni");
  for (CLI::Option* const option : app_->get_options()) option->group("Opzioni");
}

void ProgramApp::begin_group(const Text& heading) { app_->option_defaults()->group(text(heading)); }

template <class Value>
ProgramOption ProgramApp::add_option(const std::string& names, Value& value, const Text& value_name,
                                     const Text& description) {
  CLI::Option* const added = app_->add_option(names, value, text(description))->option_text(text(value_name));
  const ProgramOption option(added, language_);
  if constexpr (std::is_same_v<Value, std::optional<std::size_t>>) option.in_range(0, 999'999'999);
  if constexpr (std::is_same_v<Value, std::optional<std::uint16_t>>) option.in_range(0, 0xffff);
  return option;
}

// All types of values that the programs take.
template ProgramOption ProgramApp::add_option(const std::string&, std::string&, const Text&, const Text&);
template ProgramOption ProgramApp::add_option(const std::string&, std::optional<std::string>&, const Text&,
                                              const Text&);
template ProgramOption ProgramApp::add_option(const std::string&, std::vector<std::string>&, const Text&, const Text&);
template ProgramOption ProgramApp::add_option(const std::string&, int&, const Text&, const Text&);
template ProgramOption ProgramApp::add_option(const std::string&, std::optional<std::size_t>&, const Text&,
                                              const Text&);
template ProgramOption ProgramApp::add_option(const std::string&, std::optional<std::uint16_t>&, const Text&,
                                              const Text&);

ProgramOption ProgramApp::add_flag(const std::string& names, bool& value, const Text& description) {
  return ProgramOption(app_->add_flag(names, value, text(description)), language_);
}

static std::string no_such_choice(const std::string& given, const std::vector<std::string>& choices,
                                  Language language) {
  static constexpr Text kOnly = {"there is no {}, only {}{}", "{} non c'è, solo {}{}"};
  const bool is_number = !given.empty() && given.find_first_not_of("0123456789") == std::string::npos;
  // No suggestion for numbers: 99 is as near to 9 as to 19.
  const auto meant = is_number ? std::nullopt : dialect::nearest_name(given, choices);
  return dialect::format(kOnly, language, given, fmt::join(choices, ", "), dialect::did_you_mean(meant, language));
}

ProgramOption ProgramApp::add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                                     const Text& value_name, const Text& description) {
  suggest(name, choices);
  return add_option(name, value, value_name, description)
      .check([choices = std::move(choices)](const std::string& given, Language language) -> std::string {
        if (std::find(choices.begin(), choices.end(), given) != choices.end()) return {};
        return no_such_choice(given, choices, language);
      });
}

ProgramOption ProgramApp::add_language(std::string& value, const Text& description) {
  return add_choice("--lang", value, {std::begin(dialect::kLanguageNames), std::end(dialect::kLanguageNames)},
                    {"LANG", "LINGUA"}, description);
}

ProgramApp::CommandReply ProgramApp::read(int argc, const char* const* argv) {
  const std::string_view request = argc > 1 ? argv[1] : "";
  if (requests_manual_page(argc, argv)) return {.answer = manual_page(), .complaint = {}};
  if (request == "--complete")
    return {.answer = completions(argc > 3 ? argv[3] : "", argc > 4 ? argv[4] : ""), .complaint = {}};
  command_.assign(argv + std::min(argc, 1), argv + argc);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& success) {
    std::ostringstream said;
    app_->exit(success, said, said);
    std::string answer = said.str();
    // The library separates groups by two empty lines; one saves space on the screen.
    for (std::size_t at = 0; (at = answer.find("\n\n\n", at)) != std::string::npos;) answer.erase(at, 1);
    return {.answer = std::move(answer), .complaint = {}};
  } catch (const CLI::ParseError& error) {
    return {.answer = {}, .complaint = complaint_about(error)};
  }
  return {};
}

std::optional<system::ExitStatus> ProgramApp::answer(int argc, const char* const* argv) {
  const CommandReply said = read(argc, argv);
  if (said.answer) return say(texts_.program, *said.answer, language_);
  if (said.complaint) {
    complain_of_command(texts_.program, *said.complaint);
    return system::ExitStatus::Failure;
  }
  return std::nullopt;
}

using OptionList = std::vector<const CLI::Option*>;

static bool is_given(const CLI::Option& option) { return option.count() > 0; }

/// Two related options.
using Pair = std::pair<const CLI::Option*, const CLI::Option*>;

/// The first two given options that exclude each other.
static std::optional<Pair> excluded_pair(const OptionList& options) {
  for (const CLI::Option* const option : options)
    if (is_given(*option))
      for (const CLI::Option* const other : option->get_excludes())
        if (is_given(*other)) return Pair(option, other);
  return std::nullopt;
}

/// The first given option whose required option is missing, with that option.
static std::optional<Pair> lonely_pair(const OptionList& options) {
  for (const CLI::Option* const option : options)
    if (is_given(*option))
      for (const CLI::Option* const needed : option->get_needs())
        if (!is_given(*needed)) return Pair(option, needed);
  return std::nullopt;
}

static const CLI::Option* missing_option(const OptionList& options) {
  const auto missing = std::find_if(options.begin(), options.end(), [](const CLI::Option* option) {
    return option->get_required() && !is_given(*option);
  });
  return missing == options.end() ? nullptr : *missing;
}

/// The first option with one value that is given several.
static const CLI::Option* repeated_option(const OptionList& options) {
  const auto repeated = std::find_if(options.begin(), options.end(), [](const CLI::Option* option) {
    return takes_value(*option) &&
           option->results().size() > static_cast<std::size_t>(option->get_items_expected_max());
  });
  return repeated == options.end() ? nullptr : *repeated;
}

/// The option at the end of the command, if it lacks the value that it takes.
const CLI::Option* ProgramApp::option_without_value() const {
  if (command_.empty() || !command_.back().starts_with('-')) return nullptr;
  const CLI::Option* const option = app_->get_option_no_throw(command_.back());
  return option != nullptr && takes_value(*option) ? option : nullptr;
}

/// `no such option: --frmt; did you mean --format?`
std::string ProgramApp::no_such_option(const std::string& word) const {
  static constexpr Text kNoSuchOption = {"no such option", "opzione sconosciuta"};
  std::vector<std::string> names;
  for (const CLI::Option* const option : app_->get_options()) {
    if (is_hidden(*option)) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string given = word.substr(0, word.find('='));
  return fmt::format("{}: {}{}", kNoSuchOption.in(language_), given,
                     dialect::did_you_mean(dialect::nearest_name(given, names), language_));
}

/// The error of the command, in the user's language. The library's exception gives the kind of the error; its subject
/// is looked up in the options, so that no sentence of the library is parsed.
std::string ProgramApp::complaint_about(const CLI::ParseError& error) const {
  static constexpr Text kExclude = {"{} excludes {}", "{} e {} si escludono"};
  static constexpr Text kNeeds = {"{} requires {}", "{} richiede {}"};
  static constexpr Text kMissing = {"{} is required", "manca un argomento obbligatorio: {}"};
  static constexpr Text kExtra = {"unexpected argument: {}", "argomento di troppo: {}"};
  static constexpr Text kGivenTwice = {"{}: given more than once", "{}: dato più di una volta"};
  static constexpr Text kNoValue = {"{}: the value is missing", "{}: manca il valore"};
  const std::vector<std::string> unexpected = app_->remaining();
  if (!unexpected.empty() && unexpected.front().starts_with('-')) return no_such_option(unexpected.front());
  const OptionList options = std::as_const(*app_).get_options();
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    if (const auto pair = excluded_pair(options))
      return dialect::format(kExclude, language_, pair->first->get_name(), pair->second->get_name());
  } else if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    if (const auto pair = lonely_pair(options))
      return dialect::format(kNeeds, language_, pair->first->get_name(), pair->second->get_name());
  } else if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    if (const auto* const option = missing_option(options))
      return dialect::format(kMissing, language_, option->get_name());
  } else if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr && !unexpected.empty()) {
    return dialect::format(kExtra, language_, unexpected.front());
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    if (const auto* const option = repeated_option(options))
      return dialect::format(kGivenTwice, language_, option->get_name());
    if (const auto* const option = option_without_value())
      return dialect::format(kNoValue, language_, option->get_name());
  }
  return error.what();  // The name of an option, and the message of its check.
}

std::string ProgramApp::completions(std::string_view word, std::string_view previous) const {
  std::string lines;
  const CLI::Option* const before =
      previous.starts_with('-') ? app_->get_option_no_throw(std::string(previous)) : nullptr;
  if (before != nullptr && takes_value(*before)) {
    const auto words = words_.find("--" + before->get_lnames().front());
    if (words == words_.end()) return lines;
    const std::size_t last = word.find_last_of(',') + 1;  // 0 if there is no comma.
    for (const std::string_view each : words->second)
      if (dialect::begins_with(each, word.substr(last))) lines += fmt::format("{}{}\n", word.substr(0, last), each);
    return lines;
  }
  if (!word.starts_with('-')) return lines;
  for (const CLI::Option* const option : app_->get_options()) {
    if (is_hidden(*option)) continue;
    for (const std::string& name : option->get_lnames())
      if (("--" + name).starts_with(word)) lines += fmt::format("--{}\n", name);
  }
  return lines;
}

/// Escapes dashes, and lines that start like a roff request.
static std::string roff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (escaped.empty() && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\' || c == '-') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

static std::string roff_names(const CLI::Option& option) {
  std::string names;
  const auto add = [&](std::string_view dashes, const std::vector<std::string>& all) {
    for (const std::string& name : all)
      names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(fmt::format("{}{}", dashes, name)));
  };
  add("-", option.get_snames());
  add("--", option.get_lnames());
  if (names.empty()) return fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  const std::string value_name = option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  return takes_value(option) ? fmt::format("{} \\fI{}\\fR", names, roff(value_name)) : names;
}

std::string ProgramApp::manual_page() const {
  static constexpr Text kCollection = {"ISOCNC programs", "Programmi ISOCNC"};
  static constexpr Text kName = {"NAME", "NOME"};
  static constexpr Text kSynopsis = {"SYNOPSIS", "SINTASSI"};
  static constexpr Text kOptionsPlace = {"options", "opzioni"};
  static constexpr Text kDescription = {"DESCRIPTION", "DESCRIZIONE"};
  static constexpr Text kOptions = {"OPTIONS", "OPZIONI"};
  static constexpr Text kExitStatus = {"EXIT STATUS", "STATO D'USCITA"};
  static constexpr Text kSeeAlso = {"SEE ALSO", "VEDERE ANCHE"};
  std::string capitals = texts_.program;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(".TH {} 1 \"\" \"isocnc {}\" \"{}\"\n", capitals, texts_.version, text(kCollection));
  page += fmt::format(".SH {}\n{} \\- {}\n", text(kName), texts_.program, roff(text(texts_.purpose)));
  page += fmt::format(".SH {}\n\\fB{}\\fR [\\fI{}\\fR] {}\n", text(kSynopsis), texts_.program, text(kOptionsPlace),
                      roff(texts_.operands));
  page += fmt::format(".SH {}\n", text(kDescription));
  for (const Text& paragraph : texts_.paragraphs) page += fmt::format(".PP\n{}\n", roff(text(paragraph)));
  page += fmt::format(".SH {}\n", text(kOptions));
  for (const std::string& group : app_->get_groups()) {
    if (group.empty()) continue;
    page += fmt::format(".SS {}\n", roff(group));
    for (const CLI::Option* const option : app_->get_options())
      if (option->get_group() == group)
        page += fmt::format(".TP\n{}\n{}\n", roff_names(*option), roff(option->get_description()));
  }
  page += fmt::format(".SH {}\n", text(kExitStatus));
  for (const auto& [status, meaning] : texts_.exit) page += fmt::format(".TP\n{}\n{}\n", status, roff(text(meaning)));
  page += fmt::format(".SH {}\n", text(kSeeAlso));
  for (std::size_t i = 0; i < texts_.see_also.size(); ++i)
    page += fmt::format("\\fB{}\\fR(1){}\n", texts_.see_also[i], i + 1 < texts_.see_also.size() ? "," : "");
  return page;
}

}  // namespace isocnc::command_line
