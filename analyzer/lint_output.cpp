#include "analyzer/lint_output.h"

#include <optional>

#include "interpreter/command_line/program_main.h"
#include "interpreter/system/descriptor.h"

namespace isocnc::analyzer {

void complain(std::string_view what) { command_line::complain("isolint", what); }

LintOutput::LintOutput(const LintCommandOptions& options)
    : path_(options.output),
      language_(options.reader_language()),
      descriptor_(options.prints_program() ? system::kStandardError : system::kStandardOutput),
      file_(path_.empty() ? system::OutputFile(descriptor_) : system::OutputFile(std::filesystem::path(path_))) {}

bool LintOutput::finish() {
  flush();
  const std::string standard = descriptor_ == system::kStandardOutput ? "<stdout>" : "<stderr>";
  const std::optional<std::string> problem = system::commit(file_, path_.empty() ? standard : path_, language_);
  if (problem) complain(*problem);
  return !problem;
}

}  // namespace isocnc::analyzer
