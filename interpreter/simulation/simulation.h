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
#include "interpreter/simulation/timing.h"

namespace isocnc::simulation {

/// What a motion still has before it.
struct DistanceToGo {
  motion::Coordinates axes = motion::Coordinates::Zero();  ///< Of the tip, machine frame: mm, degrees; signed.
  double path = 0;  ///< Along the tip's path, mm; where B and C alone turn, degrees of both together.
};

/// A piece of an arc in G49, which the machine drives as lines (I.3.4.3.a).
struct ArcSegment {
  int number = 0;   ///< From 0.
  int count = 1;    ///< Of the arc.
  double left = 0;  ///< Of its path, mm.
};

/// A program on the simulated machine, which can be stopped at any moment: between two blocks, or inside one at any
/// time or point of its path. A value: a copy goes on by itself, to the last bit as the original. It refers to program,
/// options and machine, which outlive it. `RunOptions::before_block` is not called.
///
/// The control reads ahead of the machine, up to the next IF (I.5). All that is shown here is the machine's present.
/// Motions are those of the tool: under G41 and G42 beside the contour (Compensation), whose warnings nobody hears
/// here.
class Simulation {
 public:
  /// Told when the control is about to read on. A copy is then as small as it can be.
  using BeforeReading = std::function<void(const Simulation&)>;

  Simulation(const running::Program& program, const running::RunOptions& options, const TimedMachine& machine);
  /// The machine of `before`, which is between two blocks and not under G41 or G42, brought to rest where it is, and
  /// another run from there on: what the control has read ahead is forgotten.
  Simulation(const Simulation& before, const running::Runner& run, const TimedMachine& machine);

  /// The program has ended, and the machine stands.
  bool has_ended() const { return present_.has_ended() && !in_block_; }

  /// Goes on to the end of the block in progress, or, between two blocks, of the next one. Blocks that take no time
  /// count, lines that hold nothing do not (D13). An error of the next block ends the program.
  void step_block(const BeforeReading& before_reading = {});
  /// Goes on to the first moment that is so many seconds from the program's begin, or to the end.
  void advance_to(double seconds, const BeforeReading& before_reading = {});
  /// As advance_to(), but to the end of the block in progress, or of the next one, at most.
  void advance_in_block(double seconds, const BeforeReading& before_reading = {});
  /// Goes on until so much more of the path lies behind, mm or degrees as in DistanceToGo; to the end of the path of
  /// the block in progress, or of the next one, at most.
  void advance_along(double way, const BeforeReading& before_reading = {});

  /// Between two blocks begins the next one; within one goes on to the end of what the machine is at (event()).
  void step_instruction(const BeforeReading& before_reading = {});

  /// As step_block(), between two blocks: `on_move` gets each motion of the block before the machine makes it.
  void trace_block(const std::function<void(const motion::Move&)>& on_move);

  /// The block that comes next, before it is executed; none where the program ends.
  std::optional<running::Block> next() { return present_.next(); }
  double time() const { return time_; }  ///< Seconds from the program's begin.
  /// Blocks that have begun. The one in progress counts; what it has brought about shows in run().
  std::uint64_t blocks() const { return run().blocks; }
  bool is_in_block() const { return in_block_; }
  /// Of the block in progress, or, between two blocks, of the next one; from 0. At the end that of the run.
  std::uint64_t line() const;
  /// State and registers, as of the block in progress, and why the program has ended, when it has.
  const running::RunResult& run() const { return present_.result(); }
  /// The run by itself, between the block in progress and the next one.
  const running::Runner& runner() const { return present_; }
  double vgpl() const { return present_.vgpl(); }

  /// The motion, dwell or other thing that the machine is at; null between two blocks, and where nothing takes time.
  /// Valid until the simulation is used again.
  const running::Event* event() const;
  /// The motion of the block in progress that the machine makes, or makes next, as it makes it: beside the contour
  /// under G41 and G42, and off the program after a change to a tool of another length. Null for none. Valid until the
  /// simulation is used again.
  const motion::Move* motion() const;
  motion::Sample sample() const;
  double tool_length() const { return tool_length_; }  ///< Of the tool that is mounted, mm.
  /// What the spindle does after the block in progress. An S that no M03 or M04 has followed does not show.
  const Timing::Spindle& spindle() const { return spindle_; }
  DistanceToGo to_go() const;
  /// Where the machine is on an arc that it drives as lines; none elsewhere.
  std::optional<ArcSegment> segment() const;

  /// What the IFs that follow see. `reg` from 1 to 30.
  void set_register(int reg, double value) { present_.set_register(reg, value); }
  void set_vgpl(double value) { present_.set_vgpl(value); }

  /// How much there was to do to get here: blocks, and stretches of motion.
  std::uint64_t work() const { return blocks() + stretches_; }
  /// Lets go of memory that the rest does not need.
  void forget_past();
  /// Bytes that it holds, about.
  std::size_t memory() const;

 private:
  Simulation(const Simulation& before, const running::Runner& run, const TimedMachine& machine,
             const running::MoveEvent* beside);

  /// A stretch of a motion, or what the machine stands still for.
  struct Piece {
    double start = 0;
    double end = 0;
    std::shared_ptr<const TimedEvent> cause;  ///< Its duration is not known yet.
    std::optional<motion::Stretch> stretch;
  };

  const Piece* piece() const { return passed_ < pieces_.size() ? &pieces_[passed_] : nullptr; }
  /// The stretch that the machine is on; null where it stands.
  const motion::Stretch* stretch() const;
  bool is_of_block(const Piece* piece) const { return piece != nullptr && piece->cause->event.line <= line_; }
  void start_block();
  void continue_block(double seconds, const BeforeReading& before_reading);
  void pass_piece();
  bool read_ahead(const BeforeReading& before_reading);
  bool may_read_ahead();
  void plan(std::span<const running::Event> events);
  void come_to_rest();
  Timing::Listeners listeners();
  Compensation::Listeners compensated();

  const TimedMachine* machine_;
  running::Runner present_;  ///< Where the machine is: all blocks that have begun.
  running::Runner ahead_;    ///< Where the control is in its reading.
  Compensation compensation_;
  Timing timing_;
  std::vector<Piece> pieces_;  ///< Those read whose times are known.
  std::size_t passed_ = 0;     ///< Of them.
  std::optional<motion::Stretch> last_stretch_;
  std::shared_ptr<const TimedEvent> last_motion_;  ///< That the machine has begun, also before its begin; or null.
  geometry::Pose begin_;  ///< Where the machine stood at the begin, with a tool of that length.
  double start_tool_length_ = 0;
  double travelled_ = 0;    ///< Of the path of its motion.
  double tool_length_ = 0;  ///< Of the tool that is mounted.
  Timing::Spindle spindle_;
  double time_ = 0;
  bool in_block_ = false;
  std::uint64_t line_ = 0;       ///< Of the block in progress.
  std::uint64_t stretches_ = 0;  ///< Made.
};

}  // namespace isocnc::simulation
