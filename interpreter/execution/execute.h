#pragma once

#include <optional>

#include "interpreter/execution/sink.h"

namespace isocnc::execution {

/// Executes one block: `state` becomes the state after it. `sink` gets the block's effects and the findings that depend
/// on the state, in the order of the program; the findings of the text alone are in `line.findings` already. Lengths in
/// mm, angles in degrees, under G70 as well as G71.
///
/// The one step that checker, simulator, language server and debugger share. It allocates nothing, cannot fail, and
/// knows no line number. It does not decide jumps: the caller knows the registers and evaluates an IF (`line.jump`).
void execute(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink);

/// A register, 1 to 30, and its new value; NaN if the value could not be read.
struct Assigned {
  int reg = 0;
  double value = 0;
};
/// The register and the value of an assignment on the line; nothing if it names no register.
std::optional<Assigned> assigned_by(const syntax::Instruction& assignment, const syntax::LineTree& line);
/// The register and the value of a line that holds one valid assignment and nothing else.
std::optional<Assigned> lone_assignment(const syntax::LineTree& line);
/// Whether the line holds one valid IF and nothing else.
bool is_lone_jump(const syntax::LineTree& line);

/// A line with a jump, in the order of its execution (D56).
struct JumpLine {
  syntax::LineTree before;  ///< The part up to the jump, executed before its condition is evaluated.
  syntax::LineTree after;   ///< What stands after it, executed only if it does not jump.
};
JumpLine around_jump(const syntax::LineTree& line);

/// Shortcut for execute() on lines with a lone assignment or jump, which do not move the machine. The caller handles
/// the register or the jump.
void pass_by(State& state);

}  // namespace isocnc::execution
