#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/command_line/program_app.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/running/runner.h"

namespace isocnc::command_line {

/// Parses a number as in programs, with sign, digits and point only.
std::optional<double> read_decimal(std::string_view text);

/// Parses a number from 1 to `maximum`, of digits only; otherwise none.
std::optional<std::size_t> read_count(std::string_view text, std::size_t maximum);

/// `--vgpl` and `--set` as text: numbers are parsed when the language of error messages is known.
struct RunValues {
  std::string vgpl = "0";
  std::vector<std::string> settings;
};

/// Adds `--vgpl` and `--set`.
void add_run_values(ProgramApp& program, RunValues& values);

/// Sets the values of a run. Returns the error message, if one cannot be read.
std::optional<std::string> set_run_values(const RunValues& values, dialect::Language language,
                                          running::RunOptions& run);

}  // namespace isocnc::command_line
