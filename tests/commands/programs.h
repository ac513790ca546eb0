#pragma once

#include <string_view>

namespace isocnc::commands {

/// Nothing is wrong with it.
inline constexpr std::string_view kCleanProgram =
    "M06 T101001\n"
    "G00 X10 Y0 Z5\n"
    "M02\n";

/// One error, ISO026, at columns 1 to 4 of line 3.
inline constexpr std::string_view kBrokenProgram =
    "M06 T101001\n"
    "G00 X10 Y0 Z5\n"
    "G01\n"
    "M02\n";

/// One warning, W001, and no error.
inline constexpr std::string_view kWarnedProgram =
    "M06 T101001\n"
    "G71\n"
    "G71\n"
    "M02\n";

}  // namespace isocnc::commands
