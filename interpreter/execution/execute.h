#pragma once

#include <optional>

#include "interpreter/execution/sink.h"

namespace isocnc::execution {

/// Executes one block: `state` becomes the state after it. What the block does, and what is wrong with it that its text
/// alone does not show, goes to `sink` in the order of the program; what its text shows is in `line.findings` already.
/// Lengths in mm, angles in degrees, whatever G70/G71 said.
///
/// The one step that checker, simulator, language server and debugger share. It allocates nothing, cannot fail, and
/// knows no line number. It does not decide jumps: an IF belongs to who knows the registers (`line.jump`).
void execute(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink);

/// A register, 1 to 30, and the value that it is given. NaN: it could not be read.
struct Assigned {
  int reg = 0;
  double value = 0;
};
/// What an assignment on the line does; nothing where it names no register.
std::optional<Assigned> assigned_by(const syntax::Instruction& assignment, const syntax::LineTree& line);
/// The same of a line of nothing but one sound assignment.
std::optional<Assigned> lone_assignment(const syntax::LineTree& line);
/// Whether the line is nothing but one sound IF.
bool is_lone_jump(const syntax::LineTree& line);

/// execute() for such lines, which leave the machine alone, for who sees to the register or the jump.
void pass_by(State& state);

}  // namespace isocnc::execution
