#pragma once

#include <string>

#include "debugger/session/session_state.h"

namespace isocnc::session {

/// An event in the words of an operator, with the names that the machine file gives; empty for events that the console
/// does not show.
std::string event_text(const running::Event& event, const SessionState& state);

}  // namespace isocnc::session
