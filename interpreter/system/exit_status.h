#pragma once

namespace isocnc::system {

/// How each of the programs ends, as the shell sees it.
enum class ExitStatus : int {
  Success = 0,   ///< Nothing of error severity, nothing to change, or a run to its M02.
  Findings = 1,  ///< Findings, a file that would change, or a run that a program error has stopped.
  Failure = 2,   ///< A mistake in the command, a file that cannot be read or written, or an internal error.
};

}  // namespace isocnc::system
