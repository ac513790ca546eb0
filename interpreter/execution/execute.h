#pragma once

#include "interpreter/execution/sink.h"

namespace isocnc::execution {

/// Executes one block: `state` becomes the state after it. What the block does, and what is wrong with it that its text
/// alone does not show, goes to `sink` in the order of the program; what its text shows is in `line.findings` already.
/// Lengths in mm, angles in degrees, whatever G70/G71 said.
///
/// The one step that checker, simulator, language server and debugger share. It allocates nothing, cannot fail, and
/// knows no line number. It does not decide jumps: an IF belongs to who knows the registers (`line.jump`).
void execute(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink);

/// execute() for most lines of most programs: a plain motion with which nothing is wrong, of which nobody wants to know
/// more, and which concerns nothing in State::knowledge. False, with nothing done, for any other line.
bool execute_plain(const syntax::LineTree& line, State& state, const Setup& setup, Sink& sink);

}  // namespace isocnc::execution
