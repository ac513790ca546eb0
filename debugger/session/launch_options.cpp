#include "debugger/session/launch_options.h"

#include <cmath>

#include "debugger/session/arguments.h"
#include "debugger/session/request_error.h"
#include "interpreter/dialect/format.h"

namespace isocnc::debugger::session {

static constexpr dialect::Text kWrong{"{} cannot be {}", "{} non può essere {}"};
static constexpr dialect::Text kNoProgram{"program has to name a file", "program deve indicare un file"};

[[noreturn]] static void refuse(std::string_view key, const std::string& value, dialect::Language language) {
  throw RequestError(dialect::format(kWrong, language, key, value));
}

/// `{"V3": 1.5}`
static std::vector<std::pair<int, double>> read_registers(const Json& registers, dialect::Language language) {
  std::vector<std::pair<int, double>> read;
  if (registers.is_null()) return read;
  if (!registers.is_object()) refuse("registers", registers.dump(), language);
  for (const auto& [name, value] : registers.items()) {
    const auto number = find_register(name);
    if (!number || !value.is_number() || !std::isfinite(value.get<double>()))
      refuse("registers", Json{{name, value}}.dump(-1, ' ', false, Json::error_handler_t::replace), language);
    read.emplace_back(*number, value.get<double>());
  }
  return read;
}

LaunchOptions read_launch_options(const Json& arguments, dialect::Language language) {
  LaunchOptions options;
  const std::string program = find_text(arguments, "program").value_or("");
  if (program.empty() || program.find('\0') != std::string::npos)
    throw RequestError(std::string(kNoProgram.in(language)));
  const std::filesystem::path folder = find_text(arguments, "cwd").value_or("");
  options.program = std::filesystem::absolute(folder / program).lexically_normal();
  if (const auto machine = find_text(arguments, "machine"); machine && !machine->empty())
    options.machine = (folder / *machine).string();
  options.stop_on_entry = find_flag(arguments, "stopOnEntry").value_or(false);
  options.no_debug = find_flag(arguments, "noDebug").value_or(false);
  options.break_on_warnings = find_flag(arguments, "breakOnWarnings").value_or(false);
  options.speed = find_number(arguments, "speed").value_or(0);
  if (!(options.speed >= 0) || !std::isfinite(options.speed)) refuse("speed", std::to_string(options.speed), language);
  options.vgpl = find_number(arguments, "vgpl").value_or(0);
  options.registers = read_registers(arguments.value("registers", Json()), language);
  if (const auto line = find_integer(arguments, "startAtLine")) {
    if (*line < 1) refuse("startAtLine", std::to_string(*line), language);
    options.start_line = static_cast<std::uint64_t>(*line) - 1;
  }
  const std::int64_t decimals = find_integer(arguments, "decimals").value_or(options.format.decimals);
  if (decimals < 0 || decimals > ValueFormat::kMostDecimals) refuse("decimals", std::to_string(decimals), language);
  options.format.decimals = static_cast<int>(decimals);
  return options;
}

}  // namespace isocnc::debugger::session
