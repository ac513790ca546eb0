#include "debugger/session/session_state.h"

#include "interpreter/system/paths.h"
#include "interpreter/system/same_file.h"
#include "interpreter/system/user_language.h"

namespace isocnc::session {

expressions::Moment SessionState::moment() const { return moment_of(debuggee->present()); }

expressions::Moment SessionState::moment_of(const simulation::Simulation& simulation) const {
  expressions::Moment moment = expressions::moment_of(simulation);
  moment.surroundings = surroundings.get();
  moment.override_percent = 100 * debuggee->feed_override();
  moment.playback = launch_options.speed;
  return moment;
}

bool SessionState::is_program(const std::filesystem::path& file) const {
  const std::filesystem::path& program = launch_options.program;
  return file == program || system::is_same_file(system::generic_name(file), system::generic_name(program));
}

Json SessionState::source() const {
  return {{"name", launch_options.program.filename().generic_string()},
          {"path", system::generic_name(launch_options.program)}};
}

dialect::Language SessionState::language() const {
  if (commanded_language) return *commanded_language;
  if (configuration.language) return *configuration.language;
  return client.locale.value_or(system::user_language());
}

}  // namespace isocnc::session
