#include "interpreter/running/restart_survey.h"

#include <algorithm>

#include "interpreter/geometry/arc.h"

namespace isocnc::running {

using dialect::ModalGroup;
using execution::State;
using syntax::Instruction;
using syntax::InstructionKind;

static constexpr double kSame = geometry::kEqualCoordinate;

static std::uint32_t register_bit(int number) { return std::uint32_t{1} << static_cast<unsigned>(number); }

static bool same_frame(const State& a, const State& b) {
  return a.face_mounted == b.face_mounted && a.workpiece_origin == b.workpiece_origin && a.face == b.face;
}

static bool compensates(const State& state) { return state.mode(ModalGroup::CutterCompensation) != 40; }

/// Z of the face frame runs downward in the machine.
static bool looks_down(const State& state) { return state.face_mounted && state.face.axes(2, 2) < -kSame; }

/// In the machine, as the normal of a G29 with the same angles (D28).
static bool tool_points_up(const State& state) {
  return geometry::axes_from_angles(state.position.b, state.position.c)(2, 2) < -kSame;
}

/// The coordinate that the arc plane in force leaves out.
static int normal_of_plane(const State& state) {
  const std::uint8_t plane = state.mode(ModalGroup::Plane);
  return plane == 17 ? 2 : plane == 18 ? 1 : 0;
}

static bool moved_in_plane(const State& before, const State& after) {
  geometry::Vec3 way = after.position.tip - before.position.tip;
  way[normal_of_plane(after)] = 0;
  return same_frame(before, after) && way.cwiseAbs().maxCoeff() > kSame;
}

RestartSurvey::RestartSurvey(std::string_view text, const RunOptions& options, std::uint64_t line) : line_(line) {
  RunOptions watched = options;
  watched.before_block = [this](const Block& block) { look_at(block); };
  now_.state = execution::initial_state(options.setup);
  now_.highest = now_.highest_in_frame = now_.state.position.tip.z();
  for (int number = 1; number <= dialect::kRegisterCount; ++number)
    if (options.registers[static_cast<std::size_t>(number)] != 0) now_.known_registers |= register_bit(number);
  run_ = running::run(text, watched, [this](const Event& event) {
    if (const auto* const jump = std::get_if<JumpEvent>(&event.what); jump != nullptr && jump->taken)
      jumps_.emplace_back(event.line, jump->target_line);
    const auto* const function = std::get_if<FunctionEvent>(&event.what);
    if (function == nullptr || !dialect::is_user_function(function->number)) return;
    const auto is_it = [&](const Event& earlier) {
      return std::get<FunctionEvent>(earlier.what).number == function->number;
    };
    now_.functions.erase(std::remove_if(now_.functions.begin(), now_.functions.end(), is_it), now_.functions.end());
    now_.functions.push_back(event);
  });
  point_.turns = now_.turns;
  point_.continues_motion = continues_motion(line);
}

void RestartSurvey::look_at(const Block& block) {
  follow(now_.state, block.state);
  now_.state = block.state;
  traits_.resize(block.line + 1);
  traits_.back() = traits_of(block);
  if (block.line == line_) {
    now_.registers = block.registers;
    point_ = now_;
  }
  note(block);
}

/// Follows heights, frames and compensation from one block to the next.
void RestartSurvey::follow(const State& before, const State& after) {
  const double z = after.position.tip.z();
  now_.turns = now_.turns || after.position.b != before.position.b || after.position.c != before.position.c;
  now_.highest = std::max(now_.highest, after.to_machine(after.position.tip).z());
  if (!same_frame(before, after)) {
    changed_low_ = changed_low_ || looks_down(before) || before.position.tip.z() < now_.fed.max().z() - kSame;
    now_.highest_in_frame = z;
    now_.fed.setEmpty();
  } else {
    const bool moved = after.position.tip != before.position.tip;
    const bool fed = after.exact_stop_fits && moved;  // A G09 fits behind feed moves alone.
    const bool leaves_cut = changed_low_ && moved && !fed;
    if (fed || leaves_cut) now_.fed.extend(before.position.tip).extend(after.position.tip);
    if (leaves_cut) changed_low_ = false;
    now_.highest_in_frame = std::max(now_.highest_in_frame, z);
  }
  if (compensates(after)) {
    compensated_ = true;
  } else if (!compensates(before) && moved_in_plane(before, after)) {
    compensated_ = false;
  }
}

/// Remembers what a block will have done that its state does not hold.
void RestartSurvey::note(const Block& block) {
  for (const Instruction& instruction : block.tree.instructions) {
    const syntax::Word& command = block.tree.command(instruction);
    if (instruction.kind == InstructionKind::Assignment && command.register_number() > 0)
      now_.known_registers |= register_bit(command.register_number());
    const dialect::GCode* const g = instruction.kind == InstructionKind::G ? instruction.g() : nullptr;
    if (g == nullptr) continue;
    now_.waits_at_end = now_.waits_at_end || g->number == 200;
    if (g->mounts_face()) now_.face_line = block.tree.text;
  }
  if (block.tree.jump == nullptr) return;
  const int variable = block.tree.jump->variable;
  const bool known = variable > 0 && (now_.known_registers & register_bit(variable)) != 0;
  const bool listed = std::find(now_.assumed.begin(), now_.assumed.end(), variable) != now_.assumed.end();
  if (!known && !listed) now_.assumed.push_back(variable);
}

std::uint16_t RestartSurvey::traits_of(const Block& block) const {
  const State& state = block.state;
  const std::uint8_t motion = state.mode(ModalGroup::Motion);
  unsigned traits = kReached;
  if (compensates(state)) traits |= kCompensated;
  // At the heights of rapids nothing is in the way of a tool that stands a radius beside where it stood.
  if (compensated_ && state.position.tip.z() < now_.fed.max().z() - kSame) traits |= kOnContour;
  if (changed_low_) traits |= kChangedLow;
  if (looks_down(state)) traits |= kLooksDown;
  if (!state.face_mounted && tool_points_up(state)) traits |= kPointsUp;
  if (motion == 2 || motion == 3) traits |= kInArc;
  if (block.tree.is_empty()) traits |= kIdle;
  if (block.tree.jump != nullptr) traits |= kJumps;
  for (const Instruction& instruction : block.tree.instructions) {
    const dialect::GCode* const g = instruction.kind == InstructionKind::G ? instruction.g() : nullptr;
    if (instruction.kind == InstructionKind::Continuation) traits |= kContinues;
    // Behind M02 nothing is left to be done.
    if (block.tree.ends_program(instruction)) traits |= kIdle;
    if (g != nullptr && g->is_motion()) traits |= kNamesMotion;
    if (g != nullptr && g->number == 9 && instruction.has(Instruction::kFirst)) traits |= kStopsExactly;
  }
  return static_cast<std::uint16_t>(traits);
}

bool RestartSurvey::has(std::uint64_t line, std::uint16_t trait) const {
  return line < traits_.size() && (traits_[line] & trait) != 0;
}

Obstacle RestartSurvey::obstacle(std::uint64_t line) const {
  if (run_.ending == Ending::Error) return Obstacle::ProgramError;
  if (!has(line, kReached)) return line < traits_.size() ? Obstacle::JumpedOver : Obstacle::BehindEnd;
  if (has(line, kCompensated)) return Obstacle::Compensation;
  if (has(line, kOnContour)) return Obstacle::OnContour;
  if (has(line, kChangedLow)) return Obstacle::FrameChangedLow;
  if (has(line, kLooksDown)) return Obstacle::FaceLooksDown;
  if (has(line, kPointsUp)) return Obstacle::ToolPointsUp;
  if (exact_stop_follows(line)) return Obstacle::ExactStop;
  if (has(line, kInArc) && continues_motion(line)) return Obstacle::ArcContinues;
  return Obstacle::None;
}

bool RestartSurvey::is_safe(std::uint64_t line) const {
  return line < traits_.size() && !has(line, kIdle) && obstacle(line) == Obstacle::None;
}

std::uint64_t RestartSurvey::line_of_cause(std::uint64_t line) const {
  for (const auto& [from, to] : jumps_)
    if (from < line && line < to) return from;
  return run_.line;
}

bool RestartSurvey::has_choices() const {
  return std::any_of(traits_.begin(), traits_.end(), [](std::uint16_t traits) { return (traits & kJumps) != 0; });
}

/// Blank lines and comments between a feed move and its G09 do not count.
bool RestartSurvey::exact_stop_follows(std::uint64_t line) const {
  while (has(line, kReached) && has(line, kIdle)) ++line;
  return has(line, kStopsExactly);
}

/// Whether some line may need the motion G in force. Behind an IF either way is possible, and nothing is ruled out.
bool RestartSurvey::continues_motion(std::uint64_t line) const {
  for (; line < traits_.size(); ++line) {
    if (has(line, kContinues | kJumps)) return true;
    if (has(line, kNamesMotion)) return false;
  }
  return false;
}

}  // namespace isocnc::running
