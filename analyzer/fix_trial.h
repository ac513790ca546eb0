#pragma once

#include <cstdint>
#include <optional>

#include "analyzer/checker.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/tally.h"

namespace isocnc::analyzer {

/// Tries fixes out, one at a time, on the part of a program that they concern: from the finding's line on, until the
/// check stands where it would stand without them. Those that edit jumps, labels or lines above the finding are tried
/// on the whole program. A fix that leaves its finding, or brings another one that is told by default, is none. What
/// cannot be seen there counts as fine: effects more than a few thousand lines below, and all once the trials of a
/// program have cost too much.
class FixTrial {
 public:
  /// All must outlive this.
  FixTrial(fixes::Program& program, const execution::Setup& setup, const JumpMap& jumps);

  /// `before` is where the check stands before the finding's line.
  bool mends(const fixes::Fix& fix, const LocatedFinding& located, const Frontier& before);

 private:
  bool is_concerned_by_jumps(std::string_view line) const;
  bool mends_in_whole(const fixes::Fix& fix, const LocatedFinding& located);

  fixes::Program& program_;
  const execution::Setup& setup_;
  const JumpMap& jumps_;
  std::uint64_t work_left_;
  std::optional<Tally> found_in_whole_;  // Once it is asked for.
};

}  // namespace isocnc::analyzer
