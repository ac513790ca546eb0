#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "source_files.h"

/// That what is written down in documents and packages agrees with the sources.
namespace isocnc::architecture {
namespace {

namespace fs = std::filesystem;

/// What a command prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), &::pclose);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) text.push_back(static_cast<char>(c));
  return text;
}

TEST(Documentation, RulesPageIsTheTable) {
  const auto same = [](const std::string& page, const std::string& language) {
    return read(page) == output_of("'" ISOCNC_BIN_DIR "/isolint' --rules-page --lang " + language);
  };
  EXPECT_TRUE(same("docs/rules.md", "en")) << "isolint --rules-page > docs/rules.md";
  EXPECT_TRUE(same("docs/it/codici.md", "it")) << "isolint --lang it --rules-page > docs/it/codici.md";
}

TEST(Documentation, MessagesPageIsTheTable) {
  const bool same = read("docs/messages.md") == output_of("'" ISOCNC_BIN_DIR "/isolint' --messages-page");
  EXPECT_TRUE(same) << "isolint --messages-page > docs/messages.md";
}

TEST(Documentation, LanguageOfNotepadIsTheTable) {
  const bool same =
      read("cmake/windows/notepad++/isocnc.xml") == output_of("'" ISOCNC_BIN_DIR "/isolint' --notepad-language");
  EXPECT_TRUE(same) << "isolint --notepad-language > cmake/windows/notepad++/isocnc.xml";
}

TEST(Documentation, PagesOfOtherControlsAreTheTable) {
  for (const auto& [page, language] :
       {std::pair{"docs/other-controls.md", "en"}, std::pair{"docs/it/altri-controlli.md", "it"}}) {
    const std::string command = std::string("isolint --lang ") + language + " --foreign-page";
    const bool same = read(page) == output_of("'" ISOCNC_BIN_DIR "/'" + command);
    EXPECT_TRUE(same) << command << " > " << page;
  }
}

/// The text of a file after the first `before`, up to the next quote, blank or bracket.
std::string text_after(const std::string& before, const std::string& file) {
  const std::string text = read(file);
  const std::size_t found = text.find(before);
  if (found == std::string::npos) return {};
  const std::size_t at = found + before.size();
  return text.substr(at, text.find_first_of("\" ]\n", at) - at);
}

/// The changelog tells of each version; nothing else repeats the one that CMakeLists.txt states.
TEST(Documentation, VersionStandsInOnePlace) {
  const std::string version = text_after("project(isocnc VERSION ", "CMakeLists.txt");
  ASSERT_FALSE(version.empty());
  EXPECT_EQ(text_after("\n## [", "CHANGELOG.md"), version);
  std::vector<fs::path> files;
  for (const std::string folder : {".github", "cmake", "docs", "examples", "scripts"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  for (const std::string file :
       {"README.md", "CONTRIBUTING.md", "Dockerfile", "action.yml", ".gitlab-ci.yml", "vscode-extension/package.json",
        "vscode-extension/README.md", "web/package.json", "web/README.md"})
    files.push_back(kRoot / file);
  for (const fs::path& file : files) EXPECT_EQ(read(file).find(version), std::string::npos) << file;
  // In the lists of packages others may have the same version; ours is named in the first lines.
  for (const std::string file : {"vscode-extension/package-lock.json", "web/package-lock.json"}) {
    const std::string text = read(file);
    EXPECT_EQ(text.substr(0, text.find("node_modules/")).find(version), std::string::npos) << file;
  }
}

TEST(Documentation, ProgramsHaveTheSameExtensionsEverywhere) {
  static const std::regex kExtension(R"re("\.([a-z]+)")re");
  const std::string list = read("interpreter/configuration/configuration.h");
  const std::size_t begin = list.find("kProgramExtensions{");
  ASSERT_NE(begin, std::string::npos);
  const std::string extensions = list.substr(begin, list.find('}', begin) - begin);
  std::string either;
  for (std::sregex_iterator it(extensions.begin(), extensions.end(), kExtension); it != std::sregex_iterator(); ++it) {
    for (const std::string file :
         {"analyzer/command_line.cpp", "analyzer/isofmt.cpp", "docs/isolint.md", "docs/git.md"})
      EXPECT_NE(read(file).find("." + (*it)[1].str()), std::string::npos) << file << ": " << (*it)[1];
    either += (either.empty() ? "" : "|") + (*it)[1].str();
  }
  EXPECT_NE(read(".pre-commit-hooks.yaml").find("\\.(" + either + ")$"), std::string::npos) << either;
}

TEST(Documentation, NamesEveryMessageBeyondTheProtocols) {
  static const std::regex kOwn(R"re("(isocnc[/.][A-Za-z]+)")re");
  const std::string pages = read("docs/isols.md") + read(kRoot / "docs/isodap.md");
  std::set<std::string> own;
  for (const std::string& file : sources()) {
    const std::string text = read(file);
    for (std::sregex_iterator it(text.begin(), text.end(), kOwn); it != std::sregex_iterator(); ++it)
      if (file.starts_with("lsp/") || file.starts_with("debugger/")) own.insert((*it)[1]);
  }
  EXPECT_GT(own.size(), 6U);
  for (const std::string& name : own) EXPECT_NE(pages.find("`" + name + "`"), std::string::npos) << name;
}

/// The rows of the tables of docs/security.md.
TEST(Documentation, EachPromiseOfSecurityHasItsTest) {
  static const std::regex kPath("`(tests/[^`]*)`");
  std::istringstream page(read("docs/security.md"));
  std::size_t promises = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| ") || line == "| Promise | Test |") continue;
    ++promises;
    const std::string cell = line.substr(line.rfind(" | ", line.size() - 3));
    std::size_t tests = 0;
    for (std::sregex_iterator it(cell.begin(), cell.end(), kPath); it != std::sregex_iterator(); ++it, ++tests)
      EXPECT_TRUE(fs::exists(kRoot / (*it)[1].str())) << line;
    EXPECT_GT(tests, 0U) << line;
  }
  EXPECT_GT(promises, 20U);
}

/// What a package from a registry would run while it is installed, it could run as whoever builds.
TEST(Documentation, NoScriptOfAnNpmPackageRuns) {
  static const std::regex kInstall(R"re(npm\}?"?,? "?(ci|install|i)\b[^\n]*)re");
  std::vector<fs::path> files;
  for (const std::string folder : {"cmake", "scripts", ".github"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  for (const std::string tests : {"clients", "playground", "vscode"}) files.push_back(kRoot / "tests" / tests / "run");
  int count = 0;
  for (const fs::path& file : files) {
    const std::string text = read(file);
    for (std::sregex_iterator it(text.begin(), text.end(), kInstall); it != std::sregex_iterator(); ++it, ++count)
      EXPECT_NE(it->str().find("--ignore-scripts"), std::string::npos) << file << ": " << it->str();
  }
  EXPECT_GE(count, 8);
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
}  // namespace isocnc::architecture
