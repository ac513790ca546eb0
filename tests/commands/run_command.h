#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace isocnc::commands {

/// Where a command's standard output goes.
enum class StandardOutput {
  Captured,
  FullDisk,    ///< /dev/full: every write fails.
  ClosedPipe,  ///< A pipe without a reader.
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

/// The events of a trace, and their kinds.
std::vector<nlohmann::json> events_in(const std::string& trace);
std::vector<std::string> kinds_in(const std::vector<nlohmann::json>& events);
/// An event without its time.
nlohmann::json timeless(nlohmann::json event);

/// What isorun says of a program that comes from standard input: its trace, its summary.
std::vector<nlohmann::json> trace_of(std::string_view program, std::vector<std::string> options = {});
nlohmann::json summary_of(const std::string& program, std::vector<std::string> options = {});

}  // namespace isocnc::commands
