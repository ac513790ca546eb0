#pragma once

#include "interpreter/command_line/program_app.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::command_line {

/// Adds `--config FILE` with this description, and `--no-config`.
void add_source_options(command_line::ProgramApp& program, configuration::ConfigurationSource& source,
                        const dialect::Text& description);

}  // namespace isocnc::command_line
