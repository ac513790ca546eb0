#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "analyzer/frontier.h"
#include "interpreter/execution/execute.h"

namespace isocnc::analyzer {

/// What the check of a stretch of lines has found.
struct Outcome {
  struct Label {
    std::uint64_t label = 0;
    std::uint64_t line = 0;
    syntax::Span span;
    bool live = false;  ///< On a feasible path.
  };

  std::vector<LocatedFinding> findings;  ///< In the order of the lines.
  std::vector<Path> paths;
  std::vector<Label> labels;              ///< Definitions of labels that some GOTO names.
  std::vector<std::uint32_t> live_jumps;  ///< Jumps on a feasible path, counted from the top of the file.
  std::uint64_t last_text_line = 0;       ///< The last that holds any text (D47), if one does.
  bool has_text = false;
  RegisterSet assigned = 0;  ///< Registers that have been given a value; followed only where an IF compares one.

  void clear();
};

/// Most machine states that are followed at once (W191).
inline constexpr std::size_t kMostStates = 512;

/// Checks a program line by line on every feasible path. It holds where it stands (`frontier`) and nothing else, so
/// that a check can go on from any earlier frontier.
class Checker {
 public:
  Checker(const execution::Setup& setup, const JumpMap& jumps);

  /// The frontier before the first line.
  static Frontier start(const execution::Setup& setup, const JumpMap& jumps);

  void check(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  Frontier frontier;

 private:
  class Listener;

  void check_straight(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void tell_of_dead_code(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void arrive(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void execute_in_all_groups(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void report_common_findings(std::uint64_t line_number, Outcome& outcome);
  void branch(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void bound_states(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void admit_reduction(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  struct GroupFinding {
    syntax::Finding finding;
    std::size_t group = 0;
  };

  void judge_move(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
                  execution::Sink& sink);

  const execution::Setup& setup_;
  const JumpMap& jumps_;
  const bool watches_moves_;
  std::optional<execution::Move> move_;       // Of the line, where moves are watched.
  std::vector<GroupFinding> group_findings_;  // Of one line; kept for its memory.
};

/// Puts together what was found: sorts, adds what only the whole program shows (E006, ISO045), and leaves of the
/// findings that are said once per program the first (D44). `text_of_line` gives a line's text.
Report conclude(std::vector<Outcome> outcomes, const Frontier& end, const JumpMap& jumps,
                const std::function<std::string_view(std::uint64_t)>& text_of_line);

/// Whether the labels seen tell where each jump on a feasible path goes.
bool all_jumps_land(const Outcome& outcome, const JumpMap& jumps);

}  // namespace isocnc::analyzer
