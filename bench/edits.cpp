// Types digits into a program, one after the other, and has it checked after each as the language server does:
//   isocnc_edits COUNT FILE
// Prints how many lines were checked after an edit, on average.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>

#include "analyzer/check/analysis.h"
#include "interpreter/system/source_file.h"

namespace isocnc {
namespace {

/// Replaces the last digit of a line by the next one.
void type_digit(syntax::Document& document, std::size_t line) {
  const std::string_view text = document.text_of_line(line);
  const std::size_t at = text.find_last_of("0123456789");
  if (at == std::string_view::npos) return;
  const char next = text[at] == '9' ? '0' : static_cast<char>(text[at] + 1);
  document.replace({line, at}, {line, at + 1}, {&next, 1});
}

int run(int argc, char** argv) {
  const int count = argc == 3 ? std::atoi(argv[1]) : 0;
  if (count <= 0) {
    std::fputs("usage: isocnc_edits COUNT FILE\n", stderr);
    return 2;
  }
  const auto opened = system::SourceFile::open(argv[2], dialect::Language::English);
  if (const auto* const problem = std::get_if<system::SourceFile::Problem>(&opened)) {
    std::fprintf(stderr, "%s: %s\n", argv[2], problem->message.c_str());
    return 2;
  }
  const rules::CheckSetup setup;
  syntax::Document document(std::get<system::SourceFile>(opened).text());
  check::Analysis analysis(document, setup);
  std::mt19937_64 random;  // The same numbers everywhere.
  std::uint64_t lines = 0;
  std::size_t findings = 0;
  for (int i = 0; i < count; ++i) {
    type_digit(document, random() % document.line_count());
    analysis.update();
    lines += analysis.lines_checked();
    findings += analysis.excerpt({}).report.findings.size();
  }
  std::printf("after an edit: %.0f lines checked, %.0f findings\n", static_cast<double>(lines) / count,
              static_cast<double>(findings) / count);
  return 0;
}

}  // namespace
}  // namespace isocnc

int main(int argc, char** argv) { return isocnc::run(argc, argv); }
