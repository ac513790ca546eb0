#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/simulation/run_findings.h"
#include "interpreter/syntax/line_tree.h"
#include "interpreter/verification/contact.h"

namespace isocnc::selection {

/// The values of VGPL that may lead a program along different paths: its IFs compare VGPL with constants, which cut all
/// values into cells (below, at, between and above them), and within a cell the path is the same. Each run has one
/// value from its start to its end. Runs are taken out as they are made, with all values that lead along the same path.
class VgplValues {
 public:
  /// Reads the jumps of a program.
  explicit VgplValues(std::string_view text);
  /// The same with more constants, so that the values of several programs are cut into the same cells.
  VgplValues(std::string_view text, const std::vector<double>& more_constants);

  /// Those that the IFs compare VGPL with, ascending.
  const std::vector<double>& constants() const { return constants_; }
  /// A set of cells of values: below the first constant, the constant, above it, and so on.
  using CellSet = std::vector<bool>;
  /// The cells whose values lead along the path of a run.
  CellSet cells_along(const simulation::TakenPath& run) const;
  /// The cells that are open.
  CellSet open_cells() const;
  void close(const CellSet& cells);
  /// Cells as conditions of an IF, `VGPL < 1, VGPL > 2`: cells in a row are one range. Empty for all.
  std::string in_words(const CellSet& cells) const;

  /// The registers that IFs of a run compare though it has not assigned them.
  std::vector<int> unassigned_registers(const simulation::TakenPath& run) const;

  /// Takes out a run with the value that next() has given, or with any.
  void take(const simulation::TakenPath& run);
  /// A value that leads along a path that no run has taken, an integer if possible; none if there is none.
  std::optional<double> next() const;
  /// The jumps that other values decide otherwise than all runs: the first such of VGPL, and the first of the registers
  /// that the run has not assigned, with its line and the span of its IF.
  std::vector<simulation::RunFinding> findings() const;
  /// The same for a certificate, with the first jump of each of these registers.
  std::vector<verification::Unverified> gaps() const;

 private:
  /// An assignment to a register or an IF, in the order of the program.
  struct FlowStep {
    std::size_t line = 0;
    int assigned = 0;  ///< The register; 0: a jump.
    syntax::Jump jump;
  };

  /// A jump that a run has met.
  struct MetJump {
    std::size_t step = 0;  ///< An index into steps_.
    bool taken = false;
  };
  /// The jumps that a run has met.
  struct MetJumps {
    std::vector<MetJump> jumps;
    std::vector<std::size_t> on_registers;  ///< Those on registers that it has not assigned: indices into steps_.
  };

  /// A range of values without a constant inside, or a constant.
  struct ValueCell {
    double value = 0;      ///< One of its values.
    bool is_open = false;  ///< No run has taken the path of its values, and there are any.
  };

  void cut_into_cells();
  std::string range_in_words(std::size_t first, std::size_t last) const;
  std::size_t cell_of(double constant) const;
  MetJumps met_by(const simulation::TakenPath& run) const;
  CellSet cells_along(const std::vector<MetJump>& met) const;
  std::optional<std::size_t> open_jump() const;
  std::vector<std::size_t> open_jumps() const;
  verification::Unverified gap_at(std::size_t step) const;

  std::vector<FlowStep> steps_;
  std::vector<double> constants_;   ///< Ascending.
  std::vector<ValueCell> cells_;    ///< Below the first constant, the constant, above it, and so on.
  std::vector<std::size_t> order_;  ///< The cells as they are tried: integers first, ascending.
  std::vector<std::vector<MetJump>> runs_;
  /// The topmost jump on each register that a run has not assigned.
  std::map<int, std::size_t> register_jumps_;
};

}  // namespace isocnc::selection
