#pragma once

namespace isocnc::system {

/// The exit status of each program, as the shell sees it.
enum class ExitStatus : int {
  Success = 0,   ///< No finding of error severity, no file to change, or a run to its M02.
  Findings = 1,  ///< Findings, a file that would change, or a run stopped by a program error.
  Failure = 2,   ///< A mistake in the command, a file that cannot be read or written, or an internal error.
};

}  // namespace isocnc::system
