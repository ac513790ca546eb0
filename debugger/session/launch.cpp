#include "debugger/session/launch.h"

#include <cmath>

#include <fmt/format.h>

#include "debugger/session/arguments.h"
#include "debugger/session/request_error.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/format.h"

namespace isocnc::debugger::session {

using configuration::Configuration;
using configuration::Configurations;

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
    const Quantity* const quantity = find_quantity(name);
    const bool is_register = quantity != nullptr && quantity->is_register;
    if (!is_register || !value.is_number() || !std::isfinite(value.get<double>()))
      refuse("registers", Json{{name, value}}.dump(-1, ' ', false, Json::error_handler_t::replace), language);
    read.emplace_back(quantity->index, value.get<double>());
  }
  return read;
}

LaunchWishes read_wishes(const Json& arguments, dialect::Language language) {
  LaunchWishes wishes;
  const std::string program = find_text(arguments, "program").value_or("");
  if (program.empty() || program.find('\0') != std::string::npos)
    throw RequestError(std::string(kNoProgram.in(language)));
  const std::filesystem::path folder = find_text(arguments, "cwd").value_or("");
  wishes.program = std::filesystem::absolute(folder / program).lexically_normal();
  if (const auto machine = find_text(arguments, "machine"); machine && !machine->empty())
    wishes.machine = (folder / *machine).string();
  wishes.stop_on_entry = find_flag(arguments, "stopOnEntry").value_or(false);
  wishes.no_debug = find_flag(arguments, "noDebug").value_or(false);
  wishes.break_on_warnings = find_flag(arguments, "breakOnWarnings").value_or(false);
  wishes.speed = find_number(arguments, "speed").value_or(0);
  if (!(wishes.speed >= 0) || !std::isfinite(wishes.speed)) refuse("speed", std::to_string(wishes.speed), language);
  wishes.vgpl = find_number(arguments, "vgpl").value_or(0);
  wishes.registers = read_registers(arguments.value("registers", Json()), language);
  if (const auto line = find_integer(arguments, "startAtLine")) {
    if (*line < 1) refuse("startAtLine", std::to_string(*line), language);
    wishes.start_line = static_cast<std::uint64_t>(*line) - 1;
  }
  const std::int64_t decimals = find_integer(arguments, "decimals").value_or(wishes.format.decimals);
  if (decimals < 0 || decimals > ValueFormat::kMostDecimals) refuse("decimals", std::to_string(decimals), language);
  wishes.format.decimals = static_cast<int>(decimals);
  return wishes;
}

/// All mistakes of the configurations, a line each.
static std::string mistakes_of(const Configurations& read, dialect::Language language) {
  std::string all;
  for (const std::string& mistake : read.mistakes(language)) all += (all.empty() ? "" : "\n") + mistake;
  return all;
}

Launched launch(const LaunchWishes& wishes, std::optional<dialect::Language> commanded, dialect::Language clients) {
  const dialect::Language present_language = commanded.value_or(clients);
  const std::filesystem::path folder = wishes.program.parent_path();
  Configurations found({}, present_language);
  Configurations given({.file = wishes.machine, .none = !wishes.machine}, present_language);
  Configuration configuration = found.in_folder(folder);
  if (wishes.machine) configuration.machine = given.in_folder(folder).machine;
  const dialect::Language speaking = commanded.value_or(configuration.language.value_or(clients));
  for (const Configurations* const read : {&found, &given})
    if (const std::string mistakes = mistakes_of(*read, speaking); !mistakes.empty()) throw RequestError(mistakes);
  auto text = ProgramText::read(wishes.program, speaking);
  if (const auto* const problem = std::get_if<ProgramText::Problem>(&text))
    throw RequestError(fmt::format("{}: {}", wishes.program.string(), problem->message));
  running::RunOptions options;
  options.setup = configuration.machine.setup;
  options.vgpl = wishes.vgpl;
  for (const auto& [number, value] : wishes.registers) options.registers[static_cast<std::size_t>(number)] = value;
  return {Debuggee(std::get<ProgramText>(std::move(text)), options, configuration.machine.timed),
          std::move(configuration)};
}

}  // namespace isocnc::debugger::session
