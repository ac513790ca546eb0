#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "interpreter/configuration/configuration.h"

namespace isocnc::configuration {

/// The configuration as a complete isocnc.json; keys without a value are omitted.
std::string to_json(const Configuration& configuration);

/// The schema of isocnc.json: JSON Schema, draft 7. Descriptions are in the language.
std::string json_schema(dialect::Language language);

/// The schema of a setup that is a file of its own, `door.setup.json`.
std::string setup_schema(dialect::Language language);

/// All keys except those of the machine, as a Markdown table.
std::string key_page(dialect::Language language);

/// docs/machine.md, docs/it/macchina.md: all keys of the machine, section by section.
std::string machine_page(dialect::Language language);

/// A key of isocnc.json that affects a code: `lint.options.longestDwell`, `120 s`.
struct CodeOption {
  std::string path;
  std::string fallback;  ///< Default value; empty if there is none.
};

/// The keys whose documentation names the code.
std::vector<CodeOption> options_of(std::string_view code, dialect::Language language);

}  // namespace isocnc::configuration
