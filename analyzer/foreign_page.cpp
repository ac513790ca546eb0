#include "analyzer/foreign_page.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/examples.h"
#include "analyzer/fixing/finding_fixes.h"
#include "analyzer/selection/suppressions.h"

namespace isocnc::analyzer {

using dialect::ExamplePlace;
using dialect::ForeignControl;
using dialect::ForeignForm;
using dialect::Language;
using dialect::Text;

std::string foreign_example(const ForeignForm& form, std::string_view lines) {
  static constexpr std::string_view kChange = "M06 T101001\n";
  static constexpr std::string_view kBegin = "S12000 M03\nG00 X0 Y0 Z50\nG01 Z5 F1000\n";
  std::string program;
  if (form.place == ExamplePlace::Start) program += lines.empty() ? "" : fmt::format("{}\n", lines);
  program += form.place == ExamplePlace::Change ? fmt::format("{}\n", lines) : kChange;
  program += kBegin;
  if (form.place == ExamplePlace::Middle) program += lines.empty() ? "" : fmt::format("{}\n", lines);
  program += "M05\n";
  return program + (form.place == ExamplePlace::End ? fmt::format("{}\n", lines) : "M02\n");
}

/// The fix of a form's example, if it has one.
static std::optional<fixes::Fix> fix_of_example(const ForeignForm& form) {
  const MarkedProgram program = read_marked(foreign_example(form, form.written));
  const rules::CheckSetup setup;
  const check::Report report = selection::suppress(check::check_text(program.text, setup), program.text, {});
  fixing::FindingFixes fixes(program.text, report, setup);
  for (const check::LocatedFinding& located : report.findings)
    if (located.line == program.line && located.finding.id == form.diagnostics[0]) return fixes.offered(located);
  return std::nullopt;
}

/// Lines of a program in a cell of a table.
static std::string code(std::string_view lines) {
  const std::string text = read_marked(lines).text;
  std::string cell;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    cell += fmt::format("{}`{}`", at > 0 ? "<br>" : "", text.substr(at, end - at));
    at = end + 1;
  }
  return cell;
}

/// The link to a code's section on the page of codes in the same language.
static std::string link(dialect::DiagnosticId id, Language language) {
  static constexpr Text kPage = {"rules.md", "codici.md"};
  const dialect::DiagnosticDef& def = dialect::definition(id);
  std::string anchor = fmt::format("{}-{}", def.code, def.name);
  std::transform(anchor.begin(), anchor.end(), anchor.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return fmt::format("[{}]({}#{})", def.code, kPage.in(language), anchor);
}

static std::string row(const ForeignForm& form, Language language) {
  static constexpr Text kFix = {", fix", ", correzione"};
  static constexpr Text kUnsafeFix = {", unsafe fix", ", correzione non sicura"};
  std::string found;
  if (!form.runs_here()) {
    found = link(form.diagnostics[0], language);
    if (const std::optional<fixes::Fix> fix = fix_of_example(form))
      found += (fix->safety == fixes::Safety::Safe ? kFix : kUnsafeFix).in(language);
  }
  return fmt::format("| {} | {} | {} | {} |{}\n", code(form.written), form.there.in(language), form.here.in(language),
                     code(form.instead), form.runs_here() ? "" : fmt::format(" {} |", found));
}

/// The forms of a control that this control runs, or those that it does not, as a table; empty without any.
static std::string table_of(ForeignControl control, bool that_run, Language language) {
  static constexpr Text kHead = {
      "| Written there | What it does there | What holds here | Written here | `isolint` |\n|---|---|---|---|---|\n",
      "| Scritto là | Che cosa fa là | Che cosa vale qui | Scritto qui | `isolint` |\n|---|---|---|---|---|\n"};
  static constexpr Text kHeadOfRunning = {
      "| Written there | What it does there | What it does here | Written here |\n|---|---|---|---|\n",
      "| Scritto là | Che cosa fa là | Che cosa fa qui | Scritto qui |\n|---|---|---|---|\n"};
  std::string rows;
  for (const ForeignForm& form : dialect::foreign_forms())
    if ((form.controls & bit(control)) != 0 && form.runs_here() == that_run && !form.written.empty())
      rows += row(form, language);
  if (rows.empty()) return {};
  return std::string((that_run ? kHeadOfRunning : kHead).in(language)) + rows;
}

std::string foreign_page(Language language) {
  static constexpr Text kIntroduction = {
      "# From another control\n\n"
      "What programs for other controls write, and this control reads otherwise or not at all. `isolint` reports each "
      "of these words or lines\n"
      "once, says what was meant there, and what to write here. ([In italiano](it/altri-controlli.md))\n\n"
      "Each control has two tables. The first one matters most: its words run here, with another meaning, so that no "
      "finding warns of them.\n"
      "\"Fix\" means that `isolint --fix` writes it, \"unsafe fix\" that `--unsafe-fixes` is needed, too: look at the "
      "result with `--diff` first. The whole\n"
      "language is in [the dialect](dialect.md). [`isofmt --from`](isofmt.md#programs-of-other-controls) translates "
      "whole programs of Fanuc, LinuxCNC and Grbl.\n\n"
      "This page is made from the table in `interpreter/dialect/foreign_form_table.cpp` (`isolint --foreign-page`).\n",
      "# Da un altro controllo\n\n"
      "Che cosa si scrive nei programmi di altri controlli, e che questo controllo legge in altro modo o non legge "
      "affatto. `isolint` segnala ognuna di\n"
      "queste parole o linee una volta sola, dice che cosa si intendeva là e che cosa scrivere qui. "
      "([In English](../other-controls.md))\n\n"
      "Ogni controllo ha due tabelle. La prima conta di più: le sue parole qui girano, ma con un altro significato, e "
      "nessuna segnalazione avvisa.\n"
      "\"Correzione\" vuol dire che la scrive `isolint --fix`, \"correzione non sicura\" che serve anche "
      "`--unsafe-fixes`: guardare prima il risultato con\n"
      "`--diff`. Il linguaggio intero è nel [dialetto](dialetto.md). "
      "[`isofmt --from`](isofmt.md#programmi-di-altri-controlli) traduce programmi interi di Fanuc, LinuxCNC e "
      "Grbl.\n\n"
      "Questa pagina nasce dalla tabella in `interpreter/dialect/foreign_form_table.cpp` "
      "(`isolint --lang it --foreign-page`).\n"};
  static constexpr Text kRuns = {"Runs here, and means something else:", "Qui gira, e vuol dire un'altra cosa:"};
  static constexpr Text kStops = {"Stops here:", "Qui ferma il programma:"};
  static constexpr Text kTitles[] = {{"Fanuc", "Fanuc"},
                                     {"Siemens, in its own and in ISO language", "Siemens, in linguaggio suo e ISO"},
                                     {"Heidenhain, DIN/ISO and conversational", "Heidenhain, DIN/ISO e colloquiale"},
                                     {"LinuxCNC", "LinuxCNC"},
                                     {"Mach", "Mach"}};
  std::string page(kIntroduction.in(language));
  for (std::size_t i = 0; i < dialect::kForeignControlCount; ++i) {
    page += fmt::format("\n## {}\n", kTitles[i].in(language));
    for (const bool that_run : {true, false}) {
      const std::string table = table_of(static_cast<ForeignControl>(i), that_run, language);
      if (!table.empty()) page += fmt::format("\n{}\n\n{}", (that_run ? kRuns : kStops).in(language), table);
    }
  }
  return page;
}

}  // namespace isocnc::analyzer
