#pragma once

namespace isocnc::system {

/// Whether a descriptor is a terminal, which then shows colors written as escape sequences.
bool is_terminal(int descriptor);

/// Whether a descriptor is a terminal that can draw a line again.
bool can_redraw(int descriptor);

}  // namespace isocnc::system
