#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "analyzer/check/frontier.h"

namespace isocnc::check {

/// How what has been found in a stretch of lines, and the positions after it, depend on the positions before it.
struct PositionUse {
  execution::AxisSet read = 0;  ///< Axes whose positions before it findings or frames depend on.
  execution::AxisSet set = 0;   ///< Axes whose positions after it do not depend on those; the others have moved on.
  bool by_several = false;  ///< Whether there was more than one state, live or waiting: `set` holds for some of them.
  bool far = false;         ///< Whether an axis has been too far away for moves to add up exactly.
};

/// What the arcs of a stretch of lines say of how centers are meant under G90 (D70). Arcs of a PlainRun count as open
/// already when it takes a closer look.
struct CenterUse {
  bool from_start = false;  ///< Whether an arc fits only with its center counted from the start.
  bool open = false;        ///< Whether an arc is right, and may be so with its center counted from the start as well.
};

/// What the check of a stretch of lines has found.
struct Outcome {
  struct Label {
    std::uint64_t label = 0;
    std::uint64_t line = 0;
    syntax::Span span;
    bool live = false;  ///< Whether a feasible path leads there.
  };

  std::vector<LocatedFinding> findings;  ///< In the order of the lines.
  std::vector<Path> paths;
  std::vector<Label> labels;              ///< Definitions of labels that some GOTO names.
  std::vector<std::uint32_t> live_jumps;  ///< Jumps on a feasible path, counted from the top of the file.
  std::uint64_t last_text_line = 0;       ///< The last line that holds any text (D47), if one does.
  bool has_text = false;
  RegisterSet assigned = 0;  ///< Registers that have been given a value; followed only where an IF compares one.
  PositionUse positions;
  CenterUse centers;
  std::vector<std::pair<dialect::DiagnosticId, std::size_t>> tally;  ///< Findings of each kind, after count().

  void clear();
  void count();
};

/// The number of findings of each kind in several outcomes that have been counted.
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
