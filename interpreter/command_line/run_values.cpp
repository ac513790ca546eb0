#include "interpreter/command_line/run_values.h"

#include <charconv>
#include <cmath>

#include "interpreter/dialect/format.h"
#include "interpreter/syntax/number.h"

namespace isocnc::command_line {

using dialect::Text;

static constexpr Text kWrongSetting{"--set takes a register and a plain number, V1=0 to V30=-2.5, not {}",
                                    "--set vuole un registro e un numero semplice, da V1=0 a V30=-2.5, non {}"};
static constexpr Text kWrongVgpl{"--vgpl takes a plain number, such as -2.5, not {}",
                                 "--vgpl vuole un numero semplice, come -2.5, non {}"};

std::optional<double> read_decimal(std::string_view text) {
  if (text.empty() || text.find_first_not_of("+-.0123456789") != std::string_view::npos) return std::nullopt;
  const syntax::Number number = syntax::scan_number(text.data(), text.data() + text.size());
  if (number.has(syntax::Number::kMalformed) || std::isnan(number.value)) return std::nullopt;
  return number.value;
}

std::optional<std::size_t> read_count(std::string_view text, std::size_t maximum) {
  std::size_t count = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc{} || after != end || count < 1 || count > maximum) return std::nullopt;
  return count;
}

/// Parses a setting such as V3=1.5.
static bool read_register(std::string_view setting, running::RunOptions& run) {
  const std::size_t equals = setting.find('=');
  if (!setting.starts_with('V') || equals == std::string_view::npos) return false;
  const auto reg = read_count(setting.substr(1, equals - 1), dialect::kRegisterCount);
  const auto value = read_decimal(setting.substr(equals + 1));
  if (!reg || !value) return false;
  run.registers[*reg] = *value;
  return true;
}

void add_run_values(ProgramApp& program, RunValues& values) {
  program.add_option("--vgpl", values.vgpl, {"VALUE", "VALORE"},
                     {"Value of VGPL (else 0)", "Valore di VGPL (altrimenti 0)"});
  program
      .add_option("--set", values.settings, {"V=VALUE", "V=VALORE"},
                  {"Value of a register at the start: V3=1.5", "Valore iniziale di un registro: V3=1.5"})
      .takes_one();
}

std::optional<std::string> set_run_values(const RunValues& values, dialect::Language language,
                                          running::RunOptions& run) {
  for (const std::string& setting : values.settings)
    if (!read_register(setting, run)) return dialect::format(kWrongSetting, language, setting);
  const auto vgpl = read_decimal(values.vgpl);
  if (!vgpl) return dialect::format(kWrongVgpl, language, values.vgpl);
  run.vgpl = *vgpl;
  return std::nullopt;
}

}  // namespace isocnc::command_line
