// Begins to replace a file by the text `new`, says so, and does it when its standard input ends. Prints why it does
// not.
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "interpreter/system/replace_file.h"

int wmain(int argc, wchar_t** argv) {
  if (argc != 2) return 2;
  isocnc::system::FileReplacement replacement{std::filesystem::path(argv[1])};
  replacement.write("new");
  std::puts("begun");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  const std::optional<std::string> reason = replacement.commit(isocnc::dialect::Language::English);
  std::puts(reason ? reason->c_str() : "replaced");
  return 0;
}
