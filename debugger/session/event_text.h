#pragma once

#include <string>

#include "debugger/session/session_state.h"

namespace isocnc::session {

/// A tool change, an M function, a spindle speed or a G990 in the words of an operator, with the names that the machine
/// file gives; empty for other events.
std::string event_text(const running::Event& event, const SessionState& state);

}  // namespace isocnc::session
