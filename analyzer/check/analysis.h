#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "analyzer/check/checker.h"
#include "analyzer/check/conclusion.h"
#include "analyzer/check/frontier_change.h"
#include "analyzer/check/jump_numbers.h"
#include "interpreter/syntax/per_chunk.h"

namespace isocnc::check {

/// The check of a document that is being edited. It keeps the check's frontier before each chunk of lines. After an
/// edit it checks the changed chunks, and those after them until the frontier equals the kept one. Chunks that pass on
/// what has changed without another finding are skipped: a shift of positions under G91, and under rows of plain
/// motions also all that these do not read, such as the tool, the spindle, the compensation or the origin. The report
/// equals that of a fresh check.
class Analysis {
 public:
  /// So many chunks of 128 lines are checked in a moment: 0.2 ms, or 2 if each line has findings.
  static constexpr int kChunksInAMoment = 16;

  /// Both must outlive the analysis.
  Analysis(const syntax::Document& document, const rules::CheckSetup& setup);
  /// The same, without a first check: nothing is known before the first update().
  struct Unchecked {};
  Analysis(const syntax::Document& document, const rules::CheckSetup& setup, Unchecked);

  /// Brings the analysis up to date with the document, after any edits. It calls `stop` after each chunk, 128 lines;
  /// once that returns true, update() leaves the rest to the next call and returns false. Until a call returns true,
  /// use frontier_before() as update_before() allows, and the findings as has_known_findings() does.
  bool update(const std::function<bool()>& stop = {});
  /// The same for frontier_before() a line alone.
  bool update_before(std::size_t line, const std::function<bool()>& stop = {});
  /// Whether there are findings while the analysis is behind the text: below the lines checked so far those of an
  /// earlier text, on the lines that they have now. Not while changed lines wait to be checked, as all do at first.
  bool has_known_findings() const;
  Report report() const { return excerpt({}).report; }
  /// The first findings, at most as many as the options allow.
  FirstFindings excerpt(const FirstFindingsOptions& options) const;
  /// The number of findings, without those that need the whole program (see conclude()).
  std::size_t finding_count() const { return counts_.all(); }
  /// The findings on a line of the document, without their paths and without those that need the whole program.
  std::vector<LocatedFinding> findings_on(std::size_t line) const;
  /// The frontier before a line, with the states of all paths through it.
  Frontier frontier_before(std::size_t line) const;
  /// Whether an arc under G90 is legal only with its center counted from the start.
  bool suspects_centers() const { return suspects_centers_; }
  /// Lines that the last update executed: the cost of an edit.
  std::uint64_t lines_checked() const { return lines_checked_; }

 private:
  /// The frontier before a chunk when it was checked, and what was found in the chunk.
  struct Checked {
    Frontier before;  ///< The frontier before the chunk, without Row::shift.
    Outcome outcome;  ///< The findings, with lines counted from the start of the chunk.
  };
  /// The events of a chunk that concern jumps, in few bytes: after an edit of a jump those of all chunks are gone
  /// through.
  class FlowEvents {
   public:
    void push_back(const FlowEvent& event);
    void clear() { *this = {}; }
    void shrink_to_fit();
    std::size_t jump_count() const { return jumps_.size(); }
    /// Removes the labels for which `is_gone` holds. Returns whether there were any.
    template <class IsGone>
    bool erase_labels(IsGone is_gone);
    /// Calls `take` with each event, in order.
    template <class Take>
    void each(Take take) const;
    /// Calls `jump()` for each jump and `assignments(first, end, registers)` for those between two jumps or labels:
    /// their numbers, for assignment(), and the registers that they assign to.
    template <class TakeJump, class TakeAssignments>
    void each_part(TakeJump jump, TakeAssignments assignments) const;
    /// Adds the events to those of a program.
    void collect(std::size_t first_line, JumpCollector& collector) const;

    struct Assignment {
      double value = 0;
      std::uint32_t line = 0;
      std::uint8_t reg = 0;
    };
    const Assignment& assignment(std::size_t number) const { return assignments_[number]; }

   private:
    /// A jump or a label.
    struct JumpOrLabel {
      std::uint64_t label = 0;  ///< The label defined, or jumped to.
      std::uint32_t line = 0;
      std::uint32_t first_assignment = 0;  ///< The number of the first assignment after it.
      RegisterSet assigned = 0;            ///< Registers assigned to between it and the next one.
      bool is_jump = false;
    };

    std::vector<JumpOrLabel> places_;
    RegisterSet assigned_first_ = 0;  // Registers assigned to before the first place.
    std::vector<Assignment> assignments_;
    std::vector<syntax::Jump> jumps_;
  };
  /// The range of the labels in a chunk.
  struct LabelRange {
    std::uint64_t min = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t max = 0;

    /// The range assumed before the labels are read.
    static LabelRange any() { return {0, std::numeric_limits<std::uint64_t>::max()}; }
    static LabelRange of(const syntax::ChunkTrees& trees);
    void add(std::uint64_t label) {
      min = std::min(min, label);
      max = std::max(max, label);
    }

    friend bool operator==(const LabelRange&, const LabelRange&) = default;
  };
  /// Labels that jumps name after an edit, and did not name before, and the reverse; ascending.
  struct NamedLabels {
    std::vector<std::uint64_t> added;
    std::vector<std::uint64_t> removed;

    bool removes(std::uint64_t label) const;
  };
  struct Row {
    PositionShift shift;      ///< The shift of all positions before the chunk since it was checked.
    PositionUse positions;    ///< A copy from the outcome.
    bool is_stale = true;     ///< Whether the chunk must be checked.
    bool is_new = true;       ///< Whether it has never been checked.
    CenterUse centers;        ///< A copy from the outcome.
    bool may_assign = false;  ///< A copy from the outcome.
    bool has_text = false;
    bool has_more = false;  ///< Whether the outcome has more than text.
    FlowEvents jumps;       ///< The events that concern jumps; labels only if a jump names them.
    LabelRange labels = LabelRange::any();
    std::unique_ptr<Checked> checked = std::make_unique<Checked>();
  };

  void follow_text();
  bool follow_centers(const std::function<bool()>& stop);
  bool check_stale(std::size_t end, const std::function<bool()>& stop);
  void start_at(std::size_t chunk, Frontier frontier);
  Frontier before(std::size_t chunk) const;
  void read_jumps(std::size_t chunk, Row& row) const;
  void follow_jumps(const syntax::ChunkChange& change, const std::vector<FlowEvent>& old_events);
  void move_jumps(const syntax::ChunkChange& change);
  JumpMap find_jumps(const std::vector<FlowEvent>& old_events, const std::vector<FlowEvent>& new_events);
  NamedLabels named_labels(const std::vector<FlowEvent>& old_events, const std::vector<FlowEvent>& new_events) const;
  void follow_labels(const NamedLabels& change);
  bool read_labels(std::size_t chunk, const NamedLabels& change);
  JumpNumbers number_jumps(const syntax::ChunkChange& change, const std::vector<FlowEvent>& old_events,
                           const std::vector<FlowEvent>& new_events) const;
  void check_changed_jumps_again(const syntax::ChunkChange& change, const JumpMap& old_jumps, JumpNumbers numbers);
  bool check_from(std::size_t chunk, std::size_t end, const std::function<bool()>& stop);
  void check_chunk(std::size_t chunk, const syntax::ChunkTrees& trees, Checker& checker);
  bool passes(std::size_t chunk, const FrontierChange& change) const;
  std::size_t pass_over(std::size_t chunk, FrontierChange& change);

  const syntax::Document& document_;
  const rules::CheckSetup& setup_;
  JumpMap jumps_;
  syntax::PerChunk<Row> rows_;
  std::size_t line_count_ = 0;  // Lines of the document at the last update of the jumps.
  bool suspects_centers_ = false;
  Frontier end_;
  FindingCounts counts_;
  std::uint64_t lines_checked_ = 0;
};

}  // namespace isocnc::check
