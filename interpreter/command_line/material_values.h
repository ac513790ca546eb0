#pragma once

#include <optional>
#include <string>

#include "interpreter/command_line/program_app.h"
#include "interpreter/dialect/diagnostic.h"
#include "interpreter/verification/material.h"

namespace isocnc::command_line {

/// `--resolution` and `--window` as text: numbers are parsed when the language of error messages is known.
struct MaterialValues {
  std::optional<std::string> resolution;
  std::optional<std::string> window;
};

/// The options that have been added.
struct MaterialProgramOptions {
  ProgramOption resolution;
  ProgramOption window;
};

/// Adds `--resolution` and `--window`.
MaterialProgramOptions add_material_values(ProgramApp& program, MaterialValues& values);

/// Sets how the material is simulated. Returns the error message, if a value cannot be read.
std::optional<std::string> set_material_values(const MaterialValues& values, dialect::Language language,
                                               verification::MaterialOptions& material);

}  // namespace isocnc::command_line
