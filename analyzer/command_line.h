#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analyzer/selection/selection.h"
#include "interpreter/command_line/material_values.h"
#include "interpreter/configuration/configurations.h"

namespace isocnc::analyzer {

/// The options of an isolint command.
struct LintCommandOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string output;  ///< The output file; empty: standard output.
  std::string language;
  std::string color = "auto";
  std::string explain;
  std::string stdin_name = "<stdin>";
  std::string baseline;        ///< The file of findings not to report.
  std::string write_baseline;  ///< The file in which to record findings instead of reporting them.
  selection::SelectionOptions selection;
  std::optional<std::size_t> max_warnings;
  std::string shard;   ///< The part of the files to check, as Shard::read() takes it; empty: all.
  bool merge = false;  ///< Joins reports, which `paths` names.
  int jobs = 0;        ///< The number of threads; 0: one for each core.
  bool exit_zero = false;
  bool fix = false;           ///< Applies safe fixes in place.
  bool unsafe_fixes = false;  ///< Includes unsafe fixes.
  bool diff = false;          ///< Shows what the fixes would change, and changes nothing.
  bool statistics = false;
  bool verify = false;  ///< Runs each program on the machine as well.
  command_line::MaterialValues material_values;
  verification::MaterialOptions material;  ///< As read from these values.
  bool watch = false;                      ///< Checks again what changes, until the user ends it.
  bool list_rules = false;
  bool rules_page = false;
  bool messages_page = false;
  bool foreign_page = false;
  bool notepad_language = false;
  bool show_config = false;
  bool config_schema = false;
  bool setup_schema = false;
  bool config_keys = false;
  bool machine_page = false;
  configuration::ConfigurationSource source;

  dialect::Language reader_language() const;
  /// Uses the configuration's language from now on, unless the command line names one.
  void follow(const configuration::Configuration& configuration);
  /// Whether findings are to be colored.
  bool wants_color() const;
  /// Whether standard output is the fixed program; findings then go to standard error.
  bool prints_program() const;
};

/// The options, or the text to print instead of a check.
struct CommandLine {
  LintCommandOptions options;
  std::optional<std::string> answer;     ///< The answer to `--help` or `--version`.
  std::optional<std::string> complaint;  ///< The error in the command.
};

CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace isocnc::analyzer
