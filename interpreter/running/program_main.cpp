#include "interpreter/running/program_main.h"

#include <csignal>
#include <exception>
#include <iostream>

#include <unistd.h>

#include "interpreter/running/mapped_file.h"
#include "interpreter/running/output_file.h"
#include "interpreter/running/temporary_file.h"
#include "interpreter/syntax/unicode.h"

namespace isocnc::running {

int program_main(std::string_view program, int (*run)(int argc, char** argv), int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  tell_of_lost_bytes(program);
  leave_no_temporary_files();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << program << ": internal error: " << error.what() << '\n';
    return kTroubleStatus;
  }
}

void complain(std::string_view program, std::string_view what) {
  std::cerr << program << ": " << syntax::printable(what) << '\n';
}

int complain_of_command(std::string_view program, std::string_view what) {
  complain(program, what);
  std::cerr << program << " --help\n";
  return kTroubleStatus;
}

int say(std::string_view program, std::string_view text, dialect::Language language) {
  OutputFile output(STDOUT_FILENO);
  output.write(text);
  const auto problem = flush(output, "<stdout>", language);
  if (!problem) return 0;
  complain(program, *problem);
  return kTroubleStatus;
}

}  // namespace isocnc::running
