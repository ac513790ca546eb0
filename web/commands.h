#pragma once

#include <string_view>

namespace isocnc::web {

/// The main() of a command.
using CommandMain = int (*)(int argc, char** argv);

/// The command of a module that has this name; null if the module has none. The module for all has four commands, that
/// of the playground only what its page runs: it is loaded from a server, and should be small.
CommandMain command_named(std::string_view name);

}  // namespace isocnc::web
