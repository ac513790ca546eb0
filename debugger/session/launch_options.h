#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "debugger/dap/client.h"
#include "debugger/expressions/expression.h"

namespace isocnc::session {

using rpc::Json;

/// The arguments of a launch.
struct LaunchOptions {
  std::filesystem::path program;
  std::optional<std::string> machine;  ///< Machine file, in place of the isocnc.json above the program.
  bool stop_on_entry = false;
  bool no_debug = false;
  bool break_on_warnings = false;
  double speed = 0;  ///< 0: as fast as possible; 1: in real time.
  double vgpl = 0;
  std::vector<std::pair<int, double>> registers;
  std::optional<std::size_t> start_line;  ///< Line from 0, to which the run goes without stopping.
  expressions::ValueFormat format;        ///< Format of all values that are shown.
};

/// Unknown members are ignored, as clients add members of their own. Throws ArgumentError.
void from_json(const Json& arguments, LaunchOptions& options);

}  // namespace isocnc::session
