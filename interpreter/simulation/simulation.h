#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/motion/stretch.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/timing/timing.h"

namespace isocnc::simulation {

/// The rest of a motion.
struct DistanceToGo {
  /// Rest of the tip's motion by axis, machine frame: mm, degrees; signed.
  kinematics::Coordinates axes = kinematics::Coordinates::Zero();
  double path = 0;  ///< Length left on the tip's path, mm; where only B and C turn, degrees of both together.
};

/// A segment of an arc in G49, which the machine drives as lines (I.3.4.3.a).
struct ArcSegment {
  int number = 0;   ///< From 0.
  int count = 1;    ///< Number of segments of the arc.
  double left = 0;  ///< Length left on the segment's path, mm.
};

/// A program on the simulated machine, which can be stopped at any moment: between two blocks, or inside one at any
/// time or point of its path. A value: a copy runs independently and produces bit-identical results. The program,
/// options and machine must outlive it. `RunOptions::before_block` is not called.
///
/// The control reads ahead of the machine, up to the next IF (I.5). All accessors show the machine's present. Motions
/// are those of the tool: under G41 and G42 offset from the contour (Compensation). Warnings of the compensation are
/// discarded.
class Simulation {
 public:
  /// Called just before the control reads further blocks. At this moment copies of the simulation are smallest.
  using BeforeReading = std::function<void(const Simulation&)>;

  Simulation(const running::Program& program, const running::RunOptions& options, const timing::TimedMachine& machine);
  /// Continues with another run on the machine of `before`, which is between two blocks and not under G41 or G42. The
  /// machine comes to rest where it is, and blocks read ahead are discarded.
  Simulation(const Simulation& before, const running::Runner& run, const timing::TimedMachine& machine);

  /// Whether the program has ended and the machine stands.
  bool has_ended() const { return present_.has_ended() && !in_block_; }

  /// Advances to the end of the block in progress or, between two blocks, of the next one. Blocks that take no time
  /// count, empty lines do not (D13). An error of the next block ends the program.
  void step_block(const BeforeReading& before_reading = {});
  /// Advances to `seconds` after the program start; at most to the end of the block in progress or, between two blocks,
  /// of the next one.
  void advance_in_block(double seconds, const BeforeReading& before_reading = {});
  /// Advances by a length of path, in mm or degrees as in DistanceToGo; at most to the end of the path of the block in
  /// progress or, between two blocks, of the next one.
  void advance_along(double way, const BeforeReading& before_reading = {});

  /// Starts the next block if between two blocks; otherwise advances to the end of the current activity (event()).
  void step_instruction(const BeforeReading& before_reading = {});

  /// Like step_block(), to be called between two blocks. Calls `on_move` with each motion of the block before the
  /// machine makes it.
  void trace_block(const std::function<void(const kinematics::Move&)>& on_move);
  /// Ends the block in progress or, between two blocks, the next one, like step_block(). Calls `on_piece` with each
  /// stretch of motion that the machine has not completed yet, and with null for each event that takes time without one
  /// and for each tool change. The duration of a motion's event is not known.
  void trace_stretches(
      const std::function<void(const timing::TimedEvent& event, const motion::Stretch* stretch)>& on_piece);

  /// The block that comes next, before it is executed; none where the program ends.
  std::optional<running::Block> next() { return present_.next(); }
  double time() const { return time_; }  ///< Seconds since the program start.
  /// Number of blocks started. The one in progress counts; run() shows its effects already.
  std::uint64_t blocks() const { return run().blocks; }
  bool is_in_block() const { return in_block_; }
  /// Line of the block in progress or, between two blocks, of the next one; from 0. At the end the last line of the
  /// run.
  std::size_t line() const;
  /// State and registers after the block in progress, and the reason of the end if the program has ended.
  const running::RunResult& run() const { return present_.result(); }
  /// The run without the machine, between the block in progress and the next one.
  const running::Runner& runner() const { return present_; }
  double vgpl() const { return present_.vgpl(); }

  /// The motion, dwell or other event in progress; null between two blocks and during blocks that take no time. Valid
  /// until the next non-const call. Public for tests, which compare it after steps back and forth.
  const running::Event* event() const;
  /// The current or next motion of the block in progress as the machine makes it: offset from the contour under G41 and
  /// G42, and off the program after a change to a tool of another length. Null without a motion. Valid until the next
  /// non-const call.
  const kinematics::Move* motion() const;
  motion::Sample sample() const;
  /// Whether it is known where the machine is: not after a tool whose length is not known (timing::TipPosition).
  bool is_place_known() const;
  /// Of the tip, at the present or, within a motion, before it.
  timing::UnknownOffset unknown_offset() const { return unknown_offset_ ? *unknown_offset_ : timing::UnknownOffset(); }
  /// The last stretch that has been completed with the mounted tool; null if it has not been moved yet.
  const motion::Stretch* stretch_before() const;
  /// Whether it was known where the machine was all along that stretch.
  bool was_place_known() const { return was_place_known_; }
  const timing::TimedMachine& machine() const { return *machine_; }
  /// The mounted tool: within an M06 the one before.
  const execution::ToolCode& tool() const { return tool_; }
  /// The spindle after the block in progress. An S counts only after the next M03 or M04.
  const timing::SpindleMotion& spindle() const { return spindle_; }
  DistanceToGo to_go() const;
  /// The segment of the current arc if the machine drives it as lines; otherwise none.
  std::optional<ArcSegment> segment() const;

  /// Sets the value that the following IFs see. `reg` from 1 to 30.
  void set_register(int reg, double value) { present_.set_register(reg, value); }
  void set_vgpl(double value) { present_.set_vgpl(value); }

  /// Work done to get here: number of blocks and of stretches of motion.
  std::uint64_t work() const { return blocks() + stretches_; }
  /// Frees memory that the rest of the run does not need.
  void forget_past();
  /// Approximate memory in bytes.
  std::size_t memory() const;

 private:
  Simulation(const Simulation& before, const running::Runner& run, const timing::TimedMachine& machine,
             const running::MoveEvent* beside);

  /// A stretch of a motion, or an event for which the machine stands still.
  struct TimelinePiece {
    double start = 0;
    double end = 0;
    std::shared_ptr<const timing::TimedEvent> cause;  ///< Its duration is not known yet.
    std::optional<motion::Stretch> stretch;
  };

  const TimelinePiece* piece() const { return passed_ < pieces_.size() ? &pieces_[passed_] : nullptr; }
  /// The current stretch; null while the machine stands.
  const motion::Stretch* stretch() const;
  bool is_of_block(const TimelinePiece* piece) const { return piece != nullptr && piece->cause->event.line <= line_; }
  void start_block();
  void continue_block(double seconds, const BeforeReading& before_reading);
  void pass_piece();
  void pass_place();
  bool read_ahead(const BeforeReading& before_reading);
  bool may_read_ahead();
  void plan(std::span<const running::Event> events);
  void come_to_rest();
  timing::TimingListeners listeners();
  Compensation::Listeners compensated();

  const timing::TimedMachine* machine_;
  running::Runner present_;  ///< The run up to the machine: all blocks started.
  running::Runner ahead_;    ///< The run up to the last block the control has read.
  Compensation compensation_;
  timing::Timing timing_;
  std::vector<TimelinePiece> pieces_;  ///< Pieces with known times.
  std::size_t passed_ = 0;             ///< Number of pieces that the machine has completed.
  std::optional<motion::Stretch> last_stretch_;
  /// Of the run from before the constructor; or null.
  std::shared_ptr<const motion::Stretch> earlier_stretch_;
  bool is_place_known_ = true;                                   ///< Where the machine was before the current piece.
  std::shared_ptr<const timing::UnknownOffset> unknown_offset_;  ///< Of the tip, there; null where it is 0.
  bool has_moved_tool_ = false;  ///< Whether a stretch has been completed since the last tool change.
  bool was_place_known_ = true;  ///< On the last stretch.
  /// Last motion with a completed stretch, possibly from before the constructor; or null.
  std::shared_ptr<const timing::TimedEvent> last_motion_;
  geometry::Pose begin_;  ///< Tip at the start, with a tool of start_tool_length_.
  double start_tool_length_ = 0;
  double travelled_ = 0;      ///< Length of the completed stretches of the current motion.
  execution::ToolCode tool_;  ///< The mounted tool.
  double tool_length_ = 0;    ///< Its length, mm.
  timing::SpindleMotion spindle_;
  double time_ = 0;
  bool in_block_ = false;
  std::size_t line_ = 0;         ///< Line of the block in progress.
  std::uint64_t stretches_ = 0;  ///< Number of stretches planned.
};

}  // namespace isocnc::simulation
