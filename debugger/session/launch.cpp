#include "debugger/session/launch.h"

#include <utility>

#include <fmt/format.h>

#include "debugger/dap/request_error.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/system/paths.h"

namespace isocnc::session {

using configuration::Configuration;
using configuration::Configurations;
using dialect::Language;

/// All mistakes of the configurations, a line each.
static std::string mistakes_of(const Configurations& read, Language language) {
  std::string all;
  for (const std::string& mistake : read.mistakes(language)) all += (all.empty() ? "" : "\n") + mistake;
  return all;
}

static debuggee::ProgramText read_program(const std::filesystem::path& file, Language language) {
  auto text = debuggee::ProgramText::read(file, language);
  if (const auto* const problem = std::get_if<debuggee::ProgramText::ReadError>(&text))
    throw dap::RequestError(fmt::format("{}: {}", system::generic_name(file), problem->message));
  return std::get<debuggee::ProgramText>(std::move(text));
}

running::RunOptions run_options(const LaunchOptions& launch, const Configuration& configuration) {
  running::RunOptions options;
  options.setup = configuration.machine.setup;
  options.vgpl = launch.vgpl;
  for (const auto& [number, value] : launch.registers) options.registers[static_cast<std::size_t>(number)] = value;
  return options;
}

Launch launch(const LaunchOptions& options, std::optional<Language> commanded, Language clients) {
  const std::filesystem::path folder = options.program.parent_path();
  Configurations found({}, commanded.value_or(clients));
  Configurations given({.file = options.machine, .none = !options.machine}, commanded.value_or(clients));
  Configuration configuration = found.in_folder(folder);
  if (options.machine) configuration.machine = given.in_folder(folder).machine;
  const Language language = commanded.value_or(configuration.language.value_or(clients));
  for (const Configurations* const read : {&found, &given})
    if (const std::string mistakes = mistakes_of(*read, language); !mistakes.empty()) throw dap::RequestError(mistakes);
  return {debuggee::Debuggee(read_program(options.program, language), run_options(options, configuration),
                             configuration.machine.timed),
          std::move(configuration)};
}

difference::ReferenceProgram read_reference(const std::filesystem::path& file, const SessionState& state) {
  LaunchOptions options = state.launch_options;
  options.program = system::normal(system::absolute(options.program.parent_path() / file));
  const Launch read = launch(options, state.commanded_language, state.language());
  return {.name = options.program.filename().generic_string(),
          .text = std::string(read.debuggee.text().text()),
          .options = run_options(options, read.configuration),
          .machine = read.configuration.machine.timed};
}

difference::ReferenceProgram reference_text(std::string name, std::string text, const SessionState& state) {
  return {.name = std::move(name),
          .text = std::move(text),
          .options = run_options(state.launch_options, state.configuration),
          .machine = state.configuration.machine.timed};
}

}  // namespace isocnc::session
