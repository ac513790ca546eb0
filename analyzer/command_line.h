#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analyzer/selection/selection.h"
#include "interpreter/configuration/configurations.h"

namespace isocnc::analyzer {

/// What isolint has been asked for.
struct Options {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string output;  ///< Empty: standard output.
  std::string language;
  std::string color = "auto";
  std::string explain;
  std::string stdin_name = "<stdin>";
  std::string baseline;        ///< Findings not to be reported.
  std::string write_baseline;  ///< Where to record findings in place of reporting them.
  selection::SelectionOptions selection;
  std::optional<std::size_t> max_warnings;
  int jobs = 0;  ///< 0: one for each core.
  bool exit_zero = false;
  bool fix = false;           ///< Safe fixes, in place.
  bool unsafe_fixes = false;  ///< Unsafe fixes count as well.
  bool diff = false;          ///< Shows what the fixes would change, and changes nothing.
  bool statistics = false;
  bool list_rules = false;
  bool rules_page = false;
  bool show_config = false;
  bool config_schema = false;
  bool config_keys = false;
  bool machine_page = false;
  configuration::Source source;

  dialect::Language reader_language() const;
  /// Speaks the configuration's language from now on, unless the command line names one.
  void follow(const configuration::Configuration& configuration);
  /// Whether findings are to be colored.
  bool wants_color() const;
  /// Whether standard output is for the fixed program, and findings go to standard error.
  bool prints_program() const;
};

/// The options, or what is to be said in place of a check.
struct CommandLine {
  Options options;
  std::optional<std::string> answer;     ///< To `--help` and `--version`.
  std::optional<std::string> complaint;  ///< What is wrong with the command.
};

CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace isocnc::analyzer
