#pragma once

#include <string>

#include "interpreter/configuration/configuration.h"

namespace isocnc::configuration {

/// The configuration as an isocnc.json that says all of it; what has no value in force is left out.
std::string to_json(const Configuration& configuration);

/// The schema of isocnc.json: JSON Schema, draft 7.
std::string json_schema();

/// All keys as a table of Markdown.
std::string key_page();

}  // namespace isocnc::configuration
