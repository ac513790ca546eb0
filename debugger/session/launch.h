#pragma once

#include <optional>

#include "debugger/debuggee/debuggee.h"
#include "debugger/session/launch_options.h"
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

}  // namespace isocnc::session
