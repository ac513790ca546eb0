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

// The CLI11 library takes long to compile, so only program_app.cpp includes it.
namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace isocnc::command_line {

/// The content of a manual page besides that of `--help`.
struct ManualTexts {
  std::string program;
  std::string version;
  dialect::Text purpose;                                         ///< `check ISOCNC programs`
  std::string operands;                                          ///< `PATH...`
  std::vector<dialect::Text> paragraphs;                         ///< Paragraphs of the description.
  std::vector<std::pair<std::string_view, dialect::Text>> exit;  ///< Exit statuses with their meaning.
  std::vector<std::string_view> see_also;                        ///< `isofmt`
};

/// The help's name for a value that is a file.
inline constexpr dialect::Text kFileValue = {"FILE", "FILE"};

/// An option that its program describes further.
class ProgramOption {
 public:
  ProgramOption(CLI::Option* option, dialect::Language language) : option_(option), language_(language) {}

  ProgramOption required() const;
  /// The two options exclude each other.
  ProgramOption excludes(ProgramOption other) const;
  /// This option requires the other.
  ProgramOption needs(ProgramOption other) const;
  /// Hides the excluded options in the help.
  ProgramOption without_exclusions() const;
  /// Takes one word per use; the next word is not part of its list.
  ProgramOption takes_one() const;
  /// Accepts whole numbers within these limits.
  ProgramOption in_range(std::uint64_t minimum, std::uint64_t maximum) const;
  /// Checks each value: `find_fault` returns the error in the given language, or an empty string for a valid value.
  ProgramOption check(std::function<std::string(const std::string&, dialect::Language)> find_fault) const;
  /// Hides the option in the help and the manual.
  ProgramOption hidden() const;

 private:
  ProgramOption with(CLI::Option* option) const { return {option, language_}; }

  CLI::Option* option_;
  dialect::Language language_;  // Language of error messages.
};

/// The command line of a program: its options, and the requests it answers itself. These are `--help` and `--version`;
/// `--manual-page`, for man(1), also after `--lang`; and `--complete PROGRAM WORD PREVIOUS`, as `complete -C` of bash
/// calls it: it prints the completions of the word, one per line, and nothing for file names.
class ProgramApp {
 public:
  /// Determines the language of the help and of errors from the command itself first (`--lang` at any position). The
  /// language of the manual page does not depend on the locale: English without `--lang`.
  ProgramApp(int argc, const char* const* argv, const dialect::Text& description, ManualTexts texts);
  ~ProgramApp();

  /// Puts all options added after this call under a heading.
  void begin_group(const dialect::Text& heading);
  /// Adds an option with names such as `-o,--output` or `--output`, or an operand such as `PATH`. The source file lists
  /// the types of values: one word, several words, a number, or an optional one.
  template <class Value>
  ProgramOption add_option(const std::string& names, Value& value, const dialect::Text& value_name,
                           const dialect::Text& description);
  ProgramOption add_flag(const std::string& names, bool& value, const dialect::Text& description);
  /// Adds an option that takes one of a few words.
  ProgramOption add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                           const dialect::Text& value_name, const dialect::Text& description);
  /// Adds `--lang`, which takes the name of a language.
  ProgramOption add_language(std::string& value, const dialect::Text& description);
  /// Sets the completions for the value of an option, which is given with its dashes; in a comma-separated list, for
  /// each element.
  void suggest(const std::string& option, std::vector<std::string> words) { words_[option] = std::move(words); }

  /// The text to print instead of a run, if any.
  struct CommandReply {
    std::optional<std::string> answer;
    std::optional<std::string> complaint;  ///< Error message, with the option that was most likely meant.
  };
  CommandReply read(int argc, const char* const* argv);
  /// Reads the command and prints the reply, if any. Returns the exit status, or nothing if the program is to run.
  std::optional<system::ExitStatus> answer(int argc, const char* const* argv);

 private:
  std::string text(const dialect::Text& text) const { return std::string(text.in(language_)); }
  std::string completions(std::string_view word, std::string_view previous) const;
  std::string manual_page() const;
  void speak_italian();
  const CLI::Option* option_without_value() const;
  std::string no_such_option(const std::string& word) const;
  std::string complaint_about(const CLI::ParseError& error) const;

  const dialect::Language language_;
  const std::unique_ptr<CLI::App> app_;
  const ManualTexts texts_;
  std::map<std::string, std::vector<std::string>> words_;  // Completions by option.
  std::vector<std::string> command_;                       // Arguments without the name of the program.
};

}  // namespace isocnc::command_line
