#include "interpreter/sheet/document.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/sheet/path_view.h"
#include "interpreter/summary/summary.h"

namespace isocnc::sheet {

using dialect::Language;
using dialect::Text;
using geometry::Range;
using verification::BodyRole;

namespace {

constexpr Text kTitle{"Setup sheet", "Scheda di attrezzaggio"};
constexpr Text kPage{"page {} of {}", "pagina {} di {}"};
constexpr Text kProgram{"Program", "Programma"};
constexpr Text kProgramLines{"{}, {} lines", "{}, {} righe"};
constexpr Text kProgramLine{"{}, 1 line", "{}, 1 riga"};
constexpr Text kRunWith{"Run with", "Eseguito con"};
constexpr Text kUnits{"Units", "Unità"};
constexpr Text kUnitsInForce{
    "mm, mm/min and rev/min, also of blocks under G70; findings in inches say so",
    "mm, mm/min e giri/min, anche dei blocchi sotto G70; le segnalazioni in pollici lo dicono"};
constexpr Text kMachine{"Machine", "Macchina"};
constexpr Text kNoMachine{"none described: default times, no travel", "non descritta: tempi predefiniti, senza corse"};
constexpr Text kCycleTime{"Cycle time", "Tempo ciclo"};
constexpr Text kStopsThere{"The program does not come to its end: {}", "Il programma non arriva alla fine: {}"};
constexpr Text kAbove{"From above: X to the right, Y up", "Dall'alto: X a destra, Y in su"};
constexpr Text kFront{"From the front: X to the right, Z up", "Di fronte: X a destra, Z in su"};
constexpr Text kTools{"Tools, in the order of their use", "Utensili, in ordine d'uso"};
constexpr Text kTool{"Tool", "Utensile"};
constexpr Text kLength{"Length", "Lunghezza"};
constexpr Text kDiameter{"Diameter", "Diametro"};
constexpr Text kSpeed{"S", "S"};
constexpr Text kFeed{"F", "F"};
constexpr Text kLeastZ{"Lowest Z", "Z minima"};
constexpr Text kTime{"Time", "Tempo"};
constexpr Text kUses{"Uses", "Usi"};
constexpr Text kNoTools{"No tool is mounted.", "Non si monta nessun utensile."};
constexpr Text kNoToolsYet{"No tool is mounted before the program stops: {}",
                           "Non si monta nessun utensile prima che il programma si fermi: {}"};
constexpr Text kZeros{"Zero points, and the room that the tip takes from them",
                      "Zeri, e ingombro della punta da ciascuno"};
constexpr Text kZero{"Zero", "Zero"};
constexpr Text kZeroOfLine{"{}  G92, line {}", "{}  G92, riga {}"};
constexpr Text kFaceOfLine{"face, line {}", "faccia, riga {}"};
constexpr Text kInMachine{"In the machine", "In macchina"};
constexpr Text kNoZeros{"The program sets no zero point: it counts from the machine's.",
                        "Il programma non imposta uno zero: conta da quello della macchina."};
constexpr Text kNoMotion{"Nothing moves from a zero point.", "Nulla si muove da uno zero."};
constexpr Text kNoMotionYet{"Nothing moves from a zero point before the program stops: {}",
                            "Nulla si muove da uno zero prima che il programma si fermi: {}"};
constexpr Text kMachineZero{"machine", "macchina"};
constexpr Text kMoreZeros{"and {} more", "e altri {}"};
constexpr Text kSetup{"On the table, from the first zero of the program ({} in the machine)",
                      "Sulla tavola, dal primo zero del programma ({} in macchina)"};
constexpr Text kSetupInMachine{"On the table, from the machine's zero", "Sulla tavola, dallo zero macchina"};
constexpr Text kBelow{"below {}", "sotto {}"};
constexpr Text kBody{"What", "Che cosa"};
constexpr Text kSize{"Size", "Misure"};
constexpr Text kBlank{"blank", "grezzo"};
constexpr Text kFixture{"fixture", "attrezzatura"};
constexpr Text kTarget{"finished part", "pezzo finito"};
constexpr Text kSpoilboard{"spoilboard", "martire"};
constexpr Text kExpects{"What the program expects", "Che cosa si aspetta il programma"};
constexpr Text kRegisters{"Registers that an IF compares and the program does not set",
                          "Registri che un IF confronta e il programma non imposta"};
constexpr Text kOnlyWith{"only with {}", "solo con {}"};
constexpr Text kOtherVgpl{"other values of VGPL", "altri valori di VGPL"};
constexpr Text kNotRun{"not run", "non eseguiti"};
constexpr Text kFindings{"Findings", "Segnalazioni"};
constexpr Text kMoreFindings{"{} more: isolint shows all of them.", "Altre {}: isolint le mostra tutte."};
constexpr Text kNoFindings{"None.", "Nessuna."};
constexpr Text kLine{"Line", "Riga"};
constexpr Text kCode{"Code", "Codice"};
constexpr Text kMessage{"Message", "Messaggio"};
constexpr Text kNothing{"Nothing: no M functions of the user, no registers, no VGPL.",
                        "Niente: nessuna funzione M dell'utente, nessun registro, nessuna VGPL."};
constexpr Text kNothingYet{"Nothing before the program stops: {}", "Niente prima che il programma si fermi: {}"};
constexpr Text kSetUpBy{"Set up by", "Attrezzato da"};
constexpr Text kDate{"Date", "Data"};
constexpr Text kCheckedBy{"Checked by", "Controllato da"};

std::string worded(const Text& text, Language language) { return std::string(text.in(language)); }

std::string number(double value, int decimals = 3) { return dialect::written_number(value, decimals); }

std::string shown(const Range& range, int decimals = 3) {
  const std::string least = number(range.minimum, decimals);
  const std::string greatest = number(range.maximum, decimals);
  return least == greatest ? least : least + " … " + greatest;
}

/// A range of speeds or feeds: whole numbers, unless they are small.
std::string shown_rate(const Range& range) {
  constexpr double kSmall = 10;
  return shown(range, range.minimum < kSmall ? 3 : 0);
}

/// Of both directions: `12000; 8000 M04`.
std::string shown_speeds(const SheetTool& tool) {
  std::string speeds = tool.speed.maximum > 0 ? shown_rate(tool.speed) : "";
  if (tool.left_speed.maximum > 0) speeds += (speeds.empty() ? "" : "; ") + shown_rate(tool.left_speed) + " M04";
  return speeds.empty() ? "–" : speeds;
}

std::string shown(const std::optional<double>& value) { return value ? number(*value) : "–"; }

std::string position(const geometry::Vec3& place) {
  return fmt::format("X{} Y{} Z{}", number(place.x()), number(place.y()), number(place.z()));
}

/// ` (only with VGPL = 2)`; empty for no values.
std::string only_with(const std::string& values, Language language) {
  return values.empty() ? "" : fmt::format(" ({})", dialect::format(kOnlyWith, language, values));
}

Table tools_table(const Sheet& sheet, Language language) {
  Table table{{{"", 1, false},
               {worded(kTool, language), 4.4, false},
               {worded(kLength, language), 1.5, true},
               {worded(kDiameter, language), 1.4, true},
               {worded(kSpeed, language), 2, true},
               {worded(kFeed, language), 2, true},
               {worded(kLeastZ, language), 1.5, true},
               {worded(kUses, language), 0.9, true},
               {worded(kTime, language), 2.1, true}},
              {}};
  for (std::size_t i = 0; i < sheet.tools.size(); ++i) {
    const SheetTool& tool = sheet.tools[i];
    const std::string name = running::tool_name(tool.code);
    table.rows.push_back({{"", tool.picture.lines.empty() ? nullptr : &tool.picture},
                          {name + (tool.name.empty() ? "" : " " + tool.name) + only_with(tool.values, language),
                           nullptr, stroke_of_tool(i)},
                          {shown(tool.length)},
                          {tool.radius ? number(2 * *tool.radius) : "–"},
                          {shown_speeds(tool)},
                          {tool.least_z ? shown_rate(tool.feed) : "–"},
                          {shown(tool.least_z)},
                          {fmt::format("{}", tool.uses)},
                          {summary::shown_time(tool.seconds)}});
  }
  return table;
}

void append_room(std::vector<TableCell>& row, const std::array<Range, 3>& room) {
  for (const Range& range : room) row.push_back({shown(range)});
}

Table zeros_table(const Sheet& sheet, Language language) {
  Table table{{{worded(kZero, language), 2.6, false},
               {worded(kInMachine, language), 3.4, false},
               {"X", 2.2, true},
               {"Y", 2.2, true},
               {"Z", 2.2, true}},
              {}};
  std::size_t workpieces = 0;
  if (sheet.machine_room) {
    std::vector<TableCell> row{{worded(kMachineZero, language)}, {position(geometry::Vec3::Zero())}};
    append_room(row, *sheet.machine_room);
    table.rows.push_back(std::move(row));
  }
  for (const summary::FrameExtents& frame : sheet.frames) {
    std::vector<TableCell> row;
    row.push_back({frame.is_face ? dialect::format(kFaceOfLine, language, frame.line + 1)
                                 : dialect::format(kZeroOfLine, language, ++workpieces, frame.line + 1)});
    row.push_back({position(frame.frame.origin)});
    append_room(row, frame.extents);
    table.rows.push_back(std::move(row));
  }
  if (sheet.frames_left_out > 0)
    table.rows.push_back({{dialect::format(kMoreZeros, language, sheet.frames_left_out)}, {}, {}, {}, {}});
  return table;
}

const Text& name_of(BodyRole role) {
  switch (role) {
    case BodyRole::Stock:
      return kBlank;
    case BodyRole::Target:
      return kTarget;
    case BodyRole::Spoilboard:
      return kSpoilboard;
    case BodyRole::Fixture:
    case BodyRole::Machine:
      break;
  }
  return kFixture;
}

Table setup_table(const Sheet& sheet, Language language) {
  Table table{{{worded(kBody, language), 3.2, false},
               {"X", 2.2, true},
               {"Y", 2.2, true},
               {"Z", 2.2, true},
               {worded(kSize, language), 2.8, true}},
              {}};
  for (const BodyRole role : {BodyRole::Stock, BodyRole::Target, BodyRole::Spoilboard, BodyRole::Fixture})
    for (const SheetBody& body : sheet.bodies) {
      if (body.role != role) continue;
      const std::string kind(name_of(role).in(language));
      const bool is_named = role == BodyRole::Fixture && !body.name.empty();
      std::vector<TableCell> row{{is_named ? body.name : kind}};
      if (body.is_endless) {
        for (const char* const text : {"", ""}) row.push_back({text});
        row.push_back({dialect::format(kBelow, language, number(body.room[2].maximum))});
        row.push_back({""});
        table.rows.push_back(std::move(row));
        continue;
      }
      append_room(row, body.room);
      const auto size = [&](std::size_t axis) { return number(body.room[axis].maximum - body.room[axis].minimum); };
      row.push_back({fmt::format("{} × {} × {}", size(0), size(1), size(2))});
      table.rows.push_back(std::move(row));
    }
  return table;
}

NamedValues expected(const Sheet& sheet, Language language) {
  NamedValues facts;
  for (const SheetFunction& each : sheet.functions)
    facts.rows.emplace_back(fmt::format("M{}{}{}", each.number, each.name.empty() ? "" : " ", each.name),
                            fmt::format("{}×{}", each.calls, only_with(each.values, language)));
  std::string registers;
  for (const int each : sheet.registers) registers += fmt::format("{}V{}", registers.empty() ? "" : ", ", each);
  if (!registers.empty()) facts.rows.emplace_back(kRegisters.in(language), registers);
  for (const SheetPath& path : sheet.paths)
    facts.rows.emplace_back(path.values,
                            summary::shown_time(path.seconds) + (path.stop.empty() ? "" : "; " + path.stop));
  if (sheet.has_other_paths) facts.rows.emplace_back(worded(kOtherVgpl, language), worded(kNotRun, language));
  return facts;
}

/// Those of a hopeless program would fill a book.
constexpr std::size_t kMaxFindings = 100;

Table findings_table(const Sheet& sheet, Language language) {
  Table table{{{worded(kLine, language), 0.9, true},
               {worded(kCode, language), 1.2, false, true},
               {worded(kMessage, language), 9, false}},
              {}};
  const std::size_t count = std::min(sheet.findings.size(), kMaxFindings);
  for (const SheetFinding& each : std::span(sheet.findings).first(count))
    table.rows.push_back({{fmt::format("{}", each.line + 1)},
                          {each.code},
                          {fmt::format("{}: {}", dialect::severity_name(each.severity, language), each.message)}});
  return table;
}

}  // namespace

SheetDocument document_of(const Sheet& sheet, Language language) {
  SheetDocument document{worded(kTitle, language), sheet.program, worded(kPage, language), {}};
  const auto add = [&](DocumentBlock block) { document.blocks.push_back(std::move(block)); };
  const auto head = [&](const Text& text) { add(Heading{std::string(text.in(language))}); };
  // A program that stops may do later what it has not done so far.
  const auto nothing = [&](const Text& in_all, const Text& before_stop) {
    add(Paragraph{sheet.stop.empty() ? worded(in_all, language) : dialect::format(before_stop, language, sheet.stop)});
  };
  NamedValues facts;
  const auto fact = [&](const Text& name, std::string value) {
    facts.rows.emplace_back(name.in(language), std::move(value));
  };
  fact(kProgram, sheet.lines == 1 ? dialect::format(kProgramLine, language, sheet.program)
                                  : dialect::format(kProgramLines, language, sheet.program, sheet.lines));
  facts.rows.emplace_back("SHA-256", sheet.hash);
  fact(kMachine, sheet.machine.empty() ? worded(kNoMachine, language) : sheet.machine);
  if (!sheet.values.empty() || !sheet.paths.empty()) fact(kRunWith, sheet.values.empty() ? "VGPL = 0" : sheet.values);
  fact(kCycleTime, summary::shown_time(sheet.seconds));
  fact(kUnits, worded(kUnitsInForce, language));
  add(std::move(facts));
  if (!sheet.stop.empty()) add(Paragraph{dialect::format(kStopsThere, language, sheet.stop), true});
  if (!sheet.from_above.lines.empty())
    add(Drawings{{{&sheet.from_above, worded(kAbove, language)}, {&sheet.from_front, worded(kFront, language)}}});
  head(kTools);
  sheet.tools.empty() ? nothing(kNoTools, kNoToolsYet) : add(tools_table(sheet, language));
  head(kZeros);
  sheet.frames.empty() && !sheet.machine_room ? nothing(sheet.first_zero ? kNoMotion : kNoZeros, kNoMotionYet)
                                              : add(zeros_table(sheet, language));
  if (!sheet.bodies.empty()) {
    add(Heading{sheet.first_zero ? dialect::format(kSetup, language, position(*sheet.first_zero))
                                 : worded(kSetupInMachine, language)});
    add(setup_table(sheet, language));
  }
  head(kExpects);
  NamedValues expects = expected(sheet, language);
  expects.rows.empty() ? nothing(kNothing, kNothingYet) : add(std::move(expects));
  head(kFindings);
  sheet.findings.empty() ? add(Paragraph{worded(kNoFindings, language)}) : add(findings_table(sheet, language));
  if (sheet.findings.size() > kMaxFindings)
    add(Paragraph{dialect::format(kMoreFindings, language, sheet.findings.size() - kMaxFindings)});
  add(Blanks{{worded(kSetUpBy, language), worded(kDate, language), worded(kCheckedBy, language)}});
  return document;
}

}  // namespace isocnc::sheet
