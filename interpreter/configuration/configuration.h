#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/configuration/path_patterns.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/execution/setup.h"
#include "interpreter/simulation/timing.h"

namespace isocnc::configuration {

/// What programs are called, unless a configuration says otherwise.
inline const std::array<std::string, 5> kProgramExtensions{".iso", ".nc", ".cnc", ".tap", ".ngc"};

/// A tool of the machine. Lengths in mm.
struct Tool {
  execution::ToolCode code;
  std::string name;
  std::optional<double> length;
  std::optional<double> radius;
};

/// An M function of the shop.
struct NamedFunction {
  int number = 0;
  std::string name;
  double seconds = 0;  ///< How long the machine waits for it.
};

/// Rapids of the default machine, mm/min and degrees/min.
std::array<double, execution::kAxisCount> default_rapids();

struct Machine {
  execution::Setup setup;  ///< Its tools and functions are those below.
  /// How it moves. Travel, rapids and kind are those of `setup` and below; its tools and functions those below.
  simulation::TimedMachine timed;
  std::array<double, execution::kAxisCount> rapids = default_rapids();  ///< mm/min, degrees/min.
  std::string kind = "head";                                            ///< `three-axis`, `head`, `table`.
  std::optional<std::vector<Tool>> tools;
  std::optional<std::vector<NamedFunction>> functions;

  /// What the file tells of a tool, and of an M function by its number as written; null where it tells nothing.
  const Tool* find_tool(const execution::ToolCode& code) const;
  const NamedFunction* find_function(double number) const;
};

/// Codes as a selection names them.
struct CodeSelection {
  std::vector<std::string> select;
  std::vector<std::string> ignore;
  std::vector<std::pair<std::string, std::string>> severity;  ///< A code; error, warning, info or off.
};

/// What holds for some programs alone.
struct FileOverrides {
  std::vector<std::string> paths;
  PathPatterns patterns;  ///< Of `paths`.
  CodeSelection selection;
};

struct Lint {
  CodeSelection selection;
  std::vector<FileOverrides> files;  ///< The later ones outweigh the earlier ones.
  std::vector<std::string> extensions{kProgramExtensions.begin(), kProgramExtensions.end()};  ///< With their point.
  std::vector<std::string> exclude;
  PathPatterns excluded;  ///< Of `exclude`.
};

struct Renumber {
  static constexpr int kMaxNumber = 1'000'000'000;

  int start = 10;
  int step = 10;
  bool all_lines = false;
};

/// How programs are formatted, where the command does not tell.
struct Format {
  static constexpr int kMaxDecimals = 15;

  bool word_order = false;
  std::optional<int> decimals;
  std::optional<int> g_digits;
  std::string modal = "keep";
  std::optional<Renumber> renumber;
};

/// What an isocnc.json says; what it leaves out, and without a file all, is as it was ever since.
struct Configuration {
  Machine machine;
  Lint lint;
  Format format;
  std::optional<dialect::Language> language;
  std::filesystem::path file;  ///< As shown to people; empty without one.
};

}  // namespace isocnc::configuration
