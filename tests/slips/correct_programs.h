#pragma once

#include <string>
#include <vector>

namespace isocnc::slips {

using Lines = std::vector<std::string>;

/// A program in which the checker finds nothing.
struct CorrectProgram {
  std::string name;  ///< Its file and, where the file holds several, its number.
  Lines lines;
};

/// The correct programs of one source, such as the examples.
struct ProgramSource {
  std::string name;
  std::vector<CorrectProgram> programs;
};

/// The correct programs of the examples, of the golden programs, of the table of diagnostics and of the pages.
std::vector<ProgramSource> correct_programs();

/// Lines as a text, each with its line end.
std::string joined(const Lines& lines);

}  // namespace isocnc::slips
