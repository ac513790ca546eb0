#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/motion/travel.h"
#include "interpreter/restart/restart_preamble.h"

namespace isocnc::restart {

/// Why there is no restart program, and from where there would be one. Lines from 0.
struct RestartRefusal {
  Obstacle obstacle = Obstacle::None;
  std::uint64_t line = 0;    ///< That was asked for.
  std::uint64_t cause = 0;   ///< The IF or M02 by which it is not run; of a program too short, how many lines it has.
  bool has_choices = false;  ///< Another VGPL or register might lead elsewhere.
  int g = 0;                 ///< The G that is in force and in the way: 2, 3, 41 or 42.
  std::optional<std::uint64_t> before;  ///< The nearest line above that is safe.
  std::optional<std::uint64_t> behind;  ///< The nearest below.
  motion::Overtravel overtravel;        ///< BeyondTravel: what goes where.
  running::RunResult run;               ///< ProgramError: with the error; points into the program.
};

/// A program that brings the machine into the state before a line, and goes on with the lines of `text` from there,
/// byte for byte. It has been tried: run from its start it comes to that line in the same state, with the machine in
/// the same place, and goes on and ends as the original does. A UTF-8 byte-order mark is not part of either.
std::variant<std::string, RestartRefusal> restart_program(std::string_view text, const RestartOptions& options);

/// Says it to an operator, in lines without an end; not for ProgramError, which has a finding.
std::string message(const RestartRefusal& refusal, dialect::Language language);

}  // namespace isocnc::restart
