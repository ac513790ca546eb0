#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analyzer/check/frontier.h"
#include "analyzer/check/outcome.h"
#include "interpreter/execution/execute.h"
#include "interpreter/syntax/document.h"

namespace isocnc::check {

/// Machine states that are followed at once; with more, some are given up (W191).
inline constexpr std::size_t kMaxStates = 512;

/// Checks a program line by line on every feasible path. It holds where it stands (`frontier`) and nothing else, so
/// that a check can go on from any earlier frontier.
class Checker {
 public:
  /// With `suspects_centers` arcs under G90 that are also legal with their center counted from the start are reported
  /// (W142). That is for programs in whose outcome others fit only so.
  Checker(const execution::Setup& setup, const JumpMap& jumps, bool suspects_centers = false);

  /// The frontier before the first line.
  static Frontier start(const execution::Setup& setup);

  /// Checks one line.
  void check(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  /// Checks the lines of a chunk, counted from its first.
  void check_all(const syntax::ChunkTrees& trees, Outcome& outcome);
  /// check() for most lines of most programs, in one go: plain ones with which nothing is wrong, and to which no jump
  /// leads. Stops before the first other line; returns the number of lines from `first` on that it has checked.
  std::size_t check_plain_lines(const syntax::TreeStore& trees, std::size_t first, std::uint64_t line_number,
                                Outcome& outcome);
  /// check() for the line where check_plain_lines() has stopped.
  void check_any(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  Frontier frontier;

 private:
  class LineExecution;

  template <class PlainLineAt>
  std::size_t check_plain(std::size_t count, std::uint64_t line_number, Outcome& outcome, PlainLineAt plain_line_at);
  /// Lines that one state alone runs through make up for some of those that more have.
  void reduce_spread(std::size_t lines);
  void report_dead_code(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void arrive(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void execute_around_jump(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void execute_in_all_groups(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void assign(Group& group, int reg, double value, Outcome& outcome) const;
  void report_common_findings(std::uint64_t line_number, Outcome& outcome);
  void branch(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  bool reduce(Groups& groups) const;
  void bound_states(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);
  void admit_reduction(const syntax::LineTree& line, std::uint64_t line_number, Outcome& outcome);

  struct GroupFinding {
    syntax::Finding finding;
    std::size_t group = 0;
  };

  void note_line(const syntax::LineTree& line, const execution::State& before, const execution::State& after,
                 bool has_findings, PositionUse& use) const;
  void judge_arc(const execution::CenteredArc& arc, Outcome& outcome, execution::Sink& sink) const;

  const execution::Setup& setup_;
  const JumpMap& jumps_;
  const bool checks_moves_;
  const bool suspects_centers_;
  std::vector<GroupFinding> group_findings_;  // The findings of one line; a member to keep its memory.
};

}  // namespace isocnc::check
