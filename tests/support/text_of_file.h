#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace isocnc {

/// All bytes of a file; empty if it cannot be read.
inline std::string text_of_file(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace isocnc
