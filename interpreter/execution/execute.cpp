#include "interpreter/execution/execute.h"

#include <algorithm>
#include <limits>
#include <span>

#include "interpreter/execution/executor.h"

namespace isocnc::execution {

using syntax::Instruction;
using syntax::InstructionKind;

void execute(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink) {
  Executor executor(line, state, setup, sink);
  if (!line.is_empty()) return executor.run();
  if (!line.findings.empty()) executor.allow_for_unreadable_line();
}

/// Whether the line holds one valid instruction of this kind and nothing else.
static bool is_lone(InstructionKind kind, const syntax::LineTree& line) {
  return line.instructions.size() == 1 && line.instructions[0].kind == kind && line.feed < 0 && line.spindle < 0 &&
         line.findings.empty();
}

bool is_lone_jump(const syntax::LineTree& line) { return is_lone(InstructionKind::Jump, line); }

std::optional<Assigned> assigned_by(const Instruction& assignment, const syntax::LineTree& line) {
  const int reg = line.command(assignment).register_number();
  if (reg == 0) return std::nullopt;
  const bool has_value = assignment.end > assignment.command + 1;
  return Assigned{reg,
                  has_value ? line.words[assignment.command + 1u].value : std::numeric_limits<double>::quiet_NaN()};
}

std::optional<Assigned> lone_assignment(const syntax::LineTree& line) {
  if (!is_lone(InstructionKind::Assignment, line) || line.instructions[0].end != line.instructions[0].command + 2)
    return std::nullopt;
  return assigned_by(line.instructions[0], line);
}

/// The line with some of its instructions only, and with F and S only if they are among its words [first, last).
static syntax::LineTree part_of(const syntax::LineTree& line, std::span<const Instruction> instructions,
                                std::size_t first, std::size_t last) {
  syntax::LineTree part = line;
  part.instructions = instructions;
  const auto is_inside = [&](std::int32_t word) {
    return word >= static_cast<std::int32_t>(first) && word < static_cast<std::int32_t>(last);
  };
  if (!is_inside(line.feed)) part.feed = -1;
  if (!is_inside(line.spindle)) part.spindle = -1;
  return part;
}

JumpLine around_jump(const syntax::LineTree& line) {
  const auto is_jump = [](const Instruction& each) { return each.kind == InstructionKind::Jump; };
  const auto jump = std::find_if(line.instructions.begin(), line.instructions.end(), is_jump);
  const auto count = static_cast<std::size_t>(jump - line.instructions.begin()) + 1;
  return {part_of(line, line.instructions.first(count), 0, jump->end),
          part_of(line, line.instructions.subspan(count), jump->end, line.words.size())};
}

void pass_by(State& state) {
  state.exact_stop_fits = false;
  state.lack = {};
}

}  // namespace isocnc::execution
