#pragma once

#include <string_view>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

/// No configuration is longer, in bytes.
inline constexpr std::size_t kLongestFile = 1024 * 1024;

struct ReadConfiguration {
  Configuration configuration;    ///< To go by when there is no mistake.
  std::vector<Mistake> mistakes;  ///< In the order of the text; the first hundred.
};

/// Reads the text of an isocnc.json. Its patterns of paths start at `folder`, absolute and without symlinks.
ReadConfiguration read_configuration(std::string_view text, const std::filesystem::path& folder);

}  // namespace isocnc::configuration
