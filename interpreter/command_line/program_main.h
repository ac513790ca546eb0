#pragma once

#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/exit_status.h"

/// What all programs have in common, from main() to their last word.
namespace isocnc::command_line {

/// What main() does. `run` returns the exit status; an exception that it throws, or that nobody catches in another
/// thread, is told, and is trouble. While it runs, a pipe that nobody reads any more and a file that may not grow are
/// writes that fail, and no signals; a mapped file that is cut short is told, and a signal that ends the program leaves
/// no temporary files.
int program_main(std::string_view program, system::ExitStatus (*run)(int argc, char** argv), int argc, char** argv);

/// `isofmt: part.iso: cannot read: Permission denied`, on standard error, with nothing in it that a terminal would
/// obey.
void complain(std::string_view program, std::string_view what);
/// Of the command itself, with a word on where help is.
void complain_of_command(std::string_view program, std::string_view what);
/// What has been asked for, on standard output. The exit status, after a complaint where the text has not arrived.
system::ExitStatus say(std::string_view program, std::string_view text, dialect::Language language);

}  // namespace isocnc::command_line
