#include "interpreter/system/process.h"

#include <cstdlib>

namespace isocnc::system {

void prepare_process() {}

ProgramArguments::ProgramArguments(int argc, char** argv) : pointers_(argv, argv + argc) {
  pointers_.push_back(nullptr);
}

/// No signal arrives here.
void before_forced_end(void (*)()) {}

bool take_end_request() { return false; }

bool is_end_requested() { return false; }

bool sleep_until_end_request(std::chrono::milliseconds) { return false; }

void share_one_heap() {}

bool has_threads() { return false; }

int processor_count() { return 1; }

/// The process that started a server is the page or the editor that holds it.
bool is_running(std::int64_t) { return true; }

std::variant<ProgramEnd, std::error_code> run_program(const std::vector<std::string>&, std::string_view) {
  return std::make_error_code(std::errc::function_not_supported);
}

std::filesystem::path program_file() { return {}; }

std::string user_locale() { return {}; }

}  // namespace isocnc::system
