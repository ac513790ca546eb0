// Reads a program, checks it, and runs it on the simulated machine: look_at_program part.iso

#include <fmt/format.h>

#include "analyzer/check_text.h"
#include "analyzer/rendering.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/running/source_file.h"
#include "interpreter/running/timed_run.h"

int main(int count, char** arguments) {
  using namespace isocnc;
  const auto language = dialect::Language::English;
  if (count != 2) return fmt::print(stderr, "usage: look_at_program FILE\n"), 2;

  const auto opened = running::SourceFile::open(arguments[1], language);
  if (const auto* problem = std::get_if<running::SourceFile::Problem>(&opened))
    return fmt::print(stderr, "{}: {}\n", arguments[1], problem->message), 2;
  const std::string_view text = std::get<running::SourceFile>(opened).text();

  configuration::Configurations configurations({}, language);  // The isocnc.json above the program.
  const configuration::Machine& machine = configurations.of(arguments[1]).machine;

  analyzer::LineFinder lines(text);
  for (const analyzer::LocatedFinding& located : analyzer::check_text(text, machine.setup).findings) {
    const analyzer::ShownFinding shown = analyzer::show(located, lines, {.language = language});
    fmt::print("line {}: {} [{}]\n", shown.line, shown.message, shown.def.code);
  }

  double end = 0;
  const auto listen = [&](const running::TimedEvent& event) { end = event.start + event.duration; };
  const running::RunResult run = running::run_timed(text, {.setup = machine.setup}, machine.timed, {.event = listen});
  fmt::print("{} blocks, {:.1f} s\n", run.blocks, end);
  return run.ending == running::Ending::ProgramEnd ? 0 : 1;
}
