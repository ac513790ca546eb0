#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// Whether the house stands as docs/architecture.md draws it: who includes whom, and that what is written down
/// elsewhere agrees with the sources.
namespace isocnc::house {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ISOCNC_SOURCE_DIR;

/// A folder, with all below it, and the folders whose headers its files may include.
struct Room {
  std::string folder;
  std::vector<std::string> sees;
};

/// A file belongs to the first room that holds it. Programs stand in their wing, beside its folders, and see all of it.
const std::vector<Room> kHouse = {
    {"interpreter/dialect", {"interpreter/dialect"}},
    {"interpreter/syntax", {"interpreter/dialect", "interpreter/syntax"}},
    {"interpreter/geometry", {"interpreter/geometry"}},
    {"interpreter/execution",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution"}},
    {"interpreter/motion", {"interpreter/geometry", "interpreter/motion"}},
    {"interpreter/running",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution",
      "interpreter/motion", "interpreter/running"}},
    {"interpreter/configuration",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution",
      "interpreter/motion", "interpreter/running", "interpreter/configuration"}},
    {"interpreter", {"interpreter"}},
    {"analyzer/rules",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution", "analyzer/rules"}},
    {"analyzer/style", {"interpreter/dialect", "interpreter/syntax", "analyzer/style"}},
    {"analyzer/fixes",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution", "analyzer/fixes"}},
    {"analyzer",
     {"interpreter/dialect", "interpreter/syntax", "interpreter/geometry", "interpreter/execution",
      "interpreter/running", "interpreter/configuration", "analyzer"}},
    {"lsp/rpc", {"lsp/rpc"}},
    {"lsp/documents", {"interpreter", "analyzer", "lsp/rpc", "lsp/documents"}},
    {"lsp/features", {"interpreter", "analyzer", "lsp/rpc", "lsp/documents", "lsp/features"}},
    {"lsp", {"interpreter", "analyzer", "lsp"}},
    {"debugger/session", {"interpreter", "analyzer", "lsp/rpc", "debugger/session"}},
    {"debugger/requests", {"interpreter", "analyzer", "lsp/rpc", "debugger/session", "debugger/requests"}},
    {"debugger", {"interpreter", "analyzer", "lsp/rpc", "debugger"}},
};

/// The part of the house that knows no file, screen, thread or protocol.
const std::vector<std::string> kQuietFolders = {"interpreter/dialect",   "interpreter/syntax", "interpreter/geometry",
                                                "interpreter/execution", "interpreter/motion", "analyzer/fixes"};
const std::set<std::string> kLoudHeaders = {"iostream", "fstream", "filesystem", "thread", "cstdio"};

std::string read(const fs::path& file) {
  std::ifstream input(file, std::ios::binary);
  std::stringstream text;
  text << input.rdbuf();
  return text.str();
}

/// Whether `path` is `folder` or lies below it.
bool lies_in(const std::string& path, const std::string& folder) {
  return path == folder || path.starts_with(folder + "/");
}

/// The C++ files of the house, as paths from its root.
std::vector<std::string> sources() {
  std::vector<std::string> files;
  for (const std::string wing : {"interpreter", "analyzer", "lsp", "debugger"}) {
    if (!fs::exists(kRoot / wing)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / wing)) {
      const std::string extension = entry.path().extension();
      if (extension == ".h" || extension == ".cpp") files.push_back(fs::relative(entry.path(), kRoot));
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Include {
  std::string header;
  bool ours = false;  ///< In quotes.
};

std::vector<Include> includes_of(const std::string& file) {
  static const std::regex kInclude(R"(^ *# *include *([<"])([^>"]*)[>"])");
  std::vector<Include> includes;
  std::istringstream lines(read(kRoot / file));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) includes.push_back({match[2], match[1] == "\""});
  }
  return includes;
}

TEST(House, EveryIncludePointsWhereItMay) {
  for (const std::string& file : sources()) {
    const auto room =
        std::find_if(kHouse.begin(), kHouse.end(), [&](const Room& each) { return lies_in(file, each.folder); });
    ASSERT_NE(room, kHouse.end()) << file;
    for (const Include& include : includes_of(file)) {
      if (!include.ours) continue;
      EXPECT_TRUE(fs::exists(kRoot / include.header))
          << file << " includes " << include.header << ": write it from the root of the repository";
      EXPECT_TRUE(std::any_of(room->sees.begin(), room->sees.end(),
                              [&](const std::string& folder) { return lies_in(include.header, folder); }))
          << file << " must not include " << include.header;
    }
  }
}

TEST(House, QuietFoldersKnowNoFileScreenThreadOrProtocol) {
  for (const std::string& file : sources()) {
    if (std::none_of(kQuietFolders.begin(), kQuietFolders.end(),
                     [&](const std::string& folder) { return lies_in(file, folder); }))
      continue;
    for (const Include& include : includes_of(file)) {
      EXPECT_FALSE(kLoudHeaders.contains(include.header)) << file << " includes " << include.header;
      EXPECT_FALSE(include.header.starts_with("nlohmann/")) << file << " includes " << include.header;
    }
  }
}

/// So a clock that jumps cannot matter: durations are taken by the steady clock, and of files' times only whether they
/// are the same.
TEST(House, NobodyAsksWhatTimeItIs) {
  static const std::regex kTimeOfDay(
      R"(system_clock|CLOCK_REALTIME|gettimeofday|localtime|gmtime|\btime\((NULL|nullptr|0|&)|std::time\b|file_clock|high_resolution_clock)");
  ASSERT_TRUE(std::regex_search(std::string("const auto t = ::time(nullptr);"), kTimeOfDay));
  for (const std::string& file : sources()) EXPECT_FALSE(std::regex_search(read(kRoot / file), kTimeOfDay)) << file;
}

TEST(House, OneFileKnowsTheLibraryOfCommandLines) {
  for (const std::string& file : sources())
    for (const Include& include : includes_of(file))
      EXPECT_TRUE(!include.header.starts_with("CLI/") || file == "interpreter/running/program_app.cpp") << file;
}

TEST(House, EveryHeaderIsReadOnce) {
  for (const std::string& file : sources()) {
    if (!file.ends_with(".h")) continue;
    EXPECT_TRUE(read(kRoot / file).starts_with("#pragma once\n")) << file;
  }
}

/// What a command prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text.push_back(static_cast<char>(c));
  return text;
}

TEST(Documentation, RulesPageIsTheTable) {
  const bool same = read(kRoot / "docs/rules.md") == output_of("'" ISOCNC_BIN_DIR "/isolint' --rules-page");
  EXPECT_TRUE(same) << "isolint --rules-page > docs/rules.md";
}

/// What a file says first behind `before`, up to the next quote, blank or bracket.
std::string said_behind(const std::string& before, const std::string& file) {
  const std::string text = read(kRoot / file);
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) return {};
  const std::size_t at = begin + before.size();
  return text.substr(at, text.find_first_of("\" ]\n", at) - at);
}

TEST(Documentation, VersionIsThatOfTheBuild) {
  const std::string version = said_behind("project(isocnc VERSION ", "CMakeLists.txt");
  ASSERT_FALSE(version.empty());
  EXPECT_EQ(said_behind("\"version\": \"", "vscode-extension/package.json"), version);
  EXPECT_EQ(said_behind("\n## [", "CHANGELOG.md"), version);
  EXPECT_EQ(said_behind("find_package(isocnc ", "examples/library/CMakeLists.txt"),
            version.substr(0, version.rfind('.')));
}

TEST(Documentation, ProgramsHaveTheSameExtensionsEverywhere) {
  static const std::regex kExtension(R"re("\.([a-z]+)")re");
  const std::string list = read(kRoot / "interpreter/configuration/configuration.h");
  const std::size_t begin = list.find("kProgramExtensions{");
  ASSERT_NE(begin, std::string::npos);
  const std::string extensions = list.substr(begin, list.find('}', begin) - begin);
  std::string either;
  for (std::sregex_iterator it(extensions.begin(), extensions.end(), kExtension); it != std::sregex_iterator(); ++it) {
    for (const std::string file :
         {"analyzer/command_line.cpp", "analyzer/isofmt.cpp", "docs/isolint.md", "docs/git.md"})
      EXPECT_NE(read(kRoot / file).find("." + (*it)[1].str()), std::string::npos) << file << ": " << (*it)[1];
    either += (either.empty() ? "" : "|") + (*it)[1].str();
  }
  EXPECT_NE(read(kRoot / ".pre-commit-hooks.yaml").find("\\.(" + either + ")$"), std::string::npos) << either;
}

TEST(Documentation, TellsOfMessagesBeyondTheProtocols) {
  static const std::regex kOwn(R"re("(isocnc[/.][A-Za-z]+)")re");
  const std::string pages = read(kRoot / "docs/isols.md") + read(kRoot / "docs/isodap.md");
  std::set<std::string> own;
  for (const std::string& file : sources()) {
    const std::string text = read(kRoot / file);
    for (std::sregex_iterator it(text.begin(), text.end(), kOwn); it != std::sregex_iterator(); ++it)
      if (file.starts_with("lsp/") || file.starts_with("debugger/")) own.insert((*it)[1]);
  }
  EXPECT_GT(own.size(), 6U);
  for (const std::string& name : own) EXPECT_NE(pages.find("`" + name + "`"), std::string::npos) << name;
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files;
  for (const std::string folder : {".", "docs", "docs/it", "bench", "examples/ci"})
    for (const auto& entry : fs::directory_iterator(kRoot / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// The text of a document without its fenced code.
std::string prose_of(const fs::path& document) {
  std::istringstream lines(read(document));
  std::string prose;
  bool is_code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_code) prose += line + "\n";
  }
  return prose;
}

/// The anchors of a document's headings, as GitHub makes them.
std::set<std::string> anchors_of(const fs::path& document) {
  std::set<std::string> anchors;
  std::istringstream lines(prose_of(document));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == ' ') anchor += '-';
      if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
        anchor += static_cast<char>(std::tolower(byte));
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Documentation, LinksLeadSomewhere) {
  static const std::regex kLink(R"(\]\(([^)#\s]*)(?:#([^)\s]*))?\))");
  for (const fs::path& document : documents()) {
    const std::string prose = prose_of(document);
    for (std::sregex_iterator it(prose.begin(), prose.end(), kLink); it != std::sregex_iterator(); ++it) {
      const std::string path = (*it)[1];
      const std::string anchor = (*it)[2];
      if (path.find("://") != std::string::npos) continue;
      const fs::path target = path.empty() ? document : document.parent_path() / path;
      EXPECT_TRUE(fs::exists(target)) << document << " links to " << path;
      if (anchor.empty() || target.extension() != ".md") continue;
      EXPECT_TRUE(anchors_of(target).contains(anchor)) << document << " links to " << path << "#" << anchor;
    }
  }
}

}  // namespace
}  // namespace isocnc::house
