#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <variant>
#include <vector>

namespace isocnc::system {

/// Makes the process fit for a program of ours: writing to a closed pipe or past a limit is an error that the program
/// sees, standard streams are bytes, and the console shows UTF-8.
void prepare_process();

/// The arguments of main() in UTF-8.
class ProgramArguments {
 public:
  ProgramArguments(int argc, char** argv);

  int count() const { return static_cast<int>(pointers_.size()) - 1; }
  char** values() { return pointers_.data(); }

 private:
  std::vector<std::string> texts_;
  std::vector<char*> pointers_;  ///< With a null at the end, as main() has it.
};

/// Calls `clean_up` before Ctrl-C, a closed console or another request of the system ends the process. It may only do
/// what a signal handler may.
void before_forced_end(void (*clean_up)());

/// After this call the first Ctrl-C, or another request to end, leaves the end to the program, which asks for it below;
/// the second has the effect that the first had before. Returns false where no such request can arrive, so that a
/// program without other reasons to end would never do so.
bool take_end_request();
bool is_end_requested();
/// Sleeps until the end is requested, for this time at most. Returns whether it is.
bool sleep_until_end_request(std::chrono::milliseconds longest);

/// All threads share one heap, which grows in large steps: with a heap per thread the system would be asked for every
/// page again, a tenth of the time that opening a long program takes. Messages, which may have some hundred kilobytes
/// after each edit, lie in this heap for the same reason; the text of a long program does not. Call it before there
/// are threads.
void share_one_heap();

/// Whether a program can have more than one thread.
bool has_threads();
/// The number of processors that the process may use, at least 1: what `taskset` leaves it.
int processor_count();

/// Whether a process with this number exists.
bool is_running(std::int64_t process);

/// What has become of a program that ran to its end.
struct ProgramEnd {
  int status = 0;      ///< Its exit status; above 128 where a signal ended it.
  std::string output;  ///< What it wrote to standard output.
  std::string errors;  ///< And to standard error.
};

/// Runs another program to its end with `input` as its standard input: its name, which is looked for in the PATH alone,
/// and its arguments. An error where it cannot be started: std::errc::no_such_file_or_directory where there is none of
/// this name, and std::errc::function_not_supported in WebAssembly, where there are no processes. Call prepare_process
/// before: the other program need not read its input.
std::variant<ProgramEnd, std::error_code> run_program(const std::vector<std::string>& command, std::string_view input);

/// The file of the program that runs; empty if the system does not tell.
std::filesystem::path program_file();

/// The locale that the user has chosen for the system, `it-IT`; empty where only the environment tells.
std::string user_locale();

}  // namespace isocnc::system
