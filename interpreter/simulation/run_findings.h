#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "interpreter/kinematics/made_move.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/syntax/finding.h"
#include "interpreter/timing/timing.h"

namespace isocnc::simulation {

/// A decision at an IF that a run has met.
struct RunDecision {
  std::size_t line = 0;  ///< Of the IF, from 0.
  bool taken = false;

  friend bool operator==(const RunDecision&, const RunDecision&) = default;
};

/// A finding of a run, on its line.
struct RunFinding {
  std::size_t line = 0;  ///< From 0.
  syntax::Finding finding;
  std::int32_t mistake = -1;              ///< Findings with the same number have the same cause (D66); -1: alone.
  std::optional<std::size_t> last_line;   ///< Where it ends, if below `line`; from 0.
  std::optional<std::size_t> worst_line;  ///< Of a contact: where it is deepest or nearest, if elsewhere; from 0.
  std::optional<std::size_t> shaped_by;   ///< What cut last what is hit, or stopped the spindle; from 0.
  std::int32_t path = -1;                 ///< An index into RunOutcome::paths; -1: the path of the first run has it.

  friend bool operator==(const RunFinding&, const RunFinding&) = default;
};

/// The path that a run has taken.
struct TakenPath {
  /// The first and last line of each stretch without a jump, in ascending order; from 0.
  std::vector<std::pair<std::size_t, std::size_t>> executed;
  std::vector<RunDecision> decisions;  ///< In ascending order of their lines.

  bool has_executed(std::size_t line) const;
  bool has_made(const RunDecision& decision) const;
};

/// What the motions of a line have removed from the blank.
struct RemovedOnLine {
  std::size_t line = 0;  ///< From 0.
  double volume = 0;     ///< mm^3
  double depth = 0;      ///< Greatest depth of cut, mm.
  double width = 0;      ///< Greatest width of cut, mm.

  friend bool operator==(const RemovedOnLine&, const RemovedOnLine&) = default;
};

/// What a run of a program has found, or several runs with other values of VGPL.
struct RunOutcome {
  std::vector<RunFinding> findings;             ///< Sorted by line and column, each once on its line.
  std::vector<TakenPath> runs;                  ///< One for each run.
  std::vector<std::vector<RunDecision>> paths;  ///< What leads to findings that the first run does not have.
  bool has_scene = false;              ///< Whether what surrounds the machine was known: contacts were looked for.
  bool has_stock = false;              ///< Whether the material was cut as well.
  std::vector<RemovedOnLine> removed;  ///< By lines that removed something, in ascending order; of the first run.
};

/// What the machine shows of a program: joints outside their travel (E160), gouges of the cutter compensation (W138 to
/// W140), feeds and speeds above the machine's limits (W131 to W133), and where the run stopped before the end (W162).
/// All programs that run a program collect its findings here. A value.
class RunFindings {
 public:
  /// Keeps a reference to the machine, which knows the limits.
  explicit RunFindings(const timing::TimedMachine& machine);

  /// Takes each block before it is executed.
  void take(const running::Block& block);
  /// Takes an event as programmed, after its block.
  void take(const running::Event& event);
  void take(const RunWarning& warning);
  /// Takes a motion as the machine makes it, with its event, in the order of the run.
  void take(const running::Event& event, kinematics::MadeMove& made);

  /// The outcome of a run that has ended. `text` is that of the program.
  RunOutcome outcome(std::string_view text, const running::RunResult& result) const;

 private:
  /// A joint on one side of its travel.
  struct TravelEnd {
    bool is_passed = false;    ///< A mistake has begun, and the last motion was outside, or partly.
    std::int32_t mistake = 0;  ///< The present or last mistake, an index into farthest_.
  };

  /// The last F that the run has read.
  struct FeedWord {
    std::size_t line = 0;
    double value = 0;
    bool is_reported = false;
  };

  void look_at_travel(const running::Event& event, kinematics::MadeMove& made);
  void look_at_speeds(std::size_t line, kinematics::MadeMove& made);
  std::vector<RunFinding> marked(std::string_view text) const;
  void report(std::size_t line, dialect::DiagnosticId id, const std::array<double, dialect::kMaxArguments>& values,
              std::int32_t mistake = -1);

  const timing::TimedMachine* machine_;
  bool checks_travel_;
  bool checks_speeds_;
  FeedWord feed_;
  std::array<TravelEnd, 2 * kinematics::kAxisCount> ends_;  ///< Two per axis: its minimum and its maximum.
  std::vector<double> farthest_;                            ///< The farthest position of each mistake.
  std::vector<RunFinding> findings_;                        ///< Without spans, in the order of the run.
  TakenPath taken_;
  bool has_jumped_ = true;  ///< The next block starts a stretch.
};

/// The finding that tells that a joint passes the end of its travel, without a span.
syntax::Finding travel_finding(const kinematics::Overtravel& found, bool is_in_inches);

/// The words of a line's motion; all words if it has none.
syntax::Span motion_span(const syntax::LineTree& line);

/// Runs a program on the machine, without its times, and returns what that shows. `options.before_block` is replaced.
RunOutcome outcome_of_run(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine);

}  // namespace isocnc::simulation
