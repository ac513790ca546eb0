#include "interpreter/system/terminal.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace isocnc::system {

bool is_terminal(int descriptor) { return ::isatty(descriptor) != 0; }

bool can_redraw(int descriptor) {
  const char* const terminal = std::getenv("TERM");  // NOLINT(concurrency-mt-unsafe): nobody sets it.
  return is_terminal(descriptor) && terminal && std::string_view(terminal) != "dumb";
}

}  // namespace isocnc::system
