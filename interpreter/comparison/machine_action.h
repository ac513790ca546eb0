#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "interpreter/geometry/range.h"
#include "interpreter/kinematics/kinematics.h"
#include "interpreter/kinematics/made_move.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/timing/timing.h"

namespace isocnc::comparison {

enum class ActionKind : std::uint8_t { Motion, ExactStop, Dwell, Spindle, Function, Signal, Tool, End };

/// One thing that the machine does, as far as it counts for behavior. Comments, formatting, modal words without an
/// effect, and motions that go nowhere are none.
struct MachineAction {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  ActionKind kind = ActionKind::Motion;
  bool is_rapid = false;
  bool is_inverse_time = false;  ///< The feed is written under G93.
  /// A rapid whose joints lead the tip off a straight line: they turn B or C, or move independently (I.3.4.1).
  bool is_by_joints = false;
  /// Motion: the side of compensation, 41, 42 or 0 for none. Only where the control leads the tool beside the path:
  /// `has_side` is false for motions along the normal of the arc plane, and for those that turn B or C.
  std::uint8_t side = 0;
  bool has_side = false;
  bool is_compensated = false;  ///< The radius of the tool is known: `from` and `to` are beside the programmed path.
  bool reduces = false;         ///< Motion with a side: under G39, too.
  std::uint32_t line = 0;       ///< From 0.
  std::uint32_t tool = kNone;   ///< Index of the mounted tool in RecordedRun::tools; for Tool, of the new one.
  std::uint32_t arc = kNone;    ///< Index in RecordedRun::arcs.
  std::uint32_t frame = 0;      ///< Index in RecordedRun::frames of the frame in force.
  std::uint32_t spindle = 0;    ///< Index in RecordedRun::spindles of how the spindle turns.
  /// Function: index in RecordedRun::functions. Spindle: 3, 4 or 5; 0 for an S that
  /// waits for the next M03 or M04. Signal: its G. End: Ending, and the error's id.
  std::uint32_t number = 0;
  double value = 0;     ///< Motion: F as programmed. Dwell: seconds. Spindle: revolutions per minute.
  double start = 0;     ///< Seconds since the start of the run; End: the cycle time.
  double feed = 0;      ///< Motion: feed as a speed, mm/min or degrees/min; 0 for rapids.
  geometry::Pose from;  ///< Motion: tip in the machine frame.
  geometry::Pose to;

  bool is_motion() const { return kind == ActionKind::Motion; }
  bool is_line() const { return is_motion() && arc == kNone && !is_by_joints; }
};

/// The circle of an arc; machine frame.
struct ActionArc {
  geometry::Vec3 center = geometry::Vec3::Zero();
  geometry::Vec3 normal = geometry::Vec3::UnitZ();
  double sweep_deg = 0;
};

struct ActionTool {
  execution::ToolCode code;
  double length = 0;   ///< mm.
  double seconds = 0;  ///< That it is mounted, with its tool changes; over all of its uses.
};

/// How the spindle turns for a while.
struct ActionSpindle {
  timing::SpindleMotion motion;
  std::optional<std::size_t> cause;  ///< Index of the action that has made it turn so; none for that of the start.
};

struct ActionFrame {
  std::size_t line = 0;                          ///< Of the G that brought it into force, from 0.
  geometry::Frame frame;                         ///< In the machine frame.
  geometry::Vec3 zero = geometry::Vec3::Zero();  ///< The workpiece's, machine frame, mm; the frame may be a face in it.
  std::optional<std::size_t> zero_line;          ///< Of the G that has set it; none for that of the start.
};

/// An IF that a run has met.
struct ActionDecision {
  std::size_t line = 0;  ///< From 0.
  bool is_taken = false;
  std::size_t action = 0;  ///< Index of the next action.
};

/// What the machine does in a run of a program.
struct RecordedRun {
  std::vector<MachineAction> actions;  ///< The last one is End.
  std::vector<ActionArc> arcs;
  std::vector<ActionTool> tools;
  std::vector<ActionFrame> frames;      ///< The first one is the machine frame.
  std::vector<ActionSpindle> spindles;  ///< The first one is that of the start.
  std::vector<running::FunctionEvent> functions;
  std::vector<ActionDecision> decisions;
  kinematics::Machine machine;
  double seconds = 0;               ///< Cycle time.
  double seconds_without_tool = 0;  ///< The part of it before the first tool change.
  double feed_mm = 0;               ///< Length of the tip's path in feed moves.
  double rapid_mm = 0;              ///< And in rapids.
  bool has_motion = false;
  std::array<geometry::Range, 3> extents;  ///< Of the tip, machine frame; without meaning where there is no motion.
};

/// The code of the error that ended a run, such as ISO031; empty for a run to its M02.
std::string_view error_of(const RecordedRun& run);

/// What others want to hear of a run that is recorded. Each is optional.
struct RecordingListeners {
  std::function<void(const running::Block&)> block;       ///< Each block, before it is executed.
  std::function<void(const running::Event&)> programmed;  ///< Events as programmed.
  std::function<void(const simulation::RunWarning&)> warning;
  /// Events as the machine makes them; a motion is asked once for all.
  std::function<void(const timing::TimedEvent&, kinematics::MadeMove*)> made;
  std::function<void(const motion::Stretch&, const timing::TimedEvent&)> stretch;
  std::function<void(const running::RunResult&)> ended;
};

/// Runs a program on the machine, with compensation and times. `options.before_block` is replaced.
RecordedRun record(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine,
                   const RecordingListeners& listeners = {});

}  // namespace isocnc::comparison
