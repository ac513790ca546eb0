#include "interpreter/sheet_report.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "analyzer/check/check_text.h"
#include "analyzer/formats/rendering.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/verified.h"
#include "analyzer/selection/vgpl_values.h"
#include "interpreter/dialect/any_case.h"
#include "interpreter/execution/execute.h"
#include "interpreter/syntax/each_tree.h"
#include "interpreter/syntax/line_finder.h"

namespace isocnc::interpreter {

namespace {

/// Whether there is a name before the ending.
bool ends_in(std::string_view name, std::string_view ending) {
  return name.size() > ending.size() && dialect::ends_with(name, ending);
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

/// The registers that IFs compare though the program assigns them nowhere.
std::set<int> registers_without_assignment(std::string_view text) {
  std::set<int> compared;
  std::set<int> assigned;
  syntax::each_tree(text, [&](const syntax::LineTree& line, std::string_view) {
    if (line.jump != nullptr && line.jump->condition_is_known() && line.jump->variable > 0)
      compared.insert(line.jump->variable);
    for (const syntax::Instruction& instruction : line.instructions)
      if (instruction.kind == syntax::InstructionKind::Assignment)
        if (const auto value = execution::assigned_by(instruction, line)) assigned.insert(value->reg);
  });
  std::set<int> without;
  std::set_difference(compared.begin(), compared.end(), assigned.begin(), assigned.end(),
                      std::inserter(without, without.end()));
  return without;
}

/// What the program expects: registers, and the values of VGPL with the path of each.
void add_paths(sheet::SheetSubject subject, const simulation::TakenPath& first, sheet::Sheet& sheet) {
  selection::VgplValues values(subject.text);
  std::set<int> registers = registers_without_assignment(subject.text);
  simulation::TakenPath path = first;
  while (true) {
    for (const int each : values.unassigned_registers(path)) registers.insert(each);
    const std::string words = values.in_words(values.cells_along(path));
    // One path for all values is none that is worth a word.
    if (!words.empty()) sheet::add_path(sheet, subject, words);
    values.take(path);
    const std::optional<double> next = values.next();
    sheet.has_other_paths = next.has_value();
    if (!next || sheet.paths.size() == selection::kMaxVerifiedPaths) break;
    subject.run.vgpl = *next;
    path = verification::verified_run(subject.text, subject.run, subject.machine.timed, nullptr).outcome.runs.front();
  }
  sheet.registers.assign(registers.begin(), registers.end());
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
