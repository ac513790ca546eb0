#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "source_files.h"

/// That the sources stand as docs/architecture.md says: the test reads the page's own table of modules.
namespace isocnc::architecture {
namespace {

namespace fs = std::filesystem;

/// A row of the table: a folder, and the modules that it names as seen. What those see is seen, too.
struct Module {
  std::string folder;
  std::vector<std::string> sees;
};

/// All words between backquotes, in their order.
std::vector<std::string> quoted_in(const std::string& text) {
  static const std::regex kQuoted("`([^`]*)`");
  std::vector<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), kQuoted); it != std::sregex_iterator(); ++it)
    words.push_back((*it)[1]);
  return words;
}

/// The rows of C++ modules: `| `folder` | what it holds | `folder`, `folder` |`.
std::vector<Module> modules() {
  static const std::regex kRow(R"(^\| `([a-z_/]+)` \|[^|]*\|([^|]*)\|$)");
  std::vector<Module> rows;
  std::istringstream lines(read("docs/architecture.md"));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kRow)) rows.push_back({match[1], quoted_in(match[2])});
  }
  return rows;
}

bool lies_in(const std::string& path, const std::string& folder) { return path.starts_with(folder + "/"); }

/// The module of a file. The sources of one operating system belong to the folder that theirs lies in.
std::string folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  const std::string name = folder.filename();
  const bool is_of_one_system = name == "posix" || name == "windows" || name == "web";
  return is_of_one_system ? folder.parent_path() : folder;
}

/// For each module, all that it sees: itself, what its row names, and what those see.
std::map<std::string, std::set<std::string>> all_seen() {
  std::map<std::string, std::set<std::string>> seen;
  for (const Module& module : modules()) {
    std::set<std::string>& own = seen[module.folder];
    own.insert(module.folder);
    for (const std::string& name : module.sees) own.insert(seen[name].begin(), seen[name].end());
  }
  return seen;
}

TEST(Architecture, EveryModuleSeesOnlyWhatIsListedAboveIt) {
  std::set<std::string> above;
  for (const Module& module : modules()) {
    for (const std::string& name : module.sees)
      EXPECT_TRUE(above.contains(name)) << module.folder << " sees " << name << ", which has no row above it";
    EXPECT_TRUE(above.insert(module.folder).second) << module.folder << " has two rows";
  }
  EXPECT_GT(above.size(), 25U);
}

TEST(Architecture, EveryFolderOfSourcesHasARowAndEveryRowAFolder) {
  std::set<std::string> folders;
  for (const std::string& file : sources()) folders.insert(folder_of(file));
  std::set<std::string> rows;
  for (const Module& module : modules()) rows.insert(module.folder);
  EXPECT_EQ(folders, rows);
}

TEST(Architecture, EveryIncludeIsOfAModuleThatTheTableNames) {
  const auto seen = all_seen();
  for (const std::string& file : sources()) {
    const std::set<std::string>& allowed = seen.at(folder_of(file));
    for (const Include& include : includes_of(file)) {
      if (!include.is_ours) continue;
      EXPECT_TRUE(fs::exists(kRoot / include.header))
          << file << " includes " << include.header << ": write it from the root of the repository";
      EXPECT_TRUE(allowed.contains(folder_of(include.header))) << file << " must not include " << include.header;
    }
  }
}

/// A module that the table names and no file includes would be an arrow in the drawing that is not there.
TEST(Architecture, EveryModuleThatTheTableNamesIsIncluded) {
  const auto seen = all_seen();
  std::map<std::string, std::set<std::string>> included;
  for (const std::string& file : sources())
    for (const Include& include : includes_of(file))
      if (include.is_ours) included[folder_of(file)].insert(folder_of(include.header));
  for (const Module& module : modules())
    for (const std::string& name : module.sees) {
      const std::set<std::string>& through = seen.at(name);
      EXPECT_TRUE(std::any_of(through.begin(), through.end(),
                              [&](const std::string& each) { return included[module.folder].contains(each); }))
          << module.folder << " includes nothing of " << name;
    }
}

/// The libraries are linked as the table says.
TEST(Architecture, EveryLibraryLinksTheModulesOfItsRow) {
  const std::string text = read("CMakeLists.txt");
  for (const Module& module : modules()) {
    const std::regex call("\nisocnc_library\\(" + module.folder + "[ \n]([^)]*)\\)");
    std::smatch match;
    if (!std::regex_search(text, match, call)) continue;  // The folder of a program without a library of its own.
    std::set<std::string> linked;
    static const std::regex kOurs("isocnc::([a-z_]+)");
    const std::string links = match[1];
    for (std::sregex_iterator it(links.begin(), links.end(), kOurs); it != std::sregex_iterator(); ++it)
      if ((*it)[1] != "fmt") linked.insert((*it)[1]);
    std::set<std::string> named;
    for (const std::string& name : module.sees) named.insert(fs::path(name).filename());
    EXPECT_EQ(linked, named) << module.folder;
  }
}

/// The names in backquotes on a line of the list under "What is absent" that ends in these words.
std::vector<std::string> names_on_line_that(const std::string& words) {
  std::istringstream lines(read("docs/architecture.md"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("- ") && line.ends_with(words)) return quoted_in(line);
  return {};
}

TEST(Architecture, QuietModulesKnowNoFileScreenThreadOrProtocol) {
  static const std::set<std::string> kLoudHeaders = {"iostream", "fstream", "filesystem", "thread", "cstdio"};
  const std::vector<std::string> quiet = names_on_line_that(" know no file, screen, thread or protocol, and no JSON.");
  EXPECT_GT(quiet.size(), 5U);
  for (const std::string& file : sources()) {
    if (std::none_of(quiet.begin(), quiet.end(), [&](const std::string& folder) { return lies_in(file, folder); }))
      continue;
    for (const Include& include : includes_of(file)) {
      EXPECT_FALSE(kLoudHeaders.contains(include.header)) << file << " includes " << include.header;
      EXPECT_FALSE(include.header.starts_with("nlohmann/")) << file << " includes " << include.header;
    }
  }
}

TEST(Architecture, PrivateHeadersAreIncludedByTheirFolderAlone) {
  const std::vector<std::string> headers = names_on_line_that(" are private: no other folder includes them.");
  EXPECT_GT(headers.size(), 1U);
  for (const std::string& header : headers) EXPECT_TRUE(fs::exists(kRoot / header)) << header;
  for (const std::string& file : sources())
    for (const Include& include : includes_of(file))
      if (std::find(headers.begin(), headers.end(), include.header) != headers.end()) {
        EXPECT_EQ(folder_of(file), folder_of(include.header)) << file << " includes " << include.header;
      }
}

/// Large folders hide their subjects. A folder of parts, one file for each, may be as large as it likes.
TEST(Architecture, NoFolderIsCrowded) {
  const std::set<std::string> folders_of_parts = {"analyzer/rules", "debugger/requests"};
  std::map<std::string, std::size_t> files;
  for (const std::string& file : sources()) ++files[fs::path(file).parent_path()];
  for (const auto& [folder, count] : files)
    EXPECT_TRUE(count <= 25 || folders_of_parts.contains(folder)) << folder << " has " << count << " files";
}

/// So a clock that jumps cannot matter: durations are taken by the steady clock, and of files' times only whether they
/// are the same.
TEST(Architecture, NoSourceAsksForTheTimeOfDay) {
  static const std::regex kTimeOfDay(
      R"(system_clock|CLOCK_REALTIME|gettimeofday|localtime|gmtime|\btime\((NULL|nullptr|0|&)|std::time\b|file_clock|high_resolution_clock)");
  ASSERT_TRUE(std::regex_search(std::string("const auto t = ::time(nullptr);"), kTimeOfDay));
  for (const std::string& file : sources()) EXPECT_FALSE(std::regex_search(read(file), kTimeOfDay)) << file;
}

/// So that a port to another system has one place.
TEST(Architecture, OneModuleKnowsOperatingSystems) {
  static const std::regex kHeader(
      R"((sys|net|netinet|arpa)/.*|unistd\.h|fcntl\.h|poll\.h|sched\.h|malloc\.h|termios\.h|csignal|signal\.h|)"
      R"(windows\.h|winsock2\.h|ws2tcpip\.h|io\.h|emscripten\.h)");
  static const std::regex kCondition(R"(#\s*(el)?ifn?(def)?\b.*\b(_WIN32|__unix__|__linux__|__EMSCRIPTEN__))");
  int count = 0;
  for (const std::string& file : sources()) {
    const bool is_of_system = folder_of(file) == "interpreter/system";
    for (const Include& include : includes_of(file)) {
      if (!std::regex_match(include.header, kHeader)) continue;
      ++count;
      EXPECT_TRUE(is_of_system && !file.ends_with(".h")) << file << " includes " << include.header;
    }
    EXPECT_FALSE(std::regex_search(read(file), kCondition)) << file << " asks which system it is compiled for";
  }
  EXPECT_GT(count, 10);
}

TEST(Architecture, OneFileKnowsTheLibraryOfCommandLines) {
  for (const std::string& file : sources())
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(!include.header.starts_with("CLI/") || file == "interpreter/command_line/program_app.cpp") << file;
}

/// So the compiler lists every place that a new role concerns.
TEST(Architecture, NoSwitchOverTheRolesOfGsHasADefault) {
  static const std::regex kSwitch(R"(switch \([^\n]*role\) \{[^}]*\})");
  int count = 0;
  for (const std::string& file : sources()) {
    const std::string text = read(file);
    for (std::sregex_iterator found(text.begin(), text.end(), kSwitch); found != std::sregex_iterator(); ++found) {
      ++count;
      EXPECT_EQ(found->str().find("default:"), std::string::npos) << file;
    }
  }
  EXPECT_GT(count, 1);
}

/// The modules that define a type of this name, each with what the name stands for there; the same alias counts once.
std::map<std::string, std::map<std::string, std::string>> owners_of_types() {
  std::map<std::string, std::map<std::string, std::string>> owners;
  for (const std::string& file : sources())
    for (const TypeDefinition& type : types_defined_in(file)) {
      if (type.alias.ends_with("::" + type.name)) continue;  // The same type, named without its class.
      const std::string meaning = type.alias.empty() ? folder_of(file) : "= " + type.alias;
      owners[type.name].emplace(meaning, file);
    }
  return owners;
}

/// So that a search for a type finds one owner.
TEST(Architecture, NoTypeNameHasOwnersInTwoModules) {
  const std::vector<std::string> shared = names_on_line_that(", which within a class lists the kinds of that class.");
  const auto owners = owners_of_types();
  EXPECT_GT(owners.size(), 500U);
  EXPECT_EQ(owners.at("Clock").size(), 1U);
  for (const std::string& name : shared) EXPECT_GT(owners.at(name).size(), 1U) << name;
  for (const auto& [name, meanings] : owners) {
    if (meanings.size() == 1 || std::count(shared.begin(), shared.end(), name) != 0) continue;
    std::string places;
    for (const auto& [meaning, file] : meanings) places += "\n  " + file;
    ADD_FAILURE() << name << " is defined in" << places;
  }
}

TEST(Architecture, EveryHeaderIsReadOnce) {
  for (const std::string& file : sources()) {
    if (!file.ends_with(".h")) continue;
    EXPECT_TRUE(read(file).starts_with("#pragma once\n")) << file;
  }
}

}  // namespace
}  // namespace isocnc::architecture
