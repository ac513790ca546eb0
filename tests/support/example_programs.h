#pragma once

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tests/support/random.h"

namespace isocnc::support {

/// All programs in examples/, in order; with sanitizers or without optimization without those that then take minutes to
/// verify: motions along the faces of a finished part.
inline std::vector<std::filesystem::path> example_programs() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    const bool is_slow = entry.path().filename() == "tilted.iso" && !kTriesAll;
    if (entry.path().extension() == ".iso" && !is_slow) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace isocnc::support
