#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "analyzer/check/checker.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/fixing/recent_trees.h"
#include "analyzer/fixing/trails.h"

namespace isocnc::fixing {

/// Whether rewriting all instances of a habit improves the program: fewer findings of the codes that the habit causes,
/// and no new ones except of codes that depend on the corrected reading, such as arcs that fit in mm by the tolerance
/// and not in inches. Those were hidden before.
bool reads_better(const check::Report& before, const check::Report& after, fixes::Habit habit);

/// Tries out fixes, one at a time, on the part of the program that they affect: from the finding's line on, until the
/// check's frontier equals the one without the fix, or one to which an earlier fix led (of twenty that put the same
/// mode in force, only the first is followed to its end). Fixes that edit jumps, labels or lines above the finding are
/// tried on the whole program. Rejects a fix that does not remove its finding or that adds a finding of a code enabled
/// by default. Effects outside the examined lines are assumed harmless: those more than a few thousand lines below or,
/// once the trials of a program have used up their work budget, more than a few.
class FixTrial {
 public:
  /// All must outlive this.
  FixTrial(fixes::FixProgram& program, const rules::CheckSetup& setup, const check::JumpMap& jumps);

  /// `before` is the frontier before the finding's line.
  bool improves(const fixes::Fix& fix, const check::LocatedFinding& located, const check::Frontier& before);
  /// Whether all rewrites of a habit together improve the program (reads_better). Tried once.
  bool improves(fixes::Habit habit);

 private:
  struct TrialComparison;

  bool is_affected_by_jumps(const syntax::LineTree& line) const;
  bool improves_whole_program(const fixes::Fix& fix, const check::LocatedFinding& located);
  /// The findings of the whole program with these edits; nothing once the work budget is used up.
  std::optional<check::Report> found_with(std::vector<fixes::Edit> edits);
  const check::Report* findings_of_whole();
  /// Continues both checks from this line, which is below the edits.
  bool follow(TrialComparison& compared, std::size_t next, const check::LocatedFinding& located);
  void spend(const check::Frontier& frontier);

  fixes::FixProgram& program_;
  const rules::CheckSetup& setup_;
  const check::JumpMap& jumps_;
  RecentTrees lines_;
  Trails trails_;
  std::size_t work_budget_;
  std::optional<check::Report> findings_of_whole_;  // The report on the whole program, made when first needed.
  std::array<std::optional<bool>, fixes::kHabitCount> improving_habits_;
};

}  // namespace isocnc::fixing
