#pragma once

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace isocnc::commands {

/// Where a command's standard output goes.
enum class StandardOutput {
  Captured,
  FullDisk,    ///< /dev/full: every write fails.
  ClosedPipe,  ///< A pipe that nobody reads.
};

/// What a command is given besides its arguments.
struct CommandSetup {
  std::string input;                               ///< Standard input.
  std::map<std::string, std::string> environment;  ///< Beside what the tests run in, less its locale and NO_COLOR.
  std::string folder;                              ///< To run in; else that of the tests.
  StandardOutput standard_output = StandardOutput::Captured;
  std::chrono::microseconds limit = std::chrono::seconds(120);  ///< Killed when it takes longer.
};

/// What became of a command.
struct CommandResult {
  int status = 0;  ///< Exit status; 128 and the signal's number when a signal ended it.
  bool timed_out = false;
  std::string out;
  std::string err;
};

/// Runs a command to its end. The first argument is one of our programs, `isolint` or `isorun`.
CommandResult run_command(std::vector<std::string> arguments, const CommandSetup& setup = {});

}  // namespace isocnc::commands
