#include "interpreter/configuration/source_options.h"

namespace isocnc::configuration {

void add_source_options(running::ProgramApp& program, Source& source, const dialect::Text& description) {
  const running::ProgramOption config = program.add_option("--config", source.file, running::kFileValue, description);
  program.add_flag("--no-config", source.none, {"Read no isocnc.json", "Non legge nessun isocnc.json"})
      .excludes(config)
      .tells_no_exclusions();
}

}  // namespace isocnc::configuration
