#include "interpreter/command_line/source_options.h"

namespace isocnc::command_line {

void add_source_options(command_line::ProgramApp& program, configuration::ConfigurationSource& source,
                        const dialect::Text& description) {
  const command_line::ProgramOption config =
      program.add_option("--config", source.file, command_line::kFileValue, description);
  program.add_flag("--no-config", source.none, {"Read no isocnc.json", "Non legge nessun isocnc.json"})
      .excludes(config)
      .without_exclusions();
}

}  // namespace isocnc::command_line
