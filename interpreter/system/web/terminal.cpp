#include "interpreter/system/terminal.h"

#include <emscripten.h>

namespace isocnc::system {

// clang-format off
EM_JS(bool, host_has_terminal, (int descriptor), { return Module["isTerminal"] ? Module["isTerminal"](descriptor) : false; });
// clang-format on

/// Only the host knows: the streams of the module always look like terminals.
bool is_terminal(int descriptor) { return host_has_terminal(descriptor); }

bool can_redraw(int descriptor) { return is_terminal(descriptor); }

}  // namespace isocnc::system
