#pragma once

#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/program_app.h"

namespace isocnc::configuration {

/// `--config FILE`, described so, and `--no-config`.
void add_source_options(running::ProgramApp& program, Source& source, const dialect::Text& description);

}  // namespace isocnc::configuration
