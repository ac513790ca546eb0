#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace isocnc::running {

/// The words that an option takes, by the option's long name with its dashes.
using Choices = std::map<std::string, std::vector<std::string>>;

/// What may stand for `word`, one on a line: options of the program, or the words that the option before it takes.
/// Nothing where files are wanted. Of a list with commas the last piece is completed.
std::string completions(const CLI::App& app, const Choices& choices, std::string_view word, std::string_view previous);

/// What a manual page says beside what `--help` says.
struct ManualTexts {
  std::string_view program;
  std::string_view purpose;  ///< `check ISOCNC programs`
  std::string_view version;
  std::vector<std::string_view> description;                                 ///< Paragraphs.
  std::vector<std::pair<std::string_view, std::string_view>> exit_statuses;  ///< `1`, what it means.
  std::vector<std::string_view> see_also;                                    ///< `isofmt`
};

/// The program's manual page for man(1), with its options by group. Hidden ones are left out.
std::string manual_page(const CLI::App& app, const ManualTexts& texts);

}  // namespace isocnc::running
