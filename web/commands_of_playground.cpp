#include "web/commands.h"

// The main() of the command, under a name of its own: see CMakeLists.txt.
int isolint_main(int argc, char** argv);

namespace isocnc::web {

CommandMain command_named(std::string_view name) { return name == "isolint" ? isolint_main : nullptr; }

}  // namespace isocnc::web
