#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "interpreter/command_line/program_app.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/system/exit_status.h"

namespace isocnc::interpreter {

/// The options of isorun that are about the tools and the machine of an isocnc.json, and run no program.
struct ToolCommandOptions {
  std::string import_file;
  std::string map_file;
  std::string kept;  ///< Keys with commas between them.
  bool is_written = false;
  std::string export_file;
  bool is_for_presetter = false;
  std::string new_machine;

  bool is_given() const { return !import_file.empty() || !export_file.empty() || !new_machine.empty(); }
};

/// Whether a command line has one of the options that take the place of a program.
bool is_about_tools(std::span<const char* const> arguments);

/// Adds the options, in a group of their own.
void add_tool_options(command_line::ProgramApp& program, ToolCommandOptions& options);

/// Does what they ask for. The isocnc.json is that of `source`, or above the current folder; `machine` is another file
/// that describes the machine.
system::ExitStatus run_tool_command(const ToolCommandOptions& options, const configuration::ConfigurationSource& source,
                                    const std::optional<std::string>& machine, std::string_view language);

}  // namespace isocnc::interpreter
