#include "interpreter/sheet_report.h"

#include <algorithm>
#include <cctype>

#include "analyzer/check/check_text.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/verified.h"
#include "analyzer/selection/vgpl_values.h"
#include "interpreter/syntax/line_finder.h"

namespace isocnc::interpreter {

namespace {

bool ends_in(std::string_view name, std::string_view ending) {
  if (name.size() <= ending.size()) return false;
  return std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                    [](char one, char other) { return one == std::tolower(static_cast<unsigned char>(other)); });
}

/// The findings in the words of isolint.
std::vector<sheet::SheetFinding> findings_of(const sheet::SheetSubject& subject, const rules::CheckSetup& setup,
                                             const selection::Selection& selection,
                                             const simulation::RunOutcome& outcome) {
  const check::Report report =
      selection::shown_report_with_run(check::check_text(subject.text, setup), outcome, subject.text, selection);
  std::vector<sheet::SheetFinding> findings;
  syntax::LineFinder lines(subject.text);
  for (const check::LocatedFinding& located : report.findings)
    findings.push_back({located.line, located.severity(), std::string(dialect::definition(located.finding.id).code),
                        formats::message_of(located, report, lines.line(located.line), subject.language)});
  return findings;
}

/// The registers that the program expects, and the time of each path on which VGPL leads it.
void add_paths(const sheet::SheetSubject& subject, const simulation::TakenPath& first, sheet::Sheet& sheet) {
  selection::VgplValues values(subject.text);
  sheet.registers = values.unassigned_registers(first);
  if (values.constants().empty()) return;
  running::RunOptions options = subject.run;
  simulation::TakenPath path = first;
  while (true) {
    const selection::VgplValues::CellSet cells = values.cells_along(path);
    const auto [seconds, stop] = sheet::time_of(subject.text, options, subject.machine.timed, subject.language);
    sheet.paths.push_back({values.in_words(cells), seconds, stop});
    values.take(path);
    const std::optional<double> next = values.next();
    if (!next || sheet.paths.size() == selection::kMaxVerifiedPaths) break;
    options.vgpl = *next;
    path = verification::verified_run(subject.text, options, subject.machine.timed, nullptr).outcome.runs.front();
  }
  // One path for all values is none that is worth a word.
  if (sheet.paths.size() == 1 && sheet.paths[0].values.empty()) sheet.paths.clear();
}

}  // namespace

bool is_sheet_name(std::string_view file_name) {
  return ends_in(file_name, ".html") || ends_in(file_name, ".htm") || ends_in(file_name, ".pdf");
}

std::string sheet_file(std::string_view file_name, const sheet::SheetSubject& subject, const rules::CheckSetup& setup,
                       const selection::Selection& selection) {
  sheet::Sheet sheet = sheet::survey(subject);
  const verification::VerifiedRun verified =
      selection::verified_on_paths(subject.text, subject.run, subject.machine.timed, subject.scene);
  sheet.findings = findings_of(subject, setup, selection, verified.outcome);
  add_paths(subject, verified.outcome.runs.front(), sheet);
  return ends_in(file_name, ".pdf") ? sheet::pdf_of(sheet, subject.language) : sheet::html_of(sheet, subject.language);
}

}  // namespace isocnc::interpreter
