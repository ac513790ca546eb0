#include "interpreter/system/terminal.h"

#include <windows.h>

#include "interpreter/system/windows/handle.h"

namespace isocnc::system {

/// A console shows escape sequences only once it is asked to; those before Windows 10 never do.
bool is_terminal(int descriptor) {
  HANDLE const console = handle_of(descriptor);
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 &&
         ::SetConsoleMode(console, mode | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool can_redraw(int descriptor) { return is_terminal(descriptor); }

}  // namespace isocnc::system
