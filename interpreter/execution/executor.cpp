#include "interpreter/execution/executor.h"

#include <algorithm>
#include <array>

#include "interpreter/dialect/lint_thresholds.h"

namespace isocnc::execution {

using namespace dialect::literals;
using dialect::GRole;
using syntax::Instruction;
using syntax::InstructionKind;
using syntax::Word;

void Executor::run() {
  if (!line_.findings.empty()) allow_for_findings();
  if (line_.has(syntax::LineTree::kMayMove)) allow_for_call();
  // S takes effect before the line's motion, wherever it stands (I.4.2).
  if (line_.spindle >= 0) {
    const double speed = line_.words[static_cast<std::size_t>(line_.spindle)].value;
    if (speed > 0) sink_.step(BlockStep::SpindleSpeed, state_);
    state_.speed_given = true;  // Also by one that cannot be read.
    take_spindle_speed(speed, state_);
    if (speed > 0) sink_.spindle_speed(speed);
  }
  for (const Instruction& instruction : line_.instructions) {
    switch (instruction.kind) {
      case InstructionKind::Continuation:
        motion(instruction);
        break;
      case InstructionKind::G:
        execute_g(instruction);
        break;
      case InstructionKind::Function:
        function(instruction);
        break;
      case InstructionKind::ToolChange:
        tool_change(instruction);
        break;
      case InstructionKind::StrayTool:
        stray_tool(instruction);
        break;
      case InstructionKind::Assignment:
        assign(instruction);
        break;
      case InstructionKind::Jump:
        break;
    }
    if (state_.ended) return;
  }
  if (!line_.findings.empty()) blur_axes_of_late_mode();
  if (garbled_ != 0) blur_garbled_axes();
  if (line_.feed >= 0 && !feed_move_) apply_feed_without_motion();
  // A number may be a feed move that has lost its letter (D58).
  state_.exact_stop_fits = feed_move_ || line_.number_without_letter() != nullptr;
  const bool is_compensated = state_.mode(dialect::ModalGroup::CutterCompensation) != 40;
  if (is_compensated && (feed_move_ || rapid_move_) && moves_in_plane())
    sink_.step(BlockStep::CompensatedMotion, state_);
  for (const syntax::Finding& finding : line_.findings) lack_.take({finding.id, finding.cause});
  if (!lack_.empty()) lack_.remove_words_of(line_);
  state_.lack = lack_;
}

/// Whether the line has a coordinate of the plane in force.
bool Executor::moves_in_plane() const {
  const Plane& plane = plane_in_force(state_);
  return std::any_of(line_.words.begin(), line_.words.end(),
                     [&](const Word& word) { return word.letter == plane.u_letter || word.letter == plane.v_letter; });
}

void Executor::execute_g(const Instruction& instruction) {
  const dialect::GCode* const code = instruction.g();
  if (!code) return execute_unknown_g(instruction);
  switch (code->role) {
    case GRole::Rapid:
    case GRole::Line:
    case GRole::ClockwiseArc:
    case GRole::CounterclockwiseArc:
      motion(instruction);
      if (!line_.command(instruction).is_plain_integer()) make_motion_illegible();  // G-1 may be no G1 (D57).
      return;
    case GRole::Dwell:
      return dwell(instruction);
    case GRole::ExactStop:
      return exact_stop(instruction);
    case GRole::FaceByAxes:
    case GRole::FaceAtTip:
    case GRole::FaceByAngles:
      return mount_face(instruction, *code);
    case GRole::DismountFace:
      return dismount_face(instruction);
    case GRole::Workpiece:
      return workpiece_frame(instruction);
    case GRole::PlaneXY:
    case GRole::PlaneZX:
    case GRole::PlaneYZ:
    case GRole::CompensationOff:
    case GRole::CompensationLeft:
    case GRole::CompensationRight:
    case GRole::Mode:
      return set_mode(*code, line_.command(instruction));
    case GRole::Signal:
      return sink_.signal(*code);
    case GRole::PendingEnd:
    case GRole::ApplyMdi:
      return;  // They concern the program after this one, and the operator.
  }
}

/// The effect of an unknown G is unknown; the positions of the axes that it names become unknown, too.
void Executor::execute_unknown_g(const Instruction& instruction) {
  const Arguments arguments(line_, instruction);
  const Word& g = line_.command(instruction);
  if (doubt_unknown_g(g, arguments)) return move_illegibly(arguments);
  const bool has_taken_word = takes_number(g);
  if (has_taken_word || may_be_motion(arguments)) make_motion_illegible();
  if (has_taken_word) blur_axes_not_named();  // G01 -20, G01 540: the letter of some axis is lost.
  move_illegibly(arguments);
}

/// Whether a G that is unknown to this control or illegible may have been meant as a motion that stays in force (D57):
/// one on a line with coordinates.
bool Executor::may_be_motion(const Arguments& arguments) {
  return (arguments.present() & dialect::kCoordinateLetters) != 0;
}

/// Whether a repetition (G27 G27, G49 G49) has been reported at the first code, which must be alone on its line.
bool Executor::repetition_is_reported(const dialect::GCode& code) const {
  const auto is_same = [&](const Instruction& each) { return each.g() == &code; };
  return line_.has(syntax::LineTree::kAloneViolated) &&
         std::count_if(line_.instructions.begin(), line_.instructions.end(), is_same) > 1;
}

/// Whether the line has a finding at this word.
bool Executor::is_reported(const Word& word) const {
  return std::any_of(line_.findings.begin(), line_.findings.end(),
                     [&](const syntax::Finding& finding) { return finding.span == word.span(); });
}

void Executor::set_mode(const dialect::GCode& code, const Word& word) {
  const std::uint16_t bit = State::bit(code.group);
  const bool repeats = state_.mode(code.group) == code.number && (state_.written & bit) != 0;
  if (repeats && code.repeated != dialect::kNoDiagnostic && !repetition_is_reported(code))
    report(code.repeated, word.span());
  if (code.group == dialect::ModalGroup::CutterCompensation) {
    if (code.number == 40) {
      sink_.step(BlockStep::CompensationOff, state_);
    } else if (state_.mode(code.group) == 40) {
      sink_.step(BlockStep::CompensationOn, state_);
    }
  }
  if (code.group == dialect::ModalGroup::FeedMode) sink_.step(BlockStep::FeedMode, state_);
  if (code.group == dialect::ModalGroup::Interpolation) sink_.step(BlockStep::InterpolationMode, state_);
  end_doubt(code.group);
  state_.set_mode(code);
  state_.written |= bit;
  if (code.group == dialect::ModalGroup::CutterCompensation && is_reported(word)) doubt(code.group);  // G41 for G40.
}

/// G09 belongs to the feed move before it: directly after its arguments, or first on the next line (D23).
void Executor::exact_stop(const Instruction& instruction) {
  const bool fits = instruction.has(Instruction::kFollowsMotion)
                        ? feed_move_
                        : instruction.has(Instruction::kFirst) && state_.exact_stop_fits;
  if (fits) return sink_.exact_stop();
  if (state_.motion_illegible) return;
  const bool follows_rapid = instruction.has(Instruction::kFollowsMotion) && rapid_move_;
  report(follows_rapid ? "g09-misplaced/after-rapid"_cause : "g09-misplaced"_diag, line_.command(instruction).span());
}

/// Whether the words after a G04 are those of a motion: two coordinates, or a circle.
static bool names_motion(const Arguments& arguments) {
  const dialect::LetterSet linear = arguments.present() & dialect::kLinearLetters;
  const bool has_circle = (arguments.present() & dialect::kCircleLetters) != 0;
  return has_circle || (linear & (linear - 1)) != 0;
}

/// Whether the only word after a G04 is the time as other controls have it: X1.5, and not X754.
static bool names_time(const Arguments& arguments) {
  constexpr double kLongestTime = dialect::LintThresholds{}.longest_dwell;
  const double seconds = arguments.value_or('X', -1);
  return arguments.present() == dialect::letter_bit('X') && seconds >= 0 && seconds <= kLongestTime;
}

void Executor::dwell(const Instruction& instruction) {
  const Arguments arguments(line_, instruction);
  if (!arguments.has('P') && (arguments.present() & dialect::kCoordinateLetters) != 0) {
    if (line_.feed >= 0 || !names_time(arguments)) {  // G04 X10 Y5 for G00.
      if (names_motion(arguments) || line_.feed >= 0 || !motion_is_legible()) make_motion_illegible();
      move_illegibly(arguments);
    }
  } else if (arguments.empty()) {
    doubt_lone_g(instruction);
  }
  const double seconds = arguments.value_or('P', 0);
  if (seconds >= 0) sink_.dwell(seconds);
}

void Executor::function(const Instruction& instruction) {
  const std::optional<int> m = line_.command(instruction).whole();
  if (!m) {  // An M with an illegible number (reported) may have been any M.
    sink_.step(BlockStep::IllegibleFunction, state_);
    state_.spindle = Spindle::Unknown;
    return;
  }
  if (m == dialect::kProgramEnd) {
    state_.ended = true;
    return sink_.end();
  }
  if (dialect::is_user_function(*m)) {
    sink_.step(BlockStep::UserFunction, state_);
  } else {
    turn_spindle(*m);
  }
  if (!sink_.wants_effects()) return;
  std::array<FunctionParameter, dialect::kMaxFunctionParameters> parameters;
  std::size_t count = 0;
  for (std::uint16_t i = instruction.begin; i + 1 < instruction.end && count < parameters.size(); ++i) {
    const Word& name = line_.words[i];
    const Word& value = line_.words[i + 1u];
    const int number = name.owner == instruction.number && name.letter == 'P' ? name.parameter_number() : 0;
    if (number != 0 && value.letter == syntax::kAssign && value.known()) parameters[count++] = {number, value.value};
  }
  sink_.function(*m, {parameters.data(), count});
}

void Executor::turn_spindle(int m) {
  sink_.step(m != 5                   ? BlockStep::SpindleStart
             : state_.spindle_turns() ? BlockStep::SpindleStop
                                      : BlockStep::RepeatedStop,
             state_);
  state_.spindle_function = static_cast<std::uint8_t>(m);
  state_.spindle = m == 3 ? Spindle::Clockwise : m == 4 ? Spindle::Counterclockwise : Spindle::Stopped;
}

void Executor::tool_change(const Instruction& instruction) {
  state_.tool_prepared = false;
  state_.spindle = Spindle::Unknown;  // Its effect on the spindle depends on the machine.
  for (const Word& word : line_.words)
    if (word.letter == 'T' && word.owner == instruction.number) return select_tool(word);
  sink_.step(BlockStep::ToolLost, state_);
  state_.tool_known = false;
  state_.tool_selected = true;  // Without T, or with a T reported elsewhere, it still counts as a change.
}

/// Whether a T follows an N06, which has been reported as a second line number.
bool Executor::follows_wrong_m06(const Instruction& tool) const {
  if (tool.command == 0) return false;
  const Word& before = line_.words[tool.command - 1u];
  return before.letter == 'N' && before.value == dialect::kToolChange && !line_.findings.empty();
}

void Executor::stray_tool(const Instruction& instruction) {
  const Word& word = line_.command(instruction);
  const Word* const number = line_.number_without_letter();
  const bool is_lost_change =
      (number && number->value == dialect::kToolChange) || follows_wrong_m06(instruction);  // 06 T101001 (D58)
  const bool follows_change =
      is_lost_change || (dialect::contains(state_.lack.letters, 'T') && instruction.has(Instruction::kFirst));
  const bool is_legible = word.is_tool();  // An illegible T has been reported already.
  if (!follows_change && is_legible) report("tool-without-m06"_diag, word.span());
  state_.tool_prepared = !follows_change && instruction.has(Instruction::kFirst);
  select_tool(word);
}

void Executor::select_tool(const Word& word) {
  const std::optional<int> number = word.tool_number();
  const ToolCode tool = number ? tool_code(*number) : ToolCode{};
  sink_.step(tool.head != 0 ? BlockStep::ToolMounted : BlockStep::ToolLost, state_);
  state_.tool_selected = true;  // A wrong number counts as a tool change, too (D44).
  state_.tool = tool;
  state_.tool_known = tool.head != 0;
  if (!number) return;
  const bool impossible =
      (state_.tool.head == 0 && state_.tool.holder != 0) || (state_.tool.holder == 0 && state_.tool.tool != 0);
  if (!impossible && !is_configured(state_.tool)) report("tool-not-configured"_diag, word.span());
  sink_.tool_change(state_.tool);
}

/// A zero means that nothing is mounted, which needs no configuration (I.4.3).
bool Executor::is_configured(ToolCode tool) const {
  if (!setup_.tools || tool.head == 0) return true;
  return std::any_of(setup_.tools->begin(), setup_.tools->end(), [&](const ToolCode& listed) {
    return listed.head == tool.head && (tool.holder == 0 || listed.holder == tool.holder) &&
           (tool.tool == 0 || listed.tool == tool.tool);
  });
}

void Executor::assign(const Instruction& instruction) {
  if (const auto assigned = assigned_by(instruction, line_)) sink_.assign(assigned->reg, assigned->value);
}

/// In G93 an F without a feed move is ignored; in G94 an F on the line of a rapid is ignored, too (D43).
void Executor::apply_feed_without_motion() {
  const Word& word = line_.words[static_cast<std::size_t>(line_.feed)];
  if (state_.is_in_doubt(dialect::ModalGroup::FeedMode)) {
    take_feed();
  } else if (state_.inverse_time()) {
    const bool may_have_motion = state_.motion_illegible || line_.number_without_letter();
    if (!(word.value <= 0) && !may_have_motion) report("feed-ignored"_diag, word.span());
  } else if (!rapid_move_) {
    take_feed();
  } else if (!state_.feed_given && !state_.feed_reported) {
    state_.feed_on_rapid = true;
  }
}

}  // namespace isocnc::execution
