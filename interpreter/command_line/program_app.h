#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/exit_status.h"

// The library that reads command lines takes long to compile: program_app.cpp alone does.
namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace isocnc::command_line {

/// What a manual page says beside what `--help` says.
struct ManualTexts {
  std::string program;
  std::string version;
  std::string purpose;                                              ///< `check ISOCNC programs`
  std::string operands;                                             ///< `PATH...`
  std::vector<std::string_view> paragraphs;                         ///< Of the description.
  std::vector<std::pair<std::string_view, std::string_view>> exit;  ///< `1`, what it means.
  std::vector<std::string_view> see_also;                           ///< `isofmt`
};

/// What the help calls a value that names a file.
inline constexpr dialect::Text kFileValue = {"FILE", "FILE"};

/// An option, as its program goes on to describe it.
class ProgramOption {
 public:
  ProgramOption(CLI::Option* option, dialect::Language language) : option_(option), language_(language) {}

  ProgramOption required() const;
  /// Not both.
  ProgramOption excludes(ProgramOption other) const;
  /// Not without the other.
  ProgramOption needs(ProgramOption other) const;
  /// The help does not list what it excludes.
  ProgramOption without_exclusions() const;
  /// Takes one word each time that it is given: what follows is no value of its list.
  ProgramOption takes_one() const;
  /// A whole number within these limits.
  ProgramOption in_range(std::uint64_t minimum, std::uint64_t maximum) const;
  /// `find_fault` returns what is wrong with a value, in the language given, or nothing where it is right.
  ProgramOption check(std::function<std::string(const std::string&, dialect::Language)> find_fault) const;
  /// In no help, nor in the manual.
  ProgramOption hidden() const;

 private:
  ProgramOption with(CLI::Option* option) const { return {option, language_}; }

  CLI::Option* option_;
  dialect::Language language_;  // Of complaints.
};

/// The command line of one of the programs: its options, and what it answers by itself. `--help` and `--version`;
/// `--manual-page`, for man(1); `--complete PROGRAM WORD PREVIOUS`, as `complete -C` of bash calls it: what may stand
/// for the word, one on a line, and nothing where files are wanted.
class ProgramApp {
 public:
  /// Who is to read the help, or a complaint, is looked for in the command itself first (`--lang`), wherever it stands
  /// there; the manual page is English.
  ProgramApp(int argc, const char* const* argv, const dialect::Text& description, ManualTexts texts);
  ~ProgramApp();

  /// What is added from now on stands under this heading.
  void begin_group(const dialect::Text& heading);
  /// `-o,--output`, `--output` or, for what stands without a name, `PATH`. The value is one that the source file knows:
  /// a word or several, a number, or an optional one.
  template <class Value>
  ProgramOption add_option(const std::string& names, Value& value, const dialect::Text& value_name,
                           const dialect::Text& description);
  ProgramOption add_flag(const std::string& names, bool& value, const dialect::Text& description);
  /// An option that takes one of a few words.
  ProgramOption add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                           const dialect::Text& value_name, const dialect::Text& description);
  /// `--lang`, by the name of the language.
  ProgramOption add_language(std::string& value, const dialect::Text& description);
  /// Words to complete the value of an option with, given with its dashes; in a list with commas, each piece.
  void suggest(const std::string& option, std::vector<std::string> words) { words_[option] = std::move(words); }

  /// What is to be said in place of a run, if anything is.
  struct CommandReply {
    std::optional<std::string> answer;
    std::optional<std::string> complaint;  ///< With the option that was most likely meant.
  };
  CommandReply read(int argc, const char* const* argv);
  /// Reads the command, and says what is to be said: then the exit status. Nothing where the program is to run.
  std::optional<system::ExitStatus> answer(int argc, const char* const* argv);

 private:
  std::string text(const dialect::Text& text) const { return std::string(text.in(language_)); }
  std::string completions(std::string_view word, std::string_view previous) const;
  std::string manual_page() const;
  void speak_italian();
  const CLI::Option* option_without_value() const;
  bool is_option(const std::string& word) const;
  std::string no_such_option(const std::string& word) const;
  std::string complaint_about(const CLI::ParseError& error) const;

  const dialect::Language language_;
  const std::unique_ptr<CLI::App> app_;
  const ManualTexts texts_;
  std::map<std::string, std::vector<std::string>> words_;  // By option.
  std::vector<std::string> command_;                       // Without the name of the program.
};

}  // namespace isocnc::command_line
