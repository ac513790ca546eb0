#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/fixes/fix.h"
#include "analyzer/rules/check_setup.h"
#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/simulation/run_findings.h"

namespace isocnc::analyzer {

/// A program of the table, without its marks `[!` and `!]`.
struct MarkedProgram {
  std::string text;
  bool has_mark = false;
  std::size_t line = 0;  ///< The line of the mark, from 0; `begin` and `end` are its byte columns.
  std::size_t begin = 0;
  std::size_t end = 0;
};
MarkedProgram read_marked(std::string_view program);

/// The program of the table that shows a cause; empty for what takes a longer one.
std::string_view wrong_program(dialect::Cause cause);

/// The machine for which the programs of the table are written: it has the limits that the program of this code
/// exceeds.
rules::CheckSetup example_setup(dialect::DiagnosticId id);

/// What isolint reports in a program if this code is selected, too.
check::Report example_report(std::string_view program, dialect::DiagnosticId id);

/// What a run shows of a program, on the machine for which the program of this code is written: its tool T101001 has a
/// radius of 10 mm.
std::vector<simulation::RunFinding> example_run(std::string_view program, dialect::DiagnosticId id);

/// A finding of a cause, in the program of the table or in one that is made for it.
struct Example {
  std::string line;  ///< The text of its line.
  syntax::Finding finding;
  std::optional<fixes::Fix> fix;

  std::string message(dialect::Language language) const { return syntax::message(finding, line, language); }
};
std::optional<Example> example_of(dialect::Cause cause);

/// The fixes of a code by the rows of the table: each as an example has it, else with `...` for what depends on the
/// program. Without a fix: the reason, as the title.
std::vector<fixes::Fix> example_fixes(dialect::DiagnosticId id);

}  // namespace isocnc::analyzer
