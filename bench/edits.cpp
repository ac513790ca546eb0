// Types digits into a program, one after the other, and has it checked after each as the language server does:
//   isocnc_edits COUNT FILE
// Prints how many lines were checked after an edit and what was found, on average, and the time that an edit took.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string_view>
#include <vector>

#include "analyzer/check/analysis.h"
#include "interpreter/system/source_file.h"

namespace isocnc {
namespace {

/// As many as the language server sends.
constexpr std::size_t kMostFindings = 1001;

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
  std::vector<double> milliseconds;
  for (int i = 0; i < count; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    type_digit(document, random() % document.line_count());
    analysis.update();
    lines += analysis.lines_checked();
    findings += analysis.excerpt({.max = kMostFindings}).report.findings.size();
    milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  const double first = milliseconds.front();
  std::sort(milliseconds.begin(), milliseconds.end());
  std::printf("after an edit: %.0f lines checked, %.0f findings\n", static_cast<double>(lines) / count,
              static_cast<double>(findings) / count);
  std::printf("ms: median %.2f, 99th percentile %.2f, worst %.2f, first %.2f\n", milliseconds[milliseconds.size() / 2],
              milliseconds[milliseconds.size() * 99 / 100], milliseconds.back(), first);
  return 0;
}

}  // namespace
}  // namespace isocnc

int main(int argc, char** argv) { return isocnc::run(argc, argv); }
