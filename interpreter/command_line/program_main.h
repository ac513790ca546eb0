#pragma once

#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/exit_status.h"

/// Code that all programs share: main(), error messages and output.
namespace isocnc::command_line {

/// Implements main(): runs `run` and returns its exit status. Uncaught exceptions, in any thread, are printed and end
/// the program with ExitStatus::Failure. During the run, writing to a closed pipe or beyond the file size limit is a
/// failed write, not a signal; a mapped file cut short is reported; and a signal that ends the program removes its
/// temporary files.
int program_main(std::string_view program, system::ExitStatus (*run)(int argc, char** argv), int argc, char** argv);

/// Prints `isofmt: part.iso: cannot read: Permission denied` on standard error, without control characters.
void complain(std::string_view program, std::string_view what);
/// Prints an error of the command itself, with a hint to the help.
void complain_of_command(std::string_view program, std::string_view what);
/// Prints a requested text on standard output. Returns the exit status; if the write fails, an error is printed.
system::ExitStatus say(std::string_view program, std::string_view text, dialect::Language language);

}  // namespace isocnc::command_line
