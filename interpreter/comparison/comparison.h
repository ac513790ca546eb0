#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/comparison/machine_action.h"

namespace isocnc::comparison {

/// What changes, in the order of their names in JSON.
enum class ChangeKind : std::uint8_t {
  Moved,      ///< The same motions, elsewhere.
  Shape,      ///< Another path between the same places, or the same one the other way around.
  Added,      ///< Motions that only the new program has.
  Removed,    ///< Motions that only the old program has.
  Reordered,  ///< The same in another order.
  Feed,       ///< Another feed, or a rapid instead of a feed move.
  Speed,      ///< The spindle turns otherwise.
  Tool,       ///< Another tool, or a tool change more or less.
  Function,   ///< An M of the user, a signal such as G990, or an exact stop. Without values: too many to look into.
  Frame,      ///< All is moved because the frame is elsewhere.
  Dwell,      ///< Another time at rest.
  Path,       ///< An IF is taken by one program only.
  End,        ///< The run ends otherwise.
};

/// The first and the last line of a change, from 0.
struct ChangedLines {
  std::size_t first = 0;
  std::size_t last = 0;

  friend bool operator==(const ChangedLines&, const ChangedLines&) = default;
};

/// A difference between the behavior of two programs, without its text.
struct BehaviorChange {
  ChangeKind kind = ChangeKind::Moved;
  std::optional<ChangedLines> old_lines;
  std::optional<ChangedLines> new_lines;
  /// Where each program comes to the change: the line of the first action that has a part in it, or else of the one
  /// that it does next. From 0.
  std::size_t old_start = 0;
  std::size_t new_start = 0;
  std::optional<execution::ToolCode> old_tool;  ///< The mounted one, if the old program has a part in the change.
  std::optional<execution::ToolCode> new_tool;
  /// Moved and Shape: how far a point of one path is at most from the other path, mm, or the length of `shift`; 0 for
  /// the same path the other way around. None where only B and C differ, or where that was not computed. Of what the
  /// machine does elsewhere on the same path: the length of `later`. Added and Removed: how far the next motion
  /// goes from where that of the other program goes, if one of them goes where the other program does not go; its line
  /// is then that of the program that has no more of the change.
  std::optional<double> distance;
  /// Moved and Frame: by how much a motion ends elsewhere at most. Added and Removed: how far that program's path is
  /// from the other one at most. mm.
  double end_distance = 0;
  double turned = 0;                    ///< Moved, Shape: by how much B or C differ at most, degrees.
  std::optional<geometry::Vec3> shift;  ///< From old to new, mm, if all is moved by the same.
  double later = 0;    ///< Function, Dwell, Speed, Tool: how much farther on the way the new program does the same, mm.
  double seconds = 0;  ///< How much longer the new program takes for its part, until it does what follows.
  /// As programs write it: `F4000`, `S12000 M03`; empty for nothing. Reordered, of an operation: the tool before it,
  /// empty for the first one.
  std::string old_value;
  std::string new_value;
  std::size_t old_motions = 0;
  std::size_t new_motions = 0;
  bool is_operation = false;  ///< Added, Removed, Reordered: all from a tool change to the next one.
  /// Path: the line of the IF in the program that takes it; Frame: that of its G in each program. From 0.
  std::optional<std::size_t> old_cause;
  std::optional<std::size_t> new_cause;

  std::optional<execution::ToolCode> tool() const { return new_tool ? new_tool : old_tool; }
  friend bool operator==(const BehaviorChange&, const BehaviorChange&) = default;
};

struct ComparisonOptions {
  double tolerance = 0.001;   ///< Places this near are the same; mm, and degrees for B and C. Positive.
  bool ignores_feed = false;  ///< But not a rapid instead of a feed move.
  bool ignores_speed = false;
  bool ignores_time = false;  ///< Dwells and exact stops.
};

/// An order of runs that makes the result independent of which one is the old one: the first one is aligned as `a`.
bool is_before(const RecordedRun& left, const RecordedRun& right);

/// Compares what the machine does in two runs. Swapping the runs gives the same changes, mirrored.
std::vector<BehaviorChange> compare(const RecordedRun& old_run, const RecordedRun& new_run,
                                    const ComparisonOptions& options);

/// The next actions of both runs that belong together, as ranges of their indices: both do the same, or nothing in it
/// fits together, and one range may be empty.
struct AlignedStep {
  std::size_t old_begin = 0;
  std::size_t old_end = 0;
  std::size_t new_begin = 0;
  std::size_t new_end = 0;
  bool is_same = false;
};

/// Both runs side by side, from their starts to their ends.
std::vector<AlignedStep> aligned_steps(const RecordedRun& old_run, const RecordedRun& new_run, double tolerance);

}  // namespace isocnc::comparison
