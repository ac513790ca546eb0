#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "analyzer/check/checker.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/fixing/recent_trees.h"
#include "analyzer/fixing/trails.h"

namespace isocnc::fixing {

/// Whether a program reads better once all that shows a habit has been rewritten: less is found of what the habit
/// leads to, and nothing new but what shows only when the program is read as it was meant, such as arcs that fit in
/// mm by the tolerance and not in inches. What is found then was wrong before.
bool reads_better(const check::Report& before, const check::Report& after, fixes::Habit habit);

/// Tries fixes out, one at a time, on the part of a program that they concern: from the finding's line on, until the
/// check stands where it would stand without them, or where an earlier fix has led it (of twenty that put the same
/// mode in force, only the first is followed to its end). Those that edit jumps, labels or lines above the finding are
/// tried on the whole program. A fix that leaves its finding, or brings another one that is reported by default, is
/// none. What cannot be seen there counts as fine: effects more than a few thousand lines below, or, once the trials of
/// a program have cost too much, more than a few.
class FixTrial {
 public:
  /// All must outlive this.
  FixTrial(fixes::Program& program, const execution::Setup& setup, const check::JumpMap& jumps);

  /// `before` is where the check stands before the finding's line.
  bool improves(const fixes::Fix& fix, const check::LocatedFinding& located, const check::Frontier& before);
  /// Whether all rewrites of a habit make the program read better (reads_better). Tried once.
  bool improves(fixes::Habit habit);

 private:
  struct Comparison;

  bool is_affected_by_jumps(const syntax::LineTree& line) const;
  bool improves_whole_program(const fixes::Fix& fix, const check::LocatedFinding& located);
  /// What is found in the whole program with these edits; nothing once too much has been spent.
  std::optional<check::Report> found_with(std::vector<fixes::Edit> edits);
  const check::Report* findings_of_whole();
  /// Goes on from this line, below the edits.
  bool follow(Comparison& compared, std::uint64_t next, const check::LocatedFinding& located);
  void spend(const check::Frontier& frontier);

  fixes::Program& program_;
  const execution::Setup& setup_;
  const check::JumpMap& jumps_;
  RecentTrees lines_;
  Trails trails_;
  std::uint64_t work_budget_;
  std::optional<check::Report> findings_of_whole_;  // The report on the whole program, once it has been asked for.
  std::array<std::optional<bool>, fixes::kHabitCount> improving_habits_;
};

}  // namespace isocnc::fixing
