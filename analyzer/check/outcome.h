#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "analyzer/check/frontier.h"
#include "interpreter/execution/plain_run.h"

namespace isocnc::check {

/// Which axis positions before a range of lines affect the findings in it and the positions after it. An axis
/// outside `set` has moved by increments alone.
struct PositionUse {
  execution::AxisSet read = 0;  ///< Axes whose position before the lines affects findings or frames in them.
  execution::AxisSet set = 0;   ///< Axes whose position after the lines does not depend on that before.
  bool by_several = false;      ///< Whether there were several states, live or waiting: `set` may not hold for all.
  bool far = false;  ///< Whether an axis was, before or after a move, too far away for moves to add up exactly.
};

/// Evidence from the arcs of a range of lines on whether centers under G90 count from the start (D70). For the arcs of
/// a PlainRun, `open` is set as soon as it examines one more closely.
struct CenterUse {
  bool from_start = false;  ///< Whether an arc is legal only with its center counted from the start.
  bool open = false;  ///< Whether an arc is legal as written and may be so with its center counted from the start.
};

/// A set of folds, one bit each.
using FoldSet = std::uint8_t;
constexpr FoldSet fold_bit(dialect::FoldKind fold) { return static_cast<FoldSet>(1u << static_cast<unsigned>(fold)); }

/// The findings in a range of lines, and the facts needed to combine ranges.
struct Outcome {
  struct Label {
    std::uint64_t label = 0;
    std::size_t line = 0;
    syntax::Span span;
    bool live = false;  ///< Whether a feasible path leads to the label.
  };

  /// A line that ends folds: findings from it on are no repetitions of those above it (D66).
  struct FoldEnd {
    std::size_t line = 0;
    FoldSet folds = 0;
  };

  /// A finding of which it depends on other lines whether it counts (needs_look()), in few bytes.
  struct Look {
    std::uint32_t line = 0;
    std::int32_t path = LocatedFinding::kEveryPath;
    syntax::Span span;
    dialect::DiagnosticId id = dialect::kNoDiagnostic;
    double label = 0;  ///< The label not found, of E004.
  };

  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

  std::vector<LocatedFinding> findings;  ///< The findings, in the order of the lines.
  std::vector<Decisions> paths;
  std::vector<Label> labels;              ///< Definitions of labels that some GOTO names.
  std::vector<std::uint32_t> live_jumps;  ///< Jumps on a feasible path, counted from the top of the file.
  std::size_t last_text_line = 0;         ///< The last line that holds any text (D47); valid if `has_text`.
  bool has_text = false;
  RegisterSet assigned = 0;  ///< Registers assigned a value; recorded only if some IF compares one.
  bool may_assign = false;   ///< Whether a line that has lost a letter may assign a register; no FlowEvent tells it.
  PositionUse positions;
  CenterUse centers;
  std::optional<execution::PlainEffects> only_row;  ///< If the lines parsed together last are one row of plain motions.
  /// The first line with a jump that may lead anywhere below, as its label cannot be read or found (D63).
  std::size_t leads_anywhere_from = kNowhere;
  /// The numbers of lines whose line number has been reported as another word (N3O, 30, B30): jumps to them are not
  /// reported as well.
  std::vector<double> misspelled_labels;
  /// The lines that end folds, ascending. Of those between two findings of a fold, only the first is recorded.
  std::vector<FoldEnd> fold_ends;
  FoldSet ended_folds = 0;  ///< Folds without a finding since they were last ended.
  std::vector<std::pair<dialect::DiagnosticId, std::size_t>> tally;  ///< Findings of each kind, after count().
  std::vector<Look> looks;                                           ///< After count(), in the order of `findings`.

  void clear();
  /// Sums up the findings, so that those after an excerpt need not all be gone through.
  void count();
  /// Appends a finding that may belong to a fold.
  void report(const LocatedFinding& located);
  void end_folds(FoldSet folds, std::size_t line);
  /// Appends what was found in the lines below, numbered from 0 at line `first_line` of this outcome. What count() and
  /// `only_row` say is that of the lines before.
  void append(Outcome next, std::size_t first_line);
};

/// Whether a finding assumes that all ways to its line are known: W116, W117, and what is said of the spindle only
/// where it is so on every path. After a jump that may lead anywhere, no such finding is made.
bool assumes_all_paths(dialect::DiagnosticId id);
/// Whether findings of a code must be looked at one by one, and not only be counted.
bool needs_look(dialect::DiagnosticId id);

/// The number of findings of each kind in several outcomes; each needs a call of count() before.
class FindingCounts {
 public:
  void add(const Outcome& outcome);
  void remove(const Outcome& outcome);
  std::size_t of(dialect::DiagnosticId id) const { return counts_[static_cast<std::size_t>(id)]; }
  std::size_t all() const { return all_; }

 private:
  std::array<std::size_t, dialect::kDiagnosticCount> counts_{};
  std::size_t all_ = 0;
};

}  // namespace isocnc::check
