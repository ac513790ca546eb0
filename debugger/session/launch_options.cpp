#include "debugger/session/launch_options.h"

#include <cmath>

#include "debugger/dap/arguments.h"
#include "interpreter/system/paths.h"

namespace isocnc::session {

static constexpr dialect::Text kWrong{"{} cannot be {}", "{} non può essere {}"};
static constexpr dialect::Text kNoProgram{"program has to name a file", "program deve indicare un file"};

[[noreturn]] static void refuse(const char* key, const std::string& value) {
  throw dap::ArgumentError(kWrong, key, value);
}

static std::string shown(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// `{"V3": 1.5}`
static std::vector<std::pair<int, double>> read_registers(const Json* registers) {
  std::vector<std::pair<int, double>> read;
  if (registers == nullptr) return read;
  if (!registers->is_object()) refuse("registers", shown(*registers));
  for (const auto& [name, value] : registers->items()) {
    const auto number = expressions::find_register(name);
    if (!number || !value.is_number() || !std::isfinite(value.get<double>()))
      refuse("registers", shown(Json{{name, value}}));
    read.emplace_back(*number, value.get<double>());
  }
  return read;
}

static void read_files(const Json& arguments, LaunchOptions& options) {
  const std::string program = dap::member<std::string>(arguments, "program").value_or("");
  if (program.empty() || program.find('\0') != std::string::npos) throw dap::ArgumentError(kNoProgram, "program");
  const std::filesystem::path folder = dap::member<std::string>(arguments, "cwd").value_or("");
  options.program = system::normal(system::absolute(folder / program));
  const auto machine = dap::member<std::string>(arguments, "machine");
  if (machine && !machine->empty()) options.machine = system::generic_name(folder / *machine);
}

static double read_speed(const Json& arguments) {
  const double speed = dap::member<double>(arguments, "speed").value_or(0);
  if (!(speed >= 0) || !std::isfinite(speed)) refuse("speed", std::to_string(speed));
  return speed;
}

static std::optional<std::size_t> read_start_line(const Json& arguments) {
  const auto line = dap::member<std::int64_t>(arguments, "startAtLine");
  if (!line) return std::nullopt;
  if (*line < 1) refuse("startAtLine", std::to_string(*line));
  return static_cast<std::size_t>(*line) - 1;
}

static int read_decimals(const Json& arguments) {
  const std::int64_t decimals =
      dap::member<std::int64_t>(arguments, "decimals").value_or(expressions::ValueFormat{}.decimals);
  if (decimals < 0 || decimals > expressions::ValueFormat::kMaxDecimals) refuse("decimals", std::to_string(decimals));
  return static_cast<int>(decimals);
}

void from_json(const Json& arguments, LaunchOptions& options) {
  read_files(arguments, options);
  options.stop_on_entry = dap::member<bool>(arguments, "stopOnEntry").value_or(false);
  options.no_debug = dap::member<bool>(arguments, "noDebug").value_or(false);
  options.break_on_warnings = dap::member<bool>(arguments, "breakOnWarnings").value_or(false);
  options.speed = read_speed(arguments);
  options.vgpl = dap::member<double>(arguments, "vgpl").value_or(0);
  options.registers = read_registers(dap::find_member(arguments, "registers"));
  options.start_line = read_start_line(arguments);
  options.format.decimals = read_decimals(arguments);
}

}  // namespace isocnc::session
