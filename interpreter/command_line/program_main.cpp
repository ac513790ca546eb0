#include "interpreter/command_line/program_main.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

#include <fmt/format.h>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/mapped_file.h"
#include "interpreter/system/output_file.h"
#include "interpreter/system/process.h"
#include "interpreter/system/system_texts.h"
#include "interpreter/system/temporary_file.h"
#include "interpreter/system/user_language.h"
#include "interpreter/text/unicode.h"

namespace isocnc::command_line {

using system::ExitStatus;

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): an exception that nobody handles brings none.
static std::string_view running_program;

/// Prints a line at once, since several threads may be in trouble; allocates no memory.
static void report(const char* what, const char* details = "") {
  std::array<char, 1024> line{};
  std::snprintf(line.data(), line.size(), "%.*s: %s%s\n", static_cast<int>(running_program.size()),
                running_program.data(), what, details);
  std::fputs(line.data(), stderr);
}

/// Prints the current exception, handled or not.
static void report_failure() {
  try {
    if (const std::exception_ptr failure = std::current_exception()) std::rethrow_exception(failure);
    report("internal error");
  } catch (const std::bad_alloc&) {
    report("out of memory; memoria esaurita");
  } catch (const std::exception& error) {
    report("internal error: ", error.what());
  }
}

/// Ends the program after an uncaught exception in one of several threads.
[[noreturn]] static void end_in_trouble() {
  report_failure();
  system::remove_temporary_files();
  std::_Exit(static_cast<int>(ExitStatus::Failure));
}

/// Writes out what std::cout still has: what could not be written must not pass for a success.
static ExitStatus flush_output(std::string_view program, ExitStatus status) {
  errno = 0;
  if (std::cout.flush()) return status;
  complain(program,
           fmt::format("<stdout>: {}", system::cannot_write(errno != 0 ? errno : EIO, system::user_language())));
  return ExitStatus::Failure;
}

int program_main(std::string_view program, ExitStatus (*run)(int argc, char** argv), int argc, char** argv) {
  system::prepare_process();
  system::report_lost_bytes(program);
  system::leave_no_temporary_files();
  running_program = program;
  std::set_terminate(end_in_trouble);
  try {
    system::ProgramArguments arguments(argc, argv);
    return static_cast<int>(flush_output(program, run(arguments.count(), arguments.values())));
  } catch (const std::exception&) {
    report_failure();
    return static_cast<int>(ExitStatus::Failure);
  }
}

void complain(std::string_view program, std::string_view what) {
  std::cerr << program << ": " << text::printable(what) << '\n';
}

void complain_of_command(std::string_view program, std::string_view what) {
  complain(program, what);
  std::cerr << program << " --help\n";
}

ExitStatus say(std::string_view program, std::string_view text, dialect::Language language) {
  system::OutputFile output(system::kStandardOutput);
  output.write(text);
  const auto problem = system::commit(output, "<stdout>", language);
  if (!problem) return ExitStatus::Success;
  complain(program, *problem);
  return ExitStatus::Failure;
}

}  // namespace isocnc::command_line
