#include "lsp/queries/machine_motion.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "interpreter/execution/machine_move.h"
#include "interpreter/execution/plane.h"
#include "interpreter/timing/timing.h"
#include "interpreter/timing/tip_position.h"

namespace isocnc::queries {

using documents::LandmarkKind;
using documents::Snapshot;
using execution::AxisSet;
using execution::State;
using execution::ToolCode;
using geometry::Pose;

std::optional<ToolCode> mounted_tool(const Snapshot& snapshot, std::size_t lines, const State& state) {
  if (state.tool_known) return state.tool;
  const std::vector<documents::Landmark> changes = snapshot.index().landmarks(LandmarkKind::ToolChange);
  if (!changes.empty() && changes.front().line < lines) return std::nullopt;
  return ToolCode();
}

static Pose pose_in_machine(const State& state) {
  return {state.to_machine(state.position.tip), state.position.b, state.position.c};
}

/// Whether the motion leads a tool that G41 or G42 have left beside the program back to it: none along the normal of
/// the plane does.
static bool leads_back(const LineRun& run) {
  if (!run.move || run.moved_in.is_compensated()) return false;
  if (run.move->kind == execution::MoveKind::Arc) return true;
  geometry::Vec3 way = run.move->to.tip - run.move->from.tip;
  way[execution::plane_in_force(run.moved_in).normal] = 0;
  return way != geometry::Vec3::Zero();
}

namespace {

/// What lines show of the tip after them, read upward: whether it is where the program has it.
struct ShownByLines {
  AxisSet placed = 0;                  ///< Axes that have got a coordinate since the last tool change.
  std::optional<geometry::Mat3> axes;  ///< Of the frame of these coordinates.
  bool is_led_back = false;            ///< A motion without compensation has led the tool back to the program.
  bool is_beside = false;              ///< The tool may be beside the program.

  bool is_on_program() const { return is_led_back && placed == execution::kLinearAxes; }

  void take(const LineRun& above) {
    is_led_back = is_led_back || leads_back(above);
    if (!is_led_back && (above.before.is_compensated() || above.after.is_compensated())) is_beside = true;
    if (!above.move || placed == execution::kLinearAxes) return;
    // Coordinates along other axes leave a part of what a tool change has shifted.
    if (axes && *axes != above.moved_in.face.axes) placed = 0;
    axes = above.moved_in.face.axes;
    placed = static_cast<AxisSet>(placed | (above.move->placed & execution::kLinearAxes));
  }
};

/// The lines above a motion, as far as the place of the tip depends on them.
class LinesAbove {
 public:
  explicit LinesAbove(const Snapshot& snapshot) : snapshot_(snapshot) {}

  /// Whether the tip is where the program has it before a line, on all paths.
  bool is_on_program_before(std::size_t line, int jumps_followed = 0) {
    std::vector<ShownByLines> shown(1);
    for (; line > 0; --line) {
      if (std::all_of(shown.begin(), shown.end(), [](const ShownByLines& each) { return each.is_on_program(); }))
        return true;
      if (is_reached_by_jump(line) && !are_jumps_on_program(line, jumps_followed)) return false;
      if (lines_left_-- == 0) return false;
      const std::vector<LineRun> runs = run_line_on_all_paths(snapshot_, line - 1);
      // Then only the jumps lead here that have been looked at.
      if (runs.empty()) return is_never_reached(snapshot_, line - 1);
      std::vector<ShownByLines> after = std::exchange(shown, {});
      for (const LineRun& run : runs) {
        const bool may_shift = changes_length(run, line - 1).value_or(true);
        for (ShownByLines each : after) {
          if (may_shift && each.placed != execution::kLinearAxes) return false;
          each.take(run);
          if (each.is_beside) return false;
          if (!each.is_on_program()) shown.push_back(std::move(each));
        }
      }
      if (shown.size() > kMaxPathsAbove) return false;
    }
    return true;
  }

  /// The lines above a line, latest first, back to one before which the tip is where the program has it; nothing if
  /// there is none, or not only one path.
  std::optional<std::vector<LineRun>> back_from(std::size_t line) {
    std::vector<LineRun> runs;
    ShownByLines shown;
    while (!is_on_program_before(line)) {
      // Only tool changes shift the tip.
      for (bool is_shifted = false; !is_shifted; --line) {
        if (line == 0 || lines_left_-- == 0 || is_reached_by_jump(line)) return std::nullopt;
        std::optional<LineRun> above = run_line(snapshot_, line - 1);
        if (!above || above->before.unknown != 0) return std::nullopt;
        shown.take(*above);
        const std::optional<bool> changes = changes_length(*above, line - 1);
        if (shown.is_beside || !changes) return std::nullopt;
        is_shifted = *changes;
        runs.push_back(std::move(*above));
      }
    }
    return runs;
  }

 private:
  /// The number of lines that are executed at most; nearly always a few show it.
  static constexpr int kMaxLines = 200;
  static constexpr int kMaxJumps = 3;  // One after another.
  static constexpr std::size_t kMaxPathsAbove = 16;

  std::vector<documents::Landmark> jumps_to(std::size_t line) const {
    const syntax::DocumentLine read = snapshot_.document().line(line);
    if (!read->has_label()) return {};
    return snapshot_.index().landmarks(kinds(LandmarkKind::Jump), read->label);
  }
  bool is_reached_by_jump(std::size_t line) const { return !jumps_to(line).empty(); }

  bool are_jumps_on_program(std::size_t line, int jumps_followed) {
    const std::vector<documents::Landmark> jumps = jumps_to(line);
    return jumps_followed < kMaxJumps && std::all_of(jumps.begin(), jumps.end(), [&](const auto& jump) {
             return is_on_program_before(jump.line, jumps_followed + 1);
           });
  }

  /// Whether the line mounts a tool of another length; nothing if that is not known.
  std::optional<bool> changes_length(const LineRun& run, std::size_t line) const {
    const auto before = mounted_tool(snapshot_, line, run.before);
    const auto after = mounted_tool(snapshot_, line + 1, run.after);
    if (!before || !after) return std::nullopt;
    const timing::TimedMachine& machine = snapshot_.configuration().machine.timed;
    const timing::ToolLength one = machine.length_of(*before);
    const timing::ToolLength other = machine.length_of(*after);
    return *before != *after && !(one.is_known && other.is_known && one.mm == other.mm);
  }

  const Snapshot& snapshot_;
  int lines_left_ = kMaxLines;
};

/// Follows the tip along the lines of a path.
class TipFollower {
 public:
  /// Starts before a line, with the tip where the program has it.
  TipFollower(const timing::TimedMachine& machine, const LineRun& first, const ToolCode& tool)
      : machine_(machine),
        tool_(tool),
        tip_(pose_in_machine(first.before), pose_in_machine(first.before), machine.length_of(tool),
             first.before.face.axes) {}

  /// Returns the line's motion, if it has one; nothing where it is not known where the machine begins or ends it.
  std::optional<kinematics::Move> take(const LineRun& run, const ToolCode& tool) {
    if (tool != tool_) tip_.mount(machine_.motion.kinematics, machine_.length_of(tool));
    tool_ = tool;
    if (!run.move) return std::nullopt;
    const bool was_place_known = is_place_known();
    tip_.take(running::FrameEvent{.face = run.moved_in.face});
    const running::MoveEvent move = execution::in_machine(*run.move, run.moved_in);
    kinematics::Move made = timing::planned_move(move, machine_, tip_.tool_length());
    tip_.follow(move, made);
    if (!was_place_known || !is_place_known()) return std::nullopt;
    return made;
  }

 private:
  bool is_place_known() const { return tip_.is_place_known(machine_.motion.kinematics); }

  const timing::TimedMachine& machine_;
  ToolCode tool_;
  timing::TipPosition tip_;
};

}  // namespace

std::optional<kinematics::Move> machine_motion(const Snapshot& snapshot, std::size_t line, const LineRun& run) {
  if (!run.move || run.before.is_compensated() || run.moved_in.is_compensated()) return std::nullopt;
  if (run.before.unknown != 0 || run.after.unknown != 0 || !run.moved_in.is_frame_known()) return std::nullopt;
  const auto tool = mounted_tool(snapshot, line + 1, run.after);
  const auto above = LinesAbove(snapshot).back_from(line);
  if (!tool || !above) return std::nullopt;
  const timing::TimedMachine& machine = snapshot.configuration().machine.timed;
  const LineRun& first = above->empty() ? run : above->back();
  const auto first_tool = mounted_tool(snapshot, line - above->size(), first.before);
  if (!first_tool) return std::nullopt;
  TipFollower follower(machine, first, *first_tool);
  for (std::size_t i = above->size(); i-- > 0;)
    follower.take((*above)[i], *mounted_tool(snapshot, line - i, (*above)[i].after));
  return follower.take(run, *tool);
}

}  // namespace isocnc::queries
