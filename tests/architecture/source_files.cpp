#include "source_files.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace isocnc::architecture {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream input(kRoot / file, std::ios::binary);
  std::stringstream text;
  text << input.rdbuf();
  return text.str();
}

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

std::vector<Include> includes_of(const std::string& file) {
  static const std::regex kInclude(R"(^ *# *include *([<"])([^>"]*)[>"])");
  std::vector<Include> includes;
  std::istringstream lines(read(file));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) includes.push_back({match[2], match[1] == "\""});
  }
  return includes;
}

}  // namespace isocnc::architecture
