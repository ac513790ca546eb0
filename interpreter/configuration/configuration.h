#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/configuration/path_patterns.h"
#include "interpreter/configuration/surroundings.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/dialect/lint_thresholds.h"
#include "interpreter/execution/setup.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::configuration {

/// Default extensions of program files.
inline const std::array<std::string, 5> kProgramExtensions{".iso", ".nc", ".cnc", ".tap", ".ngc"};

/// A tool of the machine. Lengths in mm.
struct Tool {
  execution::ToolCode code;
  std::string name;
  std::optional<double> length;
  std::optional<double> radius;
  std::string shape;                  ///< `flat`, `ball`, `bull`, `cone`, `drill`, `disc`; empty: not known.
  std::optional<NumberRows> profile;  ///< z, radius; instead of a shape.
  std::optional<double> corner_radius;
  std::optional<double> tip_angle;  ///< Degrees.
  std::optional<double> cut_length;
  std::optional<double> max_depth;
  std::optional<double> shank;  ///< Diameter.
  std::string body;             ///< Name of the holder; empty: none.
  DescriptionPlace place;
};

/// A named user M function.
struct NamedFunction {
  int number = 0;
  std::string name;
  double seconds = 0;  ///< Duration in seconds for which the machine waits.
};

/// Rapids of the default machine, mm/min and degrees/min.
std::array<double, execution::kAxisCount> default_rapids();

struct MachineConfiguration {
  execution::Setup setup;  ///< Tools and functions are copies of the members below.
  /// The machine's motion. Travel, rapids and kind are copies from `setup` and the members below, as are tools and
  /// functions.
  simulation::TimedMachine timed;
  std::array<double, execution::kAxisCount> rapids = default_rapids();  ///< mm/min, degrees/min.
  std::string kind = "head";                                            ///< `three-axis`, `head`, `table`.
  std::optional<std::vector<Tool>> tools;
  std::optional<std::vector<NamedFunction>> functions;
  std::vector<NamedRows> holders;     ///< Height, lower diameter, upper diameter, from the collet's face up.
  std::optional<NumberRows> nose;     ///< The same, from the spindle nose up.
  std::vector<DescribedBody> bodies;  ///< In machine coordinates with all axes at 0.
  std::filesystem::path file;         ///< The file that describes the machine, as shown to users; empty without one.
  std::filesystem::path folder;       ///< Its folder, absolute and without symlinks.

  /// The tool, or the M function by its number as written, in the configuration; null if it is not listed.
  const Tool* find_tool(const execution::ToolCode& code) const;
  const NamedFunction* find_function(double number) const;
};

/// A selection of diagnostic codes.
struct CodeSelection {
  std::vector<std::string> select;
  std::vector<std::string> ignore;
  std::vector<std::pair<std::string, std::string>> severity;  ///< Pairs of a code and error, warning, info or off.
};

/// A selection for certain programs only.
struct FileOverrides {
  std::vector<std::string> paths;
  PathPatterns patterns;  ///< Parsed form of `paths`.
  CodeSelection selection;
};

struct Lint {
  CodeSelection selection;
  dialect::LintThresholds thresholds;
  std::vector<FileOverrides> files;  ///< Later entries override earlier ones.
  /// Extensions with their dot.
  std::vector<std::string> extensions{kProgramExtensions.begin(), kProgramExtensions.end()};
  std::vector<std::string> exclude;
  PathPatterns excluded;  ///< Parsed form of `exclude`.
};

struct Renumber {
  static constexpr int kMaxNumber = 1'000'000'000;

  int start = 10;
  int step = 10;
  bool all_lines = false;
};

/// Format options of programs; those of the command line override them.
struct Format {
  static constexpr int kMaxDecimals = 15;

  bool word_order = false;
  std::optional<int> decimals;
  std::optional<int> g_digits;
  std::string modal = "keep";
  std::optional<Renumber> renumber;
};

/// The content of an isocnc.json. Omitted keys, or all without a file, have their defaults.
struct Configuration {
  MachineConfiguration machine;
  Lint lint;
  Format format;
  std::optional<dialect::Language> language;
  std::vector<DescribedSetup> setups;  ///< Of those for a program, the last one counts.
  std::filesystem::path file;          ///< Path as shown to users; empty without a file.
  std::filesystem::path folder;        ///< Its folder, absolute and without symlinks.
};

}  // namespace isocnc::configuration
