#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/timing/timing.h"
#include "interpreter/verification/scene.h"

namespace isocnc::golden {

/// A finding that a marker line under a program line expects.
struct ExpectedFinding {
  std::size_t line = 0;   ///< From 0, in Part::program.
  std::size_t begin = 0;  ///< Columns from 0 in code points, end exclusive.
  std::size_t end = 0;
  std::string code;
  std::vector<std::size_t> via;  ///< Lines of IFs that lead to it, from 1.
  std::size_t repeats = 0;       ///< The number of lines below that repeat it (D66).
  std::size_t last_line = 0;     ///< The last of them, from 1.
  std::string cause;             ///< Its name in the table, `usual` for the code's own message; empty: any.

  auto operator<=>(const ExpectedFinding&) const = default;
};

/// `; -> feed to X0 Y0 length 8`: what a line does.
struct ExpectedEffect {
  std::size_t line = 0;
  std::string kind;
  std::map<char, double> to;  ///< Machine coordinates by axis.
  std::map<char, double> center;
  std::optional<double> length, radius, sweep;
  std::string text;
};

/// One program of a golden file, with what it expects. Files hold several, apart by a line `; ====`.
struct Part {
  std::string name;     ///< File and line, for messages.
  std::string program;  ///< Without markers and effects.
  std::vector<ExpectedFinding> findings;
  std::vector<ExpectedEffect> effects;
  execution::Setup setup;
  double vgpl = 0;
  std::vector<std::string> selected;         ///< Rules that are off by default, as `W124=warning`.
  timing::TimedMachine machine;              ///< The machine for the findings of a run.
  std::optional<verification::Scene> scene;  ///< What surrounds the program, if any.
  bool is_about_rules = false;               ///< In tests/programs/rules and runs: lint findings are marked, too.
  bool is_run = false;                       ///< In tests/programs/runs: findings of a run are marked, too.
  bool is_folded = false;                    ///< In D66.iso and runs: lines that repeat a finding are not marked.
};

std::vector<Part> read_golden(const std::filesystem::path& file);
/// All golden files of the tests, sorted.
std::vector<std::filesystem::path> golden_files();

}  // namespace isocnc::golden
