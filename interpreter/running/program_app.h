#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::running {

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

/// The command line of one of the programs: its options, and what it answers by itself. `--help` and `--version`;
/// `--manual-page`, for man(1); `--complete PROGRAM WORD PREVIOUS`, as `complete -C` of bash calls it: what may stand
/// for the word, one on a line, and nothing where files are wanted.
class ProgramApp {
 public:
  ProgramApp(std::string description, ManualTexts texts);

  CLI::App& options() { return app_; }
  /// An option that takes one of a few words.
  CLI::Option* add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                          const char* placeholder, const std::string& description);
  /// Words to complete the value of an option with, given with its dashes; in a list with commas, each piece.
  void suggest(const std::string& option, std::vector<std::string> words) { words_[option] = std::move(words); }

  /// What is to be said in place of a run, if anything is.
  struct Said {
    std::optional<std::string> answer;
    std::optional<std::string> complaint;  ///< With the option that was most likely meant.
  };
  /// `language` is asked once the options have been read as far as they can be.
  Said read(int argc, const char* const* argv, const std::function<dialect::Language()>& language);

 private:
  std::string completions(std::string_view word, std::string_view previous) const;
  std::string manual_page() const;
  std::string complaint_about(const CLI::ParseError& error, dialect::Language language) const;

  CLI::App app_;
  const ManualTexts texts_;
  std::map<std::string, std::vector<std::string>> words_;  // By option.
};

}  // namespace isocnc::running
