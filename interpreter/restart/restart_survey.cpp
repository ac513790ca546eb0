#include "interpreter/restart/restart_survey.h"

#include <algorithm>

#include "interpreter/geometry/arc.h"
#include "interpreter/timing/spindle_turn.h"

namespace isocnc::restart {

using dialect::GRole;
using execution::State;
using syntax::Instruction;
using syntax::InstructionKind;

static constexpr double kSame = geometry::kEqualCoordinate;

static std::uint32_t register_bit(int number) { return std::uint32_t{1} << static_cast<unsigned>(number); }

static bool same_frame(const running::FrameEvent& a, const running::FrameEvent& b) {
  return a.face_mounted == b.face_mounted && a.workpiece_origin == b.workpiece_origin && a.face == b.face;
}

/// Whether Z of the face frame points down in the machine; takes a State or a FrameEvent.
template <class Frames>
static bool looks_down(const Frames& frames) {
  return frames.face_mounted && frames.face.axes(2, 2) < -kSame;
}

/// Whether the tool points up in the machine; its axis is the normal of a G29 with the same angles (D28).
static bool tool_points_up(const State& state) {
  return geometry::axes_from_angles(state.position.b, state.position.c)(2, 2) < -kSame;
}

static bool differ(const geometry::Vec3& a, const geometry::Vec3& b) { return (a - b).cwiseAbs().maxCoeff() > kSame; }

TipLog::TipLog(const State& start)
    : highest_(start.to_machine(start.position.tip).z()), highest_in_frame_(start.position.tip.z()) {}

geometry::Vec3 TipLog::to_frame(const geometry::Vec3& place) const {
  const geometry::Vec3 in_workpiece = place - frame_.workpiece_origin;
  return frame_.face_mounted ? frame_.face.to_inner(in_workpiece) : in_workpiece;
}

void TipLog::add(const running::Event& event, const kinematics::Move& move) {
  turns_ = turns_ || move.from.b != move.to.b || move.from.c != move.to.c;
  const geometry::Vec3 from = to_frame(move.from.tip);
  const geometry::Vec3 to = to_frame(move.to.tip);
  const bool moved = move.from.tip != move.to.tip;
  const bool fed = moved && std::get<running::MoveEvent>(event.what).kind != execution::MoveKind::Rapid;
  const bool leaves_cut = changed_low_ && moved && !fed;
  if (fed || leaves_cut) fed_.extend(from).extend(to);
  if (leaves_cut) changed_low_ = false;
  if (moved) came_in_feed_ = fed;
  highest_ = std::max(highest_, move.to.tip.z());
  highest_in_frame_ = std::max(highest_in_frame_, to.z());
}

void TipLog::add(const running::FrameEvent& frame, const geometry::Vec3& tip) {
  if (same_frame(frame_, frame)) return;
  changed_low_ = changed_low_ || looks_down(frame_) || to_frame(tip).z() < fed_.max().z() - kSame;
  frame_ = frame;
  highest_in_frame_ = to_frame(tip).z();
  fed_.setEmpty();
}

RestartSurvey::RestartSurvey(std::string_view text, const running::RunOptions& options,
                             const timing::TimedMachine& machine, std::size_t line)
    : line_(line),
      known_radii_(machine.tool_radii),
      machine_(machine),
      course_(machine_, options.setup.home),
      log_(execution::initial_state(options.setup)),
      to_log_{.move = [this](const running::Event& event, const kinematics::Move& move) { log_.add(event, move); },
              .frame = [this](const running::FrameEvent& frame, const geometry::Vec3& tip) { log_.add(frame, tip); }} {
  running::RunOptions watched = options;
  watched.before_block = [this](const running::Block& block) { look_at(block); };
  for (int number = 1; number <= dialect::kRegisterCount; ++number)
    if (options.registers[static_cast<std::size_t>(number)] != 0) now_.known_registers |= register_bit(number);
  run_ = running::run(text, watched, [this](const running::Event& event) { take(event); });
  point_.turns = log_.turns();
  point_.continues_motion = continues_motion(line);
}

void RestartSurvey::take(const running::Event& event) {
  follow(event);
  if (const auto* const speed = std::get_if<running::SpindleSpeedEvent>(&event.what)) last_speed_ = speed->speed;
  spindle_ = timing::spindle_after(event, spindle_, last_speed_);
  now_.turning_speed = spindle_.speed;
  if (const auto* const jump = std::get_if<running::JumpEvent>(&event.what); jump != nullptr && jump->taken)
    jumps_.emplace_back(event.line, jump->target_line);
  const auto* const function = std::get_if<running::FunctionEvent>(&event.what);
  if (function == nullptr || !dialect::is_user_function(function->number)) return;
  const auto is_it = [&](const running::Event& earlier) {
    return std::get<running::FunctionEvent>(earlier.what).number == function->number;
  };
  now_.functions.erase(std::remove_if(now_.functions.begin(), now_.functions.end(), is_it), now_.functions.end());
  now_.functions.push_back(event);
}

/// Moves the machine. A tool of unknown radius gets a small one, so that its offset from the contour shows.
void RestartSurvey::follow(const running::Event& event) {
  constexpr double kShowing = 1e-3;  // mm
  if (const auto* const tool = std::get_if<running::ToolEvent>(&event.what)) {
    has_unknown_radius_ = !known_radii_.contains(tool->tool);
    if (has_unknown_radius_) machine_.tool_radii[tool->tool] = kShowing;
  }
  if (const auto* const move = std::get_if<running::MoveEvent>(&event.what))
    is_beside_by_unknown_ = is_beside_by_unknown_ || (has_unknown_radius_ && move->compensation.side != 0);
  course_.take(event, to_log_);
  is_beside_by_unknown_ = is_beside_by_unknown_ && course_.is_beside_contour();
  is_tip_found_ = false;
}

void RestartSurvey::look_at(const running::Block& block) {
  now_.state = block.state;
  if (!block.state.is_compensated()) find_tip();
  traits_.resize(block.line + 1);
  traits_.back() = traits_of(block);
  if (block.line == line_) {
    now_.registers = block.registers;
    point_ = now_;
  }
  note(block);
}

/// Finds the tip before a line without compensation. A contour that continues if G41 follows is not ended.
void RestartSurvey::find_tip() {
  const auto keep = [&](const simulation::MachineCourse& course, const TipLog& log) {
    now_.machine_tip = course.tip();
    is_tip_known_ = course.is_tip_known();
    now_.highest = log.highest();
    now_.highest_in_frame = log.highest_in_frame();
    now_.fed = log.fed();
    now_.came_in_feed = log.came_in_feed();
    changed_low_ = log.has_changed_low();
    tip_ = log.to_frame(now_.machine_tip.tip);
  };
  if (!std::exchange(is_tip_found_, true)) {
    if (course_.holds_motions()) {
      simulation::MachineCourse course = course_;
      TipLog log = log_;
      course.finish(
          {.move = [&](const running::Event& event, const kinematics::Move& move) { log.add(event, move); },
           .frame = [&](const running::FrameEvent& frame, const geometry::Vec3& tip) { log.add(frame, tip); }});
      keep(course, log);
    } else {
      keep(course_, log_);
    }
  }
  const State& state = now_.state;
  now_.is_beside_contour = course_.is_beside_contour();
  const bool has_moved = state.motion() != nullptr;
  now_.is_off_program =
      has_moved && (now_.is_beside_contour || differ(now_.machine_tip.tip, state.to_machine(state.position.tip)));
  now_.tip = now_.is_off_program ? tip_ : state.position.tip;  // As exact as in the program.
}

/// Records the effects of a block that its state does not hold.
void RestartSurvey::note(const running::Block& block) {
  for (const Instruction& instruction : block.tree.instructions) {
    const syntax::Word& command = block.tree.command(instruction);
    if (instruction.kind == InstructionKind::Assignment && command.register_number() > 0)
      now_.known_registers |= register_bit(command.register_number());
    now_.waits_at_end |= instruction.is(GRole::PendingEnd);
    if (instruction.g() != nullptr && instruction.g()->mounts_face()) now_.face_line = block.tree.text;
  }
  if (block.tree.jump == nullptr) return;
  const int variable = block.tree.jump->variable;
  const bool known = variable > 0 && (now_.known_registers & register_bit(variable)) != 0;
  const bool listed = std::find(now_.assumed.begin(), now_.assumed.end(), variable) != now_.assumed.end();
  if (!known && !listed) now_.assumed.push_back(variable);
}

std::uint16_t RestartSurvey::traits_of(const running::Block& block) const {
  const State& state = block.state;
  unsigned traits = kReached;
  if (state.is_compensated()) traits |= kCompensated;
  if (now_.is_off_program) traits |= kOffProgram;
  if (is_beside_by_unknown_) traits |= kUnknownRadius;
  if (!is_tip_known_) traits |= kUnknownTip;
  if (changed_low_) traits |= kChangedLow;
  if (looks_down(state)) traits |= kLooksDown;
  if (!state.face_mounted && tool_points_up(state)) traits |= kPointsUp;
  if (state.motion() != nullptr && state.motion()->is_arc()) traits |= kInArc;
  if (block.tree.is_empty()) traits |= kIdle;
  if (block.tree.jump != nullptr) traits |= kJumps;
  for (const Instruction& instruction : block.tree.instructions) {
    if (instruction.kind == InstructionKind::Continuation) traits |= kContinues;
    // After M02 nothing is executed.
    if (block.tree.ends_program(instruction)) traits |= kIdle;
    if (instruction.g() != nullptr && instruction.g()->is_motion()) traits |= kNamesMotion;
    if (instruction.is(GRole::ExactStop) && instruction.has(Instruction::kFirst)) traits |= kStopsExactly;
  }
  return static_cast<std::uint16_t>(traits);
}

bool RestartSurvey::has(std::size_t line, std::uint16_t trait) const {
  return line < traits_.size() && (traits_[line] & trait) != 0;
}

RestartObstacle RestartSurvey::obstacle(std::size_t line) const {
  if (run_.ending == running::Ending::Error) return RestartObstacle::ProgramError;
  if (!has(line, kReached))
    return line < traits_.size() ? RestartObstacle::JumpedOver : RestartObstacle::AfterProgramEnd;
  if (has(line, kCompensated)) return RestartObstacle::Compensation;
  if (has(line, kUnknownRadius)) return RestartObstacle::RadiusUnknown;
  if (has(line, kChangedLow)) return RestartObstacle::FrameChangedLow;
  if (has(line, kLooksDown)) return RestartObstacle::FaceLooksDown;
  if (has(line, kPointsUp)) return RestartObstacle::ToolPointsUp;
  if (exact_stop_follows(line)) return RestartObstacle::ExactStop;
  if (has(line, kInArc) && continues_motion(line)) return RestartObstacle::ArcContinues;
  if (has(line, kUnknownTip)) return RestartObstacle::TipUnknown;
  return RestartObstacle::None;
}

bool RestartSurvey::is_safe(std::size_t line) const {
  return line < traits_.size() && !has(line, kIdle) && obstacle(line) == RestartObstacle::None;
}

std::size_t RestartSurvey::line_of_cause(std::size_t line) const {
  for (const auto& [from, to] : jumps_)
    if (from < line && line < to) return from;
  return run_.line;
}

bool RestartSurvey::has_choices() const {
  return std::any_of(traits_.begin(), traits_.end(), [](std::uint16_t traits) { return (traits & kJumps) != 0; });
}

/// Whether the next block is a G09. Blank lines and comments between a feed move and its G09 do not count.
bool RestartSurvey::exact_stop_follows(std::size_t line) const {
  while (has(line, kReached) && has(line, kIdle)) ++line;
  return has(line, kStopsExactly);
}

/// Whether a later line may need the motion G in force. After an IF both paths are possible, so the answer is yes.
bool RestartSurvey::continues_motion(std::size_t line) const {
  for (; line < traits_.size(); ++line) {
    if (has(line, kContinues | kJumps)) return true;
    if (has(line, kNamesMotion)) return false;
  }
  return false;
}

}  // namespace isocnc::restart
