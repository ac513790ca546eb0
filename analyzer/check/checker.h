#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analyzer/check/frontier.h"
#include "analyzer/check/outcome.h"
#include "analyzer/rules/check_setup.h"
#include "interpreter/execution/execute.h"
#include "interpreter/syntax/document.h"

namespace isocnc::check {

/// Checks a program line by line on every feasible path. Its only state is `frontier`, so that a check can continue
/// from any earlier frontier.
class Checker {
 public:
  /// With `suspects_centers`, reports W142 for arcs under G90 that are also legal with their center counted from the
  /// start. Set it after a first pass has found arcs that are legal only that way.
  Checker(const rules::CheckSetup& setup, const JumpMap& jumps, bool suspects_centers = false);

  /// The frontier before the first line.
  static Frontier start(const rules::CheckSetup& setup);

  /// Checks one line.
  void check(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  /// Checks the lines of a chunk, numbered from 0 at its first line.
  void check_all(const syntax::ChunkTrees& trees, Outcome& outcome);
  /// Fast check() for a run of plain lines without findings and without labels that a jump names. Stops before the
  /// first other line; returns the number of lines checked, counted from `first`.
  std::size_t check_plain_lines(const syntax::TreeStore& trees, std::size_t first, std::size_t line_number,
                                Outcome& outcome);
  /// check() for the line at which check_plain_lines() stopped.
  void check_any(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);

  const rules::CheckSetup& setup() const { return setup_; }

  Frontier frontier;

 private:
  class LineExecution;

  template <class PlainLineAt, class ChangesNothingAt>
  std::size_t check_plain(std::size_t count, std::size_t line_number, Outcome& outcome, PlainLineAt plain_line_at,
                          ChangesNothingAt changes_nothing_at);
  void report_dead_code(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void arrive(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void check_two_blocks(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  bool check_carried(const syntax::LineTree& line, const execution::Lack& lack, std::size_t line_number,
                     std::size_t first_label, Outcome& outcome);
  void execute_carried(const syntax::LineTree& words, bool is_of_motion, std::size_t line_number, Outcome& outcome);
  void check_block(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void execute_around_jump(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void execute_in_all_groups(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void assign(Group& group, int reg, double value, Outcome& outcome) const;
  void report_common_findings(std::size_t line_number, Outcome& outcome);
  void pass_jump_to_nowhere(const syntax::Jump& jump);
  void branch(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);
  void admit_reduction(const syntax::LineTree& line, std::size_t line_number, Outcome& outcome);

  struct GroupFinding {
    syntax::Finding finding;
    std::size_t group = 0;
  };

  void judge_arc(const execution::CenteredArc& arc, Outcome& outcome, execution::Sink& sink) const;

  const rules::CheckSetup& setup_;
  const JumpMap& jumps_;
  const rules::HouseRules* const house_;  // Null without house rules.
  const bool checks_moves_;
  const bool suspects_centers_;
  execution::PlainEffects last_row_;          // Of the lines that check_plain() has checked last.
  std::vector<GroupFinding> group_findings_;  // The findings of one line; a member to keep its memory.
};

}  // namespace isocnc::check
