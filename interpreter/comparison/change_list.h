#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/comparison/alignment.h"
#include "interpreter/comparison/comparison.h"
#include "interpreter/comparison/motion_steps.h"

namespace isocnc::comparison {

/// What an action does, as programs write it: `F4000`, `S12000 M03`.
std::string value_of(const RecordedRun& run, const MachineAction& action);

/// What a change of such actions is.
ChangeKind kind_of(ActionKind kind);

/// The tool that is mounted in an action.
std::optional<execution::ToolCode> tool_of(const RecordedRun& run, const MachineAction& action);

/// The lines of a range of actions; none for an empty one.
std::optional<ChangedLines> lines_of(const RecordedRun& run, std::size_t begin, std::size_t end);

/// How long a run takes for a range of actions, seconds.
double seconds_of(const RecordedRun& run, std::size_t begin, std::size_t end);

/// Whether two actions are the same, wherever they come from: with the same feed, too, unless that is ignored.
bool is_same_alone(const RunPair& runs, const ComparisonOptions& options, const MachineAction& a,
                   const MachineAction& b);

/// How many motions a range of actions has.
std::size_t motion_count(const RecordedRun& run, std::size_t begin, std::size_t end);

/// The changes that are found along two runs. Those that may go on for a while, a shift and another feed, are followed
/// and become one change each where they end.
class ChangeList {
 public:
  ChangeList(const RunPair& runs, const ComparisonOptions& options);

  const RunPair& runs() const { return runs_; }
  const ComparisonOptions& options() const { return options_; }

  /// Adds a change with its lines, tools and counts; the caller sets the rest before it adds another one.
  BehaviorChange& add(ChangeKind kind, const ActionRanges& at);

  /// All of both ranges is the same but for a shift; 0 ends the one before.
  void follow_shift(const ActionRanges& at, const geometry::Vec3& shift);

  /// The next motions that take the place of each other, by their indices in both runs: their feeds, and how the
  /// spindle turns in them.
  void compare_feeds(std::size_t i, std::size_t k);
  /// G41, G42 or none of these motions, with or without G39. Where the radius of the tool is known, the path itself
  /// shows it.
  void compare_sides(std::size_t i, std::size_t k);
  void compare_feeds_along(const AlignedPiece& piece);
  /// Feeds of motions that do not follow each other in both runs.
  void compare_feeds_alone(std::size_t i, std::size_t k);

  /// Whether two motions end elsewhere because another frame is in force, and are the same in it.
  bool is_moved_by_frame(std::size_t i, std::size_t k) const;

  /// A change of all from a tool change to the next one, at a place in the runs without it.
  void add_operation(BehaviorChange change, const ActionRanges& place);

  /// All changes, in the order of the runs.
  std::vector<BehaviorChange> take();

 private:
  struct OpenShift {
    ActionRanges actions;
    geometry::Vec3 shift = geometry::Vec3::Zero();
  };
  /// How much of the first and the last motion of a value is outside of it, as parts of their lengths: lines that one
  /// run has in pieces may change within a line of the other one.
  struct OutsideParts {
    double first = 0;
    double last = 0;
  };
  /// Another value that goes on for a while.
  struct OpenValue {
    ActionRanges actions;
    std::string old_value;
    std::string new_value;
    OutsideParts of_a = {};
    OutsideParts of_b = {};
    /// Of the path with this value, mm, where that is known.
    double length = std::numeric_limits<double>::infinity();
  };

  /// Feed moves in which the spindle of one run turns otherwise than that of the other one.
  struct SpindleStretch {
    ActionRanges actions;
    std::uint32_t a_spindle = 0;
    std::uint32_t b_spindle = 0;
  };

  /// The lines that have made the frames of both runs different; none for what is in force at the start.
  struct FrameCause {
    std::optional<std::size_t> old_line;
    std::optional<std::size_t> new_line;

    friend bool operator==(const FrameCause&, const FrameCause&) = default;
  };
  struct FrameChange {
    FrameCause cause;
    geometry::Vec3 shift = geometry::Vec3::Zero();  ///< Of the origin.
    bool is_turned = false;
  };

  const MachineAction& a(std::size_t i) const { return runs_.a.actions[i]; }
  const MachineAction& b(std::size_t i) const { return runs_.b.actions[i]; }
  BehaviorChange measured_change(ChangeKind kind, const ActionRanges& at) const;
  bool is_shift_of_frame(const MachineAction& left, const MachineAction& right, const geometry::Vec3& shift) const;
  ActionRanges up_to_next_frame(const OpenShift& open) const;
  void close_shift();
  void close_feed() { close(feed_, ChangeKind::Feed); }
  void close_side() { close(side_, ChangeKind::Function); }
  void compare_overlaps();
  /// Motions that go along each other for some length, mm.
  void compare_feeds(std::size_t i, std::size_t k, const OutsideParts& of_a, const OutsideParts& of_b, double length);
  void close(std::optional<OpenValue>& open, ChangeKind kind);
  void follow_value(std::optional<OpenValue>& open, ChangeKind kind, OpenValue next);
  void compare_spindles(std::size_t i, std::size_t k);
  void name_spindles();
  void name_frames();
  FrameCause cause_of(const MachineAction& left, const MachineAction& right) const;
  bool has_same_frame(const MachineAction& left, const MachineAction& right) const;
  std::optional<FrameChange> by_frames(const ActionRanges& at) const;
  bool is_by_frames(const MachineAction& left, const MachineAction& right) const;
  void join_moved_blocks();
  void name_exchanged_blocks();
  bool is_exchanged(std::size_t block, std::size_t place) const;
  bool has_same_actions(const ActionRanges& of_a, const ActionRanges& of_b) const;
  std::optional<std::size_t> retract_after(const ActionRanges& removed, const ActionRanges& added) const;
  void join_moved_rows();
  bool is_one_row(std::size_t first, std::size_t next) const;
  void join_paths_beside();
  bool is_path(std::size_t change) const;
  bool follows(const ActionRanges& all, const ActionRanges& next) const;
  void rename_moved(std::size_t change);
  ActionRanges up_to_closing(ActionRanges all) const;
  bool may_be_mistaken(std::span<const std::size_t> row) const;
  bool join_path(std::span<const std::size_t> row, const ActionRanges& at, double reported);
  bool goes_beside(const ActionRanges& all, double distance, bool with_feeds) const;
  std::optional<std::pair<ActionRanges, double>> moved_ends(const ActionRanges& all, double farthest) const;
  void remove_idle_stops();
  void remove(const std::vector<bool>& is_removed);
  bool is_same_block(const ActionRanges& removed, const ActionRanges& added) const;
  void sort();

  const RunPair& runs_;
  const ComparisonOptions& options_;
  std::vector<BehaviorChange> changes_;
  std::vector<ActionRanges> places_;  ///< Of each change.
  std::optional<OpenShift> shift_;
  std::optional<OpenValue> feed_;
  std::optional<OpenValue> side_;
  std::vector<SpindleStretch> spindle_stretches_;
  std::vector<std::pair<std::size_t, std::size_t>> overlaps_;
  std::vector<std::pair<BehaviorChange, ActionRanges>> operations_;
};

}  // namespace isocnc::comparison
