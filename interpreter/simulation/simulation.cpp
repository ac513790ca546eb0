#include "interpreter/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpreter/timing/spindle_turn.h"

namespace isocnc::simulation {

static constexpr double kForever = std::numeric_limits<double>::infinity();

Simulation::Simulation(const running::Program& program, const running::RunOptions& options,
                       const timing::TimedMachine& machine)
    : machine_(&machine),
      present_(program, options),
      ahead_(present_),
      compensation_(machine),
      timing_(machine, timing::TimingListeners{}),
      begin_(machine.home) {
  present_.pass_empty_lines();
  ahead_ = present_;
}

/// The tip of the machine at rest. A tip within the corner tolerance was rounding a corner and takes the programmed
/// position; a tip farther off, after a change of tool length, stays where it is.
static geometry::Pose at_rest(const geometry::Pose& tip, const geometry::Pose& programmed,
                              const kinematics::Machine& machine) {
  constexpr double kRounding = 1 + 1e-6;
  const bool rounds = (tip.tip - programmed.tip).norm() <= machine.corner_tolerance * kRounding;
  return {rounds ? programmed.tip : tip.tip, programmed.b, programmed.c};
}

static geometry::Pose programmed_pose(const execution::State& state) {
  return {state.to_machine(state.position.tip), state.position.b, state.position.c};
}

/// The last motion if it has ended at an offset contour, away from the programmed position; otherwise null.
static const running::MoveEvent* motion_beside(const timing::TimedEvent* last, const execution::State& state) {
  if (last == nullptr) return nullptr;
  const auto& move = std::get<running::MoveEvent>(last->event.what);
  const bool is_beside = (move.to.tip - programmed_pose(state).tip).norm() > geometry::kEqualCoordinate;
  return is_beside && move.normal != geometry::Vec3::Zero() ? &move : nullptr;
}

static timing::Standing standing(const Simulation& before, const running::Runner& run,
                                 const timing::TimedMachine& machine, const running::MoveEvent* beside) {
  const execution::State& state = run.result().state;
  const geometry::Pose programmed = beside != nullptr ? beside->to : programmed_pose(state);
  return {.time = before.time(),
          .tip = at_rest(before.sample().tip, programmed, machine.motion),
          .programmed = programmed,
          .tool = before.machine().length_of(before.tool()),
          .unknown = before.unknown_offset(),
          .frame_axes = state.face_mounted ? state.face.axes : geometry::Mat3(geometry::Mat3::Identity()),
          .spindle = before.spindle(),
          .spindle_speed = state.spindle_speed};
}

Simulation::Simulation(const Simulation& before, const running::Runner& run, const timing::TimedMachine& machine)
    : Simulation(before, run, machine, motion_beside(before.last_motion_.get(), run.result().state)) {}

Simulation::Simulation(const Simulation& before, const running::Runner& run, const timing::TimedMachine& machine,
                       const running::MoveEvent* beside)
    : machine_(&machine),
      present_(run),
      ahead_(present_),
      compensation_(machine, run.result().state.tool, beside),
      timing_(machine, standing(before, run, machine, beside)),
      earlier_stretch_(before.last_stretch_ ? std::make_shared<const motion::Stretch>(*before.last_stretch_)
                                            : before.earlier_stretch_),
      is_place_known_(before.is_place_known()),
      unknown_offset_(before.unknown_offset_),
      has_moved_tool_(before.has_moved_tool_),
      was_place_known_(before.was_place_known_),
      last_motion_(before.last_motion_),
      begin_(timing_.tip()),
      start_tool_length_(before.tool_length_),
      tool_(before.tool_),
      tool_length_(before.tool_length_),
      spindle_(before.spindle_),
      time_(before.time_) {
  present_.pass_empty_lines();
  ahead_ = present_;
}

void Simulation::step_block(const BeforeReading& before_reading) { advance_in_block(kForever, before_reading); }

void Simulation::advance_in_block(double seconds, const BeforeReading& before_reading) {
  if (has_ended() || !(seconds > time_)) return;
  if (!in_block_) start_block();
  continue_block(seconds, before_reading);
}

void Simulation::advance_along(double way, const BeforeReading& before_reading) {
  if (has_ended() || !(way > 0)) return;
  if (!in_block_) start_block();
  while (in_block_ && read_ahead(before_reading) && is_of_block(piece())) {
    const double end = piece()->end;
    if (const auto& stretch = piece()->stretch) {
      const double from = stretch->parameter_at(time_);
      const double left = stretch->parameter_at(end) - from;
      if (way < left) return continue_block(stretch->time_at(from + way), before_reading);
      way -= left;
    }
    continue_block(end, before_reading);
  }
  continue_block(time_, before_reading);  // Ends the block, unless the machine still has to wait.
}

void Simulation::step_instruction(const BeforeReading& before_reading) {
  if (has_ended()) return;
  if (!in_block_) {
    start_block();
    return continue_block(time_, before_reading);
  }
  if (!read_ahead(before_reading) || !is_of_block(piece())) return continue_block(kForever, before_reading);
  const auto cause = piece()->cause;
  while (in_block_ && read_ahead(before_reading) && is_of_block(piece()) && piece()->cause == cause)
    continue_block(piece()->end, before_reading);
}

void Simulation::trace_block(const std::function<void(const kinematics::Move&)>& on_move) {
  for (step_instruction(); in_block_; step_instruction())
    if (const kinematics::Move* const move = motion()) on_move(*move);
}

void Simulation::trace_stretches(
    const std::function<void(const timing::TimedEvent& event, const motion::Stretch* stretch)>& on_piece) {
  if (has_ended()) return;
  if (!in_block_) start_block();
  while (in_block_ && read_ahead({}) && is_of_block(piece())) {
    const TimelinePiece& next = *piece();
    on_piece(*next.cause, next.stretch ? &*next.stretch : nullptr);
    time_ = std::max(time_, next.end);
    pass_piece();
  }
  continue_block(kForever, {});
}

/// Starts the next block and applies its effects that take no time. The control has read it already, unless the machine
/// had to arrive there first.
void Simulation::start_block() {
  const bool is_news = !ahead_.has_ended() && ahead_.place() == present_.place();
  const std::uint64_t blocks_before = blocks();
  line_ = present_.place().line;
  present_.step();
  for (const running::Event& event : present_.events())
    spindle_ = timing::spindle_after(event, spindle_, run().state.spindle_speed);
  in_block_ = blocks() > blocks_before;
  if (is_news) {
    timing_.listen(listeners());
    plan(present_.events());
    timing_.listen({});
  }
  present_.pass_empty_lines();
  if (is_news) ahead_ = present_;
}

/// Advances to the end of the block in progress, or to `seconds`. The block ends where the next event starts.
void Simulation::continue_block(double seconds, const BeforeReading& before_reading) {
  while (in_block_) {
    const bool is_known = read_ahead(before_reading);
    const bool is_over = !is_known || !is_of_block(piece());
    const double end = !is_over ? piece()->end : is_known ? piece()->start : timing_.time();
    if (end > seconds) {
      time_ = std::max(time_, seconds);
      return;
    }
    time_ = std::max(time_, end);
    if (is_over) {
      in_block_ = false;
    } else {
      pass_piece();
    }
  }
}

void Simulation::pass_piece() {
  const running::Event& event = pieces_[passed_].cause->event;
  if (const auto* const change = std::get_if<running::ToolEvent>(&event.what)) {
    tool_ = change->tool;
    tool_length_ = machine_->tool_length(tool_);
    pass_place();
    has_moved_tool_ = false;
  }
  if (const auto& stretch = pieces_[passed_].stretch) {
    if (!last_stretch_ || last_stretch_->tag != stretch->tag) travelled_ = 0;
    // After the last stretch of a move, the traveled length is not needed any more.
    if (!stretch->ends_move)
      travelled_ += stretch->parameter_at(stretch->start + stretch->duration) - stretch->parameter_at(stretch->start);
    last_stretch_ = stretch;
    has_moved_tool_ = true;
    was_place_known_ = pieces_[passed_].cause->is_at_known_place();
    if (stretch->ends_move) pass_place();
    last_motion_ = pieces_[passed_].cause;
  }
  ++passed_;
}

/// Takes over what is known of the place after the piece.
void Simulation::pass_place() {
  is_place_known_ = pieces_[passed_].cause->ends_at_known_place;
  unknown_offset_ = pieces_[passed_].cause->unknown_offset;
}

/// Reads until the next piece is known. Returns false if the machine comes to rest before another block is read, or at
/// the end.
bool Simulation::read_ahead(const BeforeReading& before_reading) {
  if (piece() != nullptr) return true;
  pieces_.clear();
  passed_ = 0;
  if (before_reading) before_reading(*this);
  timing_.listen(listeners());
  while (pieces_.empty() && may_read_ahead()) {
    ahead_.step();
    plan(ahead_.events());
    ahead_.pass_empty_lines();
  }
  if (pieces_.empty()) come_to_rest();
  timing_.listen({});  // A copy must not call this object.
  return !pieces_.empty();
}

/// False at an IF: the control reads it when the machine has arrived there (I.5).
bool Simulation::may_read_ahead() {
  if (ahead_.has_ended()) return false;
  const auto block = ahead_.next();
  return !block || block->tree.jump == nullptr || !block->tree.jump->has_target;
}

/// Passes events that the control has read to the planner, as motions of the tool and with their times.
void Simulation::plan(std::span<const running::Event> events) {
  const Compensation::Listeners to_timing = compensated();
  for (const running::Event& event : events) compensation_.take(event, to_timing);
}

void Simulation::come_to_rest() {
  compensation_.pause(compensated());
  timing_.finish();
}

Compensation::Listeners Simulation::compensated() {
  return {.event = [this](const running::Event& event) { timing_.take(event); }, .warning = [](const RunWarning&) {}};
}

/// Adds a piece for each event that takes time, and for each tool change.
timing::TimingListeners Simulation::listeners() {
  return {.event =
              [this](const timing::TimedEvent& timed) {
                if (std::holds_alternative<running::MoveEvent>(timed.event.what)) return;
                if (!(timed.duration > 0) && !std::holds_alternative<running::ToolEvent>(timed.event.what)) return;
                pieces_.push_back({.start = timed.start,
                                   .end = timed.start + timed.duration,
                                   .cause = std::make_shared<const timing::TimedEvent>(timed)});
              },
          .stretch =
              [this](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
                ++stretches_;
                const bool continues = !pieces_.empty() && pieces_.back().stretch.has_value() &&
                                       pieces_.back().stretch->tag == stretch.tag;
                pieces_.push_back(
                    {.start = stretch.start,
                     .end = stretch.start + stretch.duration,
                     .cause = continues ? pieces_.back().cause : std::make_shared<const timing::TimedEvent>(timed),
                     .stretch = stretch});
              }};
}

std::size_t Simulation::line() const {
  if (in_block_) return line_;
  return present_.has_ended() ? run().line : present_.place().line;
}

const running::Event* Simulation::event() const {
  const bool is_at_it = in_block_ && is_of_block(piece()) && piece()->start <= time_;
  return is_at_it ? &piece()->cause->event : nullptr;
}

const kinematics::Move* Simulation::motion() const {
  const bool is_at_it = in_block_ && is_of_block(piece()) && piece()->cause->move;
  return is_at_it ? &*piece()->cause->move : nullptr;
}

const motion::Stretch* Simulation::stretch() const {
  const bool moves = piece() != nullptr && piece()->stretch.has_value() && piece()->start <= time_;
  return moves ? &*piece()->stretch : nullptr;
}

bool Simulation::is_place_known() const {
  return is_place_known_ && (stretch() == nullptr || piece()->cause->is_at_known_place());
}

const motion::Stretch* Simulation::stretch_before() const {
  if (!has_moved_tool_) return nullptr;
  return last_stretch_ ? &*last_stretch_ : earlier_stretch_.get();
}

motion::Sample Simulation::sample() const {
  const kinematics::Kinematics& kinematics = machine_->motion.kinematics;
  if (const motion::Stretch* const moving = stretch()) return moving->at(kinematics, time_);
  motion::Sample standing{.time = time_, .tip = begin_};
  double length = start_tool_length_;  // Length of the tool used on the way here, mm.
  if (last_stretch_) {
    const motion::Sample last = last_stretch_->at(kinematics, kForever);
    standing.tip = last.tip;
    standing.joints = last.joints;
    length = last_stretch_->path.tool_length;
  } else {
    standing.joints = kinematics::inverse(kinematics, kinematics::coordinates(standing.tip), length);
  }
  if (length != tool_length_)
    standing.tip = kinematics::pose(kinematics::forward(kinematics, standing.joints, tool_length_));
  return standing;
}

/// The length of a move as the planner measures it.
static double path_of(const kinematics::Machine& machine, const kinematics::Move& move) {
  return (move.is_arc ? programmed_circle(move) : programmed_line(machine, move, move.from, move.to)).length;
}

DistanceToGo Simulation::to_go() const {
  const motion::Stretch* const moving = stretch();
  if (moving == nullptr || event() == nullptr) return {};
  const kinematics::Move& move = *piece()->cause->move;
  const double here = moving->parameter_at(time_);
  const double passed = last_stretch_ && last_stretch_->tag == moving->tag ? travelled_ : 0;
  const double left = path_of(machine_->motion, move) - passed - (here - moving->parameter_at(moving->start));
  return {.axes = kinematics::coordinates(move.to) - kinematics::coordinates(sample().tip),
          .path = moving->ends_move ? moving->parameter_at(kForever) - here : std::max(0.0, left)};
}

std::optional<ArcSegment> Simulation::segment() const {
  const motion::Stretch* const moving = stretch();
  if (moving == nullptr || event() == nullptr) return std::nullopt;
  const kinematics::Move& move = *piece()->cause->move;
  const int count = kinematics::segment_count(machine_->motion, move);
  if (count < 2) return std::nullopt;
  // Rounded corners shorten the path slightly, so a point this near to an end counts as the end.
  constexpr double kNear = 1e-3;
  const double length = path_of(machine_->motion, move) / count;
  const double passed = path_of(machine_->motion, move) - to_go().path;
  const int number = std::clamp(static_cast<int>(std::floor(passed / length + kNear)), 0, count - 1);
  return ArcSegment{.number = number, .count = count, .left = (number + 1) * length - passed};
}

void Simulation::forget_past() {
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(passed_));
  passed_ = 0;
  timing_.release_reported();
}

std::size_t Simulation::memory() const {
  return sizeof(*this) + compensation_.memory() + timing_.memory() +
         pieces_.size() * (sizeof(TimelinePiece) + sizeof(timing::TimedEvent));
}

}  // namespace isocnc::simulation
