#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "debugger/debuggee/debuggee.h"
#include "debugger/difference/first_difference.h"
#include "debugger/session/launch_options.h"
#include "debugger/session/session_state.h"
#include "interpreter/configuration/configuration.h"

namespace isocnc::session {

/// A program that is ready to run, and its configuration.
struct Launch {
  debuggee::Debuggee debuggee;
  configuration::Configuration configuration;
};

/// The options of a run from the start, as it was launched.
running::RunOptions run_options(const LaunchOptions& launch, const configuration::Configuration& configuration);

/// Reads program and configuration. Throws RequestError, in the language of the command line, else that of the
/// configuration, else that of the client.
Launch launch(const LaunchOptions& options, std::optional<dialect::Language> commanded, dialect::Language clients);

/// Another program to compare with: a file, whose name may be relative to the folder of the debugged program. Its
/// machine is that of the launch or else of the isocnc.json above it. Throws RequestError.
difference::ReferenceProgram read_reference(const std::filesystem::path& file, const SessionState& state);
/// One that is no file, on the machine of the debugged one.
difference::ReferenceProgram reference_text(std::string name, std::string text, const SessionState& state);

}  // namespace isocnc::session
