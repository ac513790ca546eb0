#pragma once

#include <string_view>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

/// Maximum size of a configuration, in bytes.
inline constexpr std::size_t kLongestFile = 1024 * 1024;

struct ReadConfiguration {
  Configuration configuration;    ///< Valid if there are no mistakes.
  std::vector<Mistake> mistakes;  ///< The first hundred, in the order of the text.
};

/// Reads the text of an isocnc.json. Its path patterns are relative to `folder`, absolute and without symlinks.
ReadConfiguration read_configuration(std::string_view text, const std::filesystem::path& folder);

struct ReadSetup {
  DescribedSetup setup;           ///< Valid if there are no mistakes.
  std::vector<Mistake> mistakes;  ///< The first hundred, in the order of the text.
};

/// Reads the text of a setup that is a file of its own: an element of `setups` without `paths`.
ReadSetup read_setup(std::string_view text);

}  // namespace isocnc::configuration
