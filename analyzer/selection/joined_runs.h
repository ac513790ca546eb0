#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter/simulation/run_findings.h"

namespace isocnc::selection {

/// Makes one outcome of runs of a program with other values of VGPL. What several runs find at the same place is one
/// finding. Those that the first run does not have get the path that leads to them: the decisions that all runs with
/// the finding share, and the first run has not made.
class JoinedRuns {
 public:
  /// Up to 32 runs.
  void add(simulation::RunOutcome outcome);
  simulation::RunOutcome finish() &&;

 private:
  /// What makes findings of different runs the same. How deep or how late a contact is depends on the run.
  using Identity = std::tuple<std::size_t, syntax::Span, dialect::DiagnosticId, std::uint8_t, std::uint32_t,
                              std::uint32_t, double, double>;
  /// A set of runs, one bit each.
  using RunSet = std::uint32_t;
  using DecisionPath = std::vector<simulation::RunDecision>;

  static Identity identity_of(const simulation::RunFinding& finding);
  /// Decisions that lead a set of runs off the path of the first run.
  struct Detour {
    DecisionPath common;                                                  ///< Those that all of the runs share.
    DecisionPath of_one;                                                  ///< Those of the first of them.
    std::map<std::pair<std::size_t, std::size_t>, std::int32_t> numbers;  ///< Paths by the steps of each that count.
  };

  bool is_made_otherwise(const simulation::RunDecision& decision) const;
  Detour detour_of(RunSet runs) const;
  std::int32_t path_number(std::size_t line, RunSet runs);

  simulation::RunOutcome joined_;
  std::vector<RunSet> found_by_;           ///< One set for each of the findings, in their order.
  std::map<Identity, std::size_t> known_;  ///< The indices of the findings.
  std::map<RunSet, Detour> detours_;
  std::int32_t mistakes_ = 0;  ///< The number of mistakes of all runs.
};

}  // namespace isocnc::selection
