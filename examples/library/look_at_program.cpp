// Reads a program, checks it, and runs it on the simulated machine: look_at_program part.iso

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/formats/rendering.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/simulation/timed_run.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/system/source_file.h"

int main(int count, char** arguments) {
  using namespace isocnc;
  const auto language = dialect::Language::English;
  if (count != 2) return fmt::print(stderr, "usage: look_at_program FILE\n"), 2;

  const auto opened = system::SourceFile::open(arguments[1], language);
  if (const auto* problem = std::get_if<system::SourceFile::Problem>(&opened))
    return fmt::print(stderr, "{}: {}\n", arguments[1], problem->message), 2;
  const std::string_view text = std::get<system::SourceFile>(opened).text();

  configuration::Configurations configurations({}, language);  // The isocnc.json above the program.
  const configuration::Configuration& configuration = configurations.of(arguments[1]);
  const configuration::MachineConfiguration& machine = configuration.machine;
  const rules::CheckSetup setup{.machine = machine.setup, .thresholds = configuration.lint.thresholds};

  syntax::LineFinder lines(text);
  const check::Report report = check::check_text(text, setup);
  for (const check::LocatedFinding& located : report.findings) {
    const formats::ShownFinding shown = formats::show(located, report, lines, {.language = language});
    fmt::print("line {}: {} [{}]\n", shown.line, shown.message, shown.def.code);
  }

  double end = 0;
  const auto listen = [&](const timing::TimedEvent& event) { end = event.start + event.duration; };
  const running::RunResult run =
      simulation::run_timed(text, {.setup = machine.setup}, machine.timed, {.event = listen});
  fmt::print("{} blocks, {:.1f} s\n", run.blocks, end);
  return run.ending == running::Ending::ProgramEnd ? 0 : 1;
}
