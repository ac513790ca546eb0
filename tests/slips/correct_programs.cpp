#include "correct_programs.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

#include "analyzer/explain.h"
#include "hunt.h"
#include "tests/support/text_of_file.h"

namespace isocnc::slips {

namespace fs = std::filesystem;

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text.append(line).append("\n");
  return text;
}

static Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream input(text);
  for (std::string line; std::getline(input, line); lines.push_back(line))
    if (line.ends_with('\r')) line.pop_back();
  return lines;
}

/// Adds the program if it is correct.
static void add(ProgramSource& source, const std::string& name, Lines lines) {
  if (lines.size() > 1 && codes_in(joined(lines)).empty()) source.programs.push_back({name, std::move(lines)});
}

/// All files below a folder of the project that end with `extension`, sorted.
static std::vector<fs::path> files_below(const std::string& folder, const std::string& extension) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(ISOCNC_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

static ProgramSource examples() {
  ProgramSource source{"examples", {}};
  for (const fs::path& file : files_below("examples", ".iso"))
    add(source, file.filename().string(), lines_of(text_of_file(file)));
  return source;
}

/// The parts of the golden files, which a line `; ====` separates.
static ProgramSource golden_programs() {
  ProgramSource source{"golden programs", {}};
  for (const fs::path& file : files_below("tests/programs", ".iso")) {
    int number = 0;
    Lines part;
    const auto finish = [&] {
      add(source, file.filename().string() + " " + std::to_string(++number), std::move(part));
    };
    for (const std::string& line : lines_of(text_of_file(file))) {
      if (!line.starts_with("; ====")) {
        part.push_back(line);
        continue;
      }
      finish();
      part.clear();
    }
    finish();
  }
  return source;
}

/// The right programs of the table of diagnostics.
static ProgramSource right_programs() {
  ProgramSource source{"right programs", {}};
  for (const dialect::DiagnosticDef& row : dialect::kDiagnostics)
    add(source, std::string(row.code), lines_of(std::string(row.right)));
  return source;
}

/// Adds a code block of a page. Where it is a fragment, which takes a tool and a feed rate as given, completes it.
static void add_block(ProgramSource& source, const std::string& name, const Lines& block) {
  Lines completed = {"M06 T101001", "F1000"};
  completed.insert(completed.end(), block.begin(), block.end());
  completed.emplace_back("M02");
  const std::size_t before = source.programs.size();
  add(source, name, block);
  if (source.programs.size() == before) add(source, name, completed);
}

/// The code blocks of the pages that are programs, or fragments of programs.
static ProgramSource programs_of_pages() {
  ProgramSource source{"pages", {}};
  std::vector<fs::path> pages = files_below("docs", ".md");
  pages.push_back(fs::path(ISOCNC_SOURCE_DIR) / "README.md");
  for (const fs::path& page : pages) {
    int number = 0;
    bool is_inside = false;
    Lines block;
    for (const std::string& line : lines_of(text_of_file(page))) {
      if (!line.starts_with("```")) {
        if (is_inside) block.push_back(line);
        continue;
      }
      if (is_inside) add_block(source, page.filename().string() + " " + std::to_string(++number), block);
      is_inside = !is_inside;
      block.clear();
    }
  }
  return source;
}

std::vector<ProgramSource> correct_programs() {
  return {examples(), golden_programs(), right_programs(), programs_of_pages()};
}

}  // namespace isocnc::slips
