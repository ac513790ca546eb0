#include "web/commands.h"

// The main() of each command, under a name of its own: see CMakeLists.txt.
int isolint_main(int argc, char** argv);
int isofmt_main(int argc, char** argv);
int isorun_main(int argc, char** argv);
int isodiff_main(int argc, char** argv);

namespace isocnc::web {

CommandMain command_named(std::string_view name) {
  if (name == "isolint") return isolint_main;
  if (name == "isofmt") return isofmt_main;
  if (name == "isorun") return isorun_main;
  if (name == "isodiff") return isodiff_main;
  return nullptr;
}

}  // namespace isocnc::web
