#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "debugger/session/client.h"
#include "debugger/session/debuggee.h"
#include "debugger/session/expression.h"
#include "interpreter/configuration/configuration.h"

namespace isocnc::debugger::session {

/// What a launch asks for.
struct LaunchWishes {
  std::filesystem::path program;
  std::optional<std::string> machine;  ///< A file in place of the isocnc.json above the program.
  bool stop_on_entry = false;
  bool no_debug = false;
  bool break_on_warnings = false;
  double speed = 0;  ///< 0: as fast as possible; 1: in real time.
  double vgpl = 0;
  std::vector<std::pair<int, double>> registers;
  std::optional<std::uint64_t> start_line;  ///< From 0: the run goes there before anything is stopped at.
  ValueFormat format;
};

/// Reads the arguments of a launch. What it does not know is left alone: clients add members of their own. Throws
/// RequestError.
LaunchWishes read_wishes(const Json& arguments, dialect::Language language);

/// A program that is ready to run, and what its configuration says.
struct Launched {
  Debuggee debuggee;
  configuration::Configuration configuration;
};

/// Reads program and configuration. Throws RequestError, in the language that is commanded, or else that of the
/// configuration, or else of the client.
Launched launch(const LaunchWishes& wishes, std::optional<dialect::Language> commanded, dialect::Language clients);

}  // namespace isocnc::debugger::session
