#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "analyzer/check/checker.h"
#include "analyzer/check/conclusion.h"
#include "analyzer/check/position_shift.h"
#include "interpreter/syntax/per_chunk.h"

namespace isocnc::check {

/// The check of a document that is being edited. It remembers where the check stood before each chunk of lines; after
/// an edit it checks the chunks that changed, and those after them until it stands where it stood before, or all is as
/// before but shifted: over chunks that do not mind a shift it passes without looking at their lines. The report is the
/// one that a fresh check would give.
class Analysis {
 public:
  /// Both must outlive the analysis.
  Analysis(const syntax::Document& document, const execution::Setup& setup);
  /// The same without a check: nothing is known before the first update().
  struct Unchecked {};
  Analysis(const syntax::Document& document, const execution::Setup& setup, Unchecked);

  /// Brings the analysis up to date with the document, whatever has been edited. Asked now and then whether to `stop`,
  /// it may leave the rest for the next call: then it returns false, and nothing may be asked of it before that.
  bool update(const std::function<bool()>& stop = {});
  Report report() const { return excerpt({}).report; }
  /// The first findings of many.
  FirstFindings excerpt(const FirstFindingsOptions& options) const;
  /// The number of findings, without those that only the whole program shows.
  std::size_t finding_count() const { return counts_.all(); }
  /// The findings on a line of the document, without their paths and those that only the whole program shows.
  std::vector<LocatedFinding> findings_on(std::size_t line) const;
  /// Where the check stands before a line, with the states of all paths through it.
  Frontier frontier_before(std::size_t line) const;
  /// Whether an arc under G90 fits only with its center counted from the start.
  bool suspects_centers() const { return suspects_centers_; }
  /// Lines executed by the last update: what an edit costs.
  std::uint64_t lines_checked() const { return lines_checked_; }

 private:
  /// Where the check stood when it came to a chunk, and what it found there.
  struct Checked {
    Frontier before;  ///< The frontier before the chunk, without Row::shift.
    Outcome outcome;  ///< What was found, with lines counted from the start of the chunk.
  };
  /// The range of the labels in a chunk.
  struct LabelRange {
    std::uint64_t min = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max = 0;

    /// The range before they are read.
    static LabelRange any() { return {0, std::numeric_limits<std::uint64_t>::max()}; }
    void add(std::uint64_t label) {
      min = std::min(min, label);
      max = std::max(max, label);
    }
  };
  struct Row {
    PositionShift shift;    ///< The shift of all positions before the chunk since it was checked.
    PositionUse positions;  ///< A copy from the outcome.
    bool is_stale = true;   ///< Whether the chunk must be checked.
    CenterUse centers;      ///< A copy from the outcome.
    bool has_text = false;
    bool has_more = false;         ///< Whether the outcome has findings, labels, jumps or assignments.
    std::vector<JumpEvent> jumps;  ///< What concerns jumps; of the labels those that some jump names.
    LabelRange labels = LabelRange::any();
    std::unique_ptr<Checked> checked = std::make_unique<Checked>();
  };

  using Change = syntax::PerChunk<Row>::Change;

  bool follow_text(const std::function<bool()>& stop);
  bool follow_centers(const std::function<bool()>& stop);
  bool check_stale(const std::function<bool()>& stop);
  Frontier before(std::size_t chunk) const;
  void read_jumps(std::size_t chunk, Row& row) const;
  bool follow_jumps(const Change& change, const std::vector<JumpEvent>& old_events);
  void move_jumps(const Change& change);
  template <class Take>
  void each_jump_event(Take take) const;
  JumpMap find_jumps();
  std::vector<std::uint64_t> labels_named() const;
  void follow_labels(const std::vector<std::uint64_t>& named);
  bool read_labels(std::size_t chunk, const std::vector<std::uint64_t>& wanted);
  void check_changed_jumps_again(const JumpMap& old_jumps);
  bool check_from(std::size_t chunk, Frontier frontier, const std::function<bool()>& stop);
  void check_chunk(std::size_t chunk, const syntax::ChunkTrees& trees, Checker& checker);
  std::size_t pass_over(std::size_t chunk, PositionShift& shift);

  const syntax::Document& document_;
  const execution::Setup& setup_;
  JumpMap jumps_;
  syntax::PerChunk<Row> rows_;
  std::size_t line_count_ = 0;  // Lines of the document at the last update of the jumps.
  bool suspects_centers_ = false;
  Frontier end_;
  FindingCounts counts_;
  std::uint64_t lines_checked_ = 0;
};

}  // namespace isocnc::check
