#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/configuration/configuration.h"

namespace isocnc::configuration {

/// The configuration as an isocnc.json that says all of it; what has no value in force is left out.
std::string to_json(const Configuration& configuration);

/// The schema of isocnc.json: JSON Schema, draft 7.
std::string json_schema();

/// All keys but those of the machine, as a table of Markdown.
std::string key_page();

/// docs/machine.md: all keys of the machine, section by section.
std::string machine_page();

/// A key of isocnc.json that a code goes by: `lint.options.longestDwell`, `120 s`.
struct CodeOption {
  std::string path;
  std::string fallback;  ///< What holds without the key; empty: nothing.
};

/// The keys whose documentation names the code.
std::vector<CodeOption> options_of(std::string_view code);

}  // namespace isocnc::configuration
