#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "interpreter/kinematics/travel.h"
#include "interpreter/restart/restart_preamble.h"

namespace isocnc::restart {

/// The reason why there is no restart program, and the nearest lines with one. Lines from 0.
struct RestartRefusal {
  RestartObstacle obstacle = RestartObstacle::None;
  std::size_t line = 0;               ///< The requested line.
  std::size_t cause = 0;              ///< The IF or M02 that skips the line; for NoSuchLine the number of lines.
  bool has_choices = false;           ///< Another VGPL or register might lead to other lines.
  int g = 0;                          ///< The G in force that prevents the restart: 2, 3, 41 or 42.
  std::optional<std::size_t> before;  ///< The nearest safe line above.
  std::optional<std::size_t> after;   ///< The nearest safe line below.
  kinematics::Overtravel overtravel;  ///< For BeyondTravel: the axis, its position and its limit.
  running::RunResult run;  ///< For ProgramError: the result with the error; refers to the text of the program.
};

/// Returns a program that brings the machine into the state before a line, followed by the lines of `text` from there,
/// byte for byte. The result is proved by a trial run: from its start it reaches that line in the same state, with the
/// machine in the same position, and goes on and ends like the original. A UTF-8 byte-order mark is part of neither
/// text.
std::variant<std::string, RestartRefusal> restart_program(std::string_view text, const RestartOptions& options);

/// Why an operation cannot be run alone.
struct OperationRefusal {
  std::vector<std::size_t> changes;  ///< The lines of all M06 of that tool, from 0, unless the program has an error.
  std::optional<RestartRefusal> restart;  ///< Why there is no restart for the one that is meant; none if none is.
};

/// Returns a program that does one operation of `text` alone: what a tool does from the M06 that mounts it to the next
/// M06, or to the end. `change` is the line of that M06, from 0; it may be left out where the tool is mounted only
/// once. It is made and proved like a restart program, from the first line after the M06 from which a restart is
/// possible; no feed move is left out. It ends with M02, after an M05 if the spindle turns. `line` and `end` of the
/// options do not count.
std::variant<std::string, OperationRefusal> operation_program(std::string_view text, const RestartOptions& options,
                                                              const execution::ToolCode& tool,
                                                              std::optional<std::size_t> change);

/// The refusal as text for an operator, without a final line end; not for ProgramError, which has a finding.
std::string message(const RestartRefusal& refusal, dialect::Language language);

}  // namespace isocnc::restart
