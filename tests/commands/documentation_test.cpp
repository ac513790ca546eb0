#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "run_command.h"
#include "tests/support/temporary_folder.h"

/// Whether the commands that the documentation shows run, and answer as it shows.
namespace isocnc::commands {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ISOCNC_SOURCE_DIR;
const std::string kPrompt = "$ ";
const std::string kCut = "...\n";  ///< Stands for lines that are not shown.

/// A command line, and what is shown to come of it; nothing where only the command is.
struct Shown {
  std::string command;
  std::string answer;
};

/// What is shown in a block of a shell: all lines of ```sh, and those after a prompt elsewhere.
std::vector<Shown> shown_in(const fs::path& document) {
  std::vector<Shown> all;
  std::ifstream lines(document);
  bool is_code = false;
  bool is_shell = false;
  bool answers = false;  // The line may belong to the answer of the last command.
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      is_code = !is_code;
      is_shell = line == "```sh";
      answers = false;
    } else if (is_code && line.starts_with(kPrompt)) {
      all.push_back({.command = line.substr(kPrompt.size()), .answer = {}});
      answers = true;
    } else if (is_code && is_shell) {
      all.push_back({.command = line.substr(0, line.find("  #")), .answer = {}});
    } else if (answers) {
      all.back().answer += line + "\n";
    }
  }
  return all;
}

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream input(command);
  return {std::istream_iterator<std::string>(input), {}};
}

/// The words of a command that is one of our programs and nothing else; no words for others.
std::vector<std::string> our_command(const std::string& command) {
  static const std::set<std::string> kOurs = {"isolint", "isofmt", "isorun", "isodiff"};
  std::vector<std::string> words = words_of(command);
  if (words.empty() || command.find_first_of("|>;&~'\"") != std::string::npos) return {};
  if (command.find(" --watch") != std::string::npos) return {};  // It does not end: watch_test.py.
  if (words[0].starts_with("scripts/")) words[0].erase(0, std::string("scripts/").size());
  return kOurs.contains(words[0]) ? words : std::vector<std::string>{};
}

/// Whether `shown` is in `output`, with something left out at each cut.
bool answers_so(std::string output, std::string shown) {
  while (true) {
    const std::size_t cut = shown.find(kCut);
    const std::string piece = shown.substr(0, cut);
    const std::size_t at = output.find(piece);
    if (at == std::string::npos) return false;
    output.erase(0, at + piece.size());
    if (cut == std::string::npos) return true;
    shown.erase(0, cut + kCut.size());
  }
}

std::vector<std::string> documents() {
  std::vector<std::string> names = {"README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") names.push_back(fs::relative(entry.path(), kRoot));
  std::sort(names.begin(), names.end());
  return names;
}

class Documentation : public testing::TestWithParam<std::string> {};

TEST_P(Documentation, CommandsRunAndAnswerAsShown) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"examples", "posts"})
    fs::copy(kRoot / name, folder.path(name), fs::copy_options::recursive);
  fs::create_directory(folder.path("build"));
  for (const Shown& shown : shown_in(kRoot / GetParam())) {
    const std::vector<std::string> words = words_of(shown.command);
    if (words.size() == 2 && words[0] == "cat") folder.write(words[1], shown.answer);
    const std::vector<std::string> ours = our_command(shown.command);
    if (ours.empty()) continue;
    const CommandResult result = run_command(ours, {.folder = folder.path()});
    EXPECT_THAT(result.status, testing::AnyOf(0, 1)) << shown.command << "\n" << result.err;
    EXPECT_TRUE(answers_so(result.out + result.err, shown.answer))
        << shown.command << "\n"
        << result.out << result.err << "\nwhere it is shown to answer\n"
        << shown.answer;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Documentation, testing::ValuesIn(documents()));

TEST(DocumentationTest, ShowsCommands) {
  std::size_t ours = 0;
  for (const std::string& document : documents())
    for (const Shown& shown : shown_in(kRoot / document)) ours += our_command(shown.command).empty() ? 0 : 1;
  EXPECT_GT(ours, 20U);
}

}  // namespace
}  // namespace isocnc::commands
