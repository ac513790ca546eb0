#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "interpreter/configuration/read.h"
#include "interpreter/tool_library/columns.h"
#include "interpreter/tool_library/new_machine.h"
#include "interpreter/tool_library/read_library.h"
#include "interpreter/tool_library/tool_import.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::tool_library {
namespace {

using configuration::MachineConfiguration;
using dialect::Language;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::string_view_literals;

Library read(const std::string& name, std::string_view text) {
  return read_library_text(name, std::string(text), false, Language::English);
}

MachineConfiguration machine_of(std::string_view text) {
  const auto read = configuration::read_configuration(text, "/shop");
  EXPECT_THAT(read.mistakes, IsEmpty());
  return read.configuration.machine;
}

/// Where the tools of a library stand: number or name, and place.
ToolMap map_of(const std::vector<std::pair<std::string, int>>& places) {
  ToolMap map;
  for (const auto& [key, place] : places) map.places.emplace(key, execution::tool_code(place));
  return map;
}

/// The import as people see it, or why it is refused.
std::string shown(const MachineConfiguration& machine, const Library& library, const ToolMap& map) {
  EXPECT_THAT(library.mistakes, IsEmpty());
  const auto import = import_tools(machine, library, {.map = map});
  if (const auto* const why = std::get_if<std::string>(&import)) return *why;
  return shown_import(std::get<ToolImport>(import), Language::English);
}

/// What is wrong with a library as a whole, and with its tools.
std::vector<std::string> mistakes_of(const Library& library) {
  std::vector<std::string> mistakes = library.mistakes;
  for (const LibraryTool& tool : library.tools)
    mistakes.insert(mistakes.end(), tool.mistakes.begin(), tool.mistakes.end());
  return mistakes;
}

/// A library with one tool, in the words of its program, and what comes in at T101001. The lengths are computed by hand
/// from the meaning of the library's own names.
struct Case {
  std::string name;
  std::string file;
  std::string text;
  std::string expected;
};

class ReadsTools : public testing::TestWithParam<Case> {};

TEST_P(ReadsTools, InTheWordsOfTheirProgram) {
  const Library library = read(GetParam().file, GetParam().text);
  EXPECT_EQ(shown({}, library, map_of({{"1", 101001}, {"mill", 101001}})).substr(0, GetParam().expected.size()),
            GetParam().expected);
}

std::string fusion(std::string_view type, std::string_view geometry, std::string_view more = "") {
  return R"({"data": [{"description": "mill", "unit": "millimeters", "type": ")" + std::string(type) +
         R"(", "geometry": {)" + std::string(geometry) + R"(}, "post-process": {"number": 5})" + std::string(more) +
         "}]}";
}

std::string freecad(std::string_view shape, std::string_view parameters) {
  return R"({"version": 2, "name": "mill", "shape": ")" + std::string(shape) + R"(.fcstd", "parameter": {)" +
         std::string(parameters) + "}}";
}

INSTANTIATE_TEST_SUITE_P(
    Programs, ReadsTools,
    testing::Values(
        Case{"fusion_flat", "a.json",
             fusion("flat end mill", R"("DC": 20, "LCF": 40, "SFDM": 18, "assemblyGaugeLength": 110)"),
             "+ T101001 \"mill\": length 110, radius 10, shape \"flat\", cutLength 40, shank 18\n"},
        Case{"fusion_ball", "a.json", fusion("ball end mill", R"("DC": 6, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 3, shape \"ball\"\n"},
        Case{"fusion_bull", "a.json", fusion("bull nose end mill", R"("DC": 12, "RE": 1.5, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 6, shape \"bull\", cornerRadius 1.5\n"},
        Case{"fusion_bull_without_corner", "a.json",
             fusion("bull nose end mill", R"("DC": 12, "RE": 0, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 6, shape \"flat\"\n"},
        Case{"fusion_drill", "a.json", fusion("drill", R"("DC": 8, "SIG": 118, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 4, shape \"drill\", tipAngle 118\n"},
        // TA is the angle to the axis; half of what V bits are called by.
        Case{"fusion_chamfer", "a.json", fusion("chamfer mill", R"("DC": 12, "TA": 45, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 6, shape \"cone\", tipAngle 90\n"},
        Case{"fusion_blunt_chamfer", "a.json",
             fusion("chamfer mill", R"("DC": 12, "TA": 45, "tip-diameter": 2, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 6, profile [[0, 1], [5, 6]]\n"},
        Case{"fusion_taper", "a.json",
             fusion("tapered mill", R"("DC": 2, "TA": 45, "LCF": 10, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 11, profile [[0, 1], [10, 11]], cutLength 10\n"},
        Case{"fusion_slot", "a.json",
             fusion("slot mill", R"("DC": 60, "LCF": 4, "SFDM": 16, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 30, shape \"disc\", cutLength 4, shank 16\n"},
        Case{"fusion_dovetail", "a.json", fusion("dovetail mill", R"("DC": 12, "assemblyGaugeLength": 80)"),
             "+ T101001 \"mill\": length 80, radius 6\n    no shape is known for what the library calls dovetail "
             "mill\n"},
        // 1 in of holder below the gauge line of 30 mm, with 20 mm more than that inside the spindle; the tool in
        // inches.
        Case{
            "fusion_holder", "a.json",
            R"({"data": [{"description": "mill", "unit": "inches", "type": "flat end mill", "geometry": {"DC": 0.5, "LB": 2}, "post-process":
             {"number": 1}, "holder": {"description": "ER", "unit": "millimeters", "gaugeLength": 30, "segments": [
             {"height": 20, "lower-diameter": 30, "upper-diameter": 40}, {"height": 20, "lower-diameter": 40, "upper-diameter": 60}]}}]})",
            "+ holder \"ER\": [[20, 30, 40], [10, 40, 50]]\n"
            "+ T101001 \"mill\": length 80.8, radius 6.35, shape \"flat\", body \"ER\"\n"},
        Case{"fusion_without_length", "a.json", fusion("flat end mill", R"("DC": 20, "LCF": 40)"),
             "+ T101001 \"mill\": radius 10, cutLength 40\n    its shape is left out, since its length from the "
             "spindle nose is not known\n"},
        Case{"freecad_end_mill", "a.fctb",
             freecad("endmill", R"("Diameter": "5.0000 mm", "CuttingEdgeHeight": "30,0 mm", "Length": "50 mm")"),
             "+ T101001 \"mill\": radius 2.5, cutLength 30\n"},
        Case{"freecad_inches", "a.fctb", freecad("endmill", R"("Diameter": "0.2500 in")"),
             "+ T101001 \"mill\": radius 3.175\n"},
        Case{
            "camotics", "a.json",
            R"({"1": {"units": "metric", "shape": "cylindrical", "length": 20, "diameter": 3, "description": "mill"}})",
            "+ T101001 \"mill\": radius 1.5, cutLength 20\n"},
        Case{
            "camotics_project", "a.camotics",
            R"({"units": "metric", "tools": {"1": {"units": "imperial", "shape": "ballnose", "length": 1, "diameter": 0.5}}})",
            "+ T101001: radius 6.35, cutLength 25.4\n"},
        Case{"linuxcnc", "a.tbl", "; a table\nT1 P2 D+6.350 Z+40.5 ;mill\n",
             "+ T101001 \"mill\": length 40.5, radius 3.175\n"},
        Case{"linuxcnc_offset_from_another_tool", "a.tbl", "T1 P2 D6 Z-3 ;mill\n", "+ T101001 \"mill\": radius 3\n"},
        Case{"csv", "a.csv", "T,name,length,diameter,shape\nT101001,mill,100,20,flat\n",
             "+ T101001 \"mill\": length 100, radius 10, shape \"flat\"\n"},
        Case{"csv_italian", "a.csv",
             "\xEF\xBB\xBFtesta;portautensile;utensile;nome;lunghezza (mm);raggio\r\n1;1;1;\"a;b\"\"c\";100,5;10\r\n",
             "+ T101001 \"a;b\\\"c\": length 100.5, radius 10\n"},
        Case{"csv_tabs_inches", "a.tsv", "number\tname\tlength\tradius\tunit\n1\tmill\t4\t0.5\tinch\n",
             "+ T101001 \"mill\": length 101.6, radius 12.7\n"},
        Case{"csv_of_windows", "a.csv", "T;nome\nT101001;citt\xE0\n", "+ T101001 \"citt\xC3\xA0\"\n"},
        Case{"csv_with_a_euro", "a.csv", "T;nome\nT101001;5 \x80\n", "+ T101001 \"5 \xE2\x82\xAC\"\n"},
        Case{"csv_in_inches", "a.csv", "T,length (inch),diameter[mm]\nT101001,4,20\n",
             "+ T101001: length 101.6, radius 10\n"},
        Case{"presetter", "a.csv",
             "T;nome;lunghezza;raggio;lunghezza misurata;raggio misurato\nT101001;mill;100;10;99,87;9,98\n",
             "+ T101001 \"mill\": length 99.87, radius 9.98\n"}),
    [](const auto& tested) { return tested.param.name; });

// FreeCAD's shapes need a length that it does not know: the machine has it.
TEST(ToolImport, TakesTheLengthOfTheMachine) {
  const MachineConfiguration machine = machine_of(
      R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "name": "mill", "length": 100, "radius": 3}]}})");
  const auto imported = [&](std::string_view shape, std::string_view parameters) {
    return shown(machine, read("a.fctb", freecad(shape, parameters)), map_of({{"mill", 101001}}));
  };
  EXPECT_THAT(imported("endmill", R"("Diameter": "6 mm")"), HasSubstr("~ T101001 \"mill\": shape \"flat\"\n"));
  EXPECT_THAT(imported("ballend", R"("Diameter": "6 mm")"), HasSubstr("~ T101001 \"mill\": shape \"ball\"\n"));
  EXPECT_THAT(imported("bullnose", R"("Diameter": "6 mm", "CornerRadius": "1 mm")"),
              HasSubstr("shape \"bull\", cornerRadius 1\n"));
  // The name says the radius of the flat, FreeCAD takes it for that of the corner: both are 1.5 mm.
  EXPECT_THAT(imported("bullnose", R"("Diameter": "6 mm", "FlatRadius": "1.5 mm")"),
              HasSubstr("shape \"bull\", cornerRadius 1.5\n"));
  EXPECT_THAT(imported("bullnose", R"("Diameter": "8 mm", "FlatRadius": "1 mm")"),
              HasSubstr("no shape is known for what the library calls bullnose"));
  EXPECT_THAT(imported("drill", R"("Diameter": "6 mm", "TipAngle": "119 °")"),
              HasSubstr("shape \"drill\", tipAngle 119\n"));
  EXPECT_THAT(imported("v-bit", R"("Diameter": "6 mm", "CuttingEdgeAngle": "90 °")"),
              HasSubstr("shape \"cone\", tipAngle 90\n"));
  EXPECT_THAT(imported("v-bit", R"("Diameter": "6 mm", "CuttingEdgeAngle": "90 °", "TipDiameter": "2 mm")"),
              HasSubstr("profile [[0, 1], [2, 3]]\n"));
  EXPECT_THAT(imported("slittingsaw", R"("Diameter": "60 mm", "BladeThickness": "3 mm", "ShankDiameter": "19 mm")"),
              HasSubstr("radius 3 -> 30, shape \"disc\", cutLength 3, shank 19\n"));
  EXPECT_THAT(imported("probe", R"("Diameter": "6 mm")"), HasSubstr("0 new, 0 changed, 1 as before"));
}

TEST(ToolImport, ReadsALibraryOfFreeCad) {
  const support::TemporaryFolder folder;
  folder.write("Bit/mill.fctb", freecad("endmill", R"("Diameter": "6 mm")"));
  folder.write("Library/drill.fctb", freecad("drill", R"("Diameter": "5 mm")"));
  const std::string library =
      folder.write("Library/shop.fctl",
                   R"({"version": 1, "tools": [{"nr": 4, "path": "mill.fctb"}, {"nr": 7, "path": "drill.fctb"}]})");
  const Library read = read_library(library, false, Language::English);
  ASSERT_EQ(read.tools.size(), 2U);
  EXPECT_EQ(read.tools[0].number, "4");
  EXPECT_EQ(read.tools[0].tool.radius, 3);
  EXPECT_EQ(read.tools[1].number, "7");
  const std::string cyclic = folder.write(
      "Library/cyclic.fctl", R"({"tools": [{"nr": 1, "path": "cyclic.fctl"}, {"nr": 2, "path": "none.fctb"}]})");
  EXPECT_THAT(
      mistakes_of(read_library(cyclic, false, Language::English)),
      ElementsAre(
          HasSubstr("cyclic.fctl:1:12: error: tools[0].path: cyclic.fctl is no tool of FreeCAD: .fctb is needed"),
          HasSubstr("tools[1].path: none.fctb is neither beside the library nor in ../Bit")));
}

/// A library that cannot be right, and what is said of it.
struct Broken {
  std::string file;
  std::string text;
  std::string mistake;
};

TEST(ToolImport, RefusesBrokenLibraries) {
  const Broken broken[] = {
      {"a.json", R"({"data": [)", "a.json:1:11: error: the file ends here"},
      {"a.json", R"({"tools": 3})", "a.json:1:1: error: neither a library of Fusion"},
      {"a.json", R"([1])", "a.json:1:1: error: an object in braces is needed here"},
      {"a.json", R"({"data": {}})", "a.json:1:10: error: data: a list in brackets"},
      {"a.json", R"({"data": [7]})", "data[0]: an object in braces"},
      {"a.json", R"({"data": [{"unit": "furlongs"}]})",
       "a.json:1:20: error: data[0].unit: furlongs is no unit known here: millimeters, inches"},
      {"a.json", fusion("drill", R"("DC": -3)"), "data[0].geometry.DC: -3 is no length of a tool"},
      {"a.json", fusion("drill", R"("DC": "6 mm")"), "data[0].geometry.DC: 6 mm is a text: a number alone"},
      {"a.json", fusion("drill", R"("SIG": "118")"), "data[0].geometry.SIG: 118 is a text: a number alone"},
      {"a.json", fusion("drill", R"("DC": 1e300)"), "data[0].geometry.DC: 1e+300 is no length of a tool"},
      {"a.json", fusion("drill", R"("SIG": 180)"), "data[0].geometry.SIG: 180 is no angle of a tool"},
      {"a.json", R"({"1": {"units": "cubits"}})", "1.units: cubits is no unit known here: metric, imperial"},
      {"a.fctb", freecad("endmill", R"("Diameter": "6 ells")"),
       "parameter.Diameter: ells is no unit known here: mm, cm"},
      {"a.fctb", freecad("endmill", R"("Diameter": "six")"), "parameter.Diameter: six is no length"},
      {"a.fctb", R"({"name": "x"})", "a.fctb:1:1: error: parameter: an object in braces"},
      {"a.tbl", "T1 D6\nT2 Rx\n", "a.tbl:2:4: error: Rx is no entry of a tool table"},
      {"a.tbl", "D6\n", "a.tbl:1:1: error: a line of a tool table needs a T"},
      {"a.csv", "", "the first line of a table names its columns"},
      {"a.csv", "1;2;3\n", "a.csv:1:1: error: the first line of a table names its columns"},
      {"a.csv", "T;length;lunghezza\n", "a.csv:1:10: error: two columns are called length"},
      {"a.csv", "T;length\nT101001;long\n", "a.csv:2:9: error: length: long is no number"},
      {"a.csv", "T;length\nT101001;-4\n", "a.csv:2:9: error: length: -4 is outside of what length may be"},
      {"a.csv", "T;shape\nT101001;round\n",
       "a.csv:2:9: error: shape: round is not one of flat, ball, bull, cone, drill, disc"},
      {"a.csv", "T;shape\n1;flat\n", "a.csv:2:1: error: T: 1 is no place of a tool"},
      {"a.csv", "T;shape\nT001001;flat\n", "T: T001001: a tool needs a holder, and a holder a head"},
      {"a.csv", "T;unit\nT101001;ell\n", "unit: ell is no unit known here: mm, inch"},
      {"a.csv", "T;name\nT101001;\"open\n", "a.csv:2:9: error: a quote without its closing one"},
      {"a.csv", "T;profile\nT101001;0 1 2\n", "profile: an outline is pairs of numbers"},
      {"a.csv", "T;length;radius\nT101001;100;4;25\n",
       "a.csv:2:15: error: a row with more cells than there are columns"},
      {"a.csv", "T;length (ell)\n", "a.csv:1:3: error: length: ell is no unit known here: mm, inch"},
      {"a.csv", "T,length (inch),diameter\nT101001,4.5,0.5\n",
       "a.csv:1:17: error: diameter: this heading has no unit, and length has one: give each length its unit"},
      {"a.csv", "T;head;length\n", "a.csv:1:1: error: the columns T and head say the same"},
      {"a.csv", "T;radius;diameter\n", "a.csv:1:1: error: the columns diameter and radius say the same"},
      {"a.tools", "PK", "a.tools: no archive that holds a tools.json, or a damaged one"},
      {"a.xml", "<tools/>", "a.xml: no library of tools by its name"},
  };
  for (const Broken& each : broken) {
    const std::vector<std::string> mistakes = mistakes_of(read(each.file, each.text));
    ASSERT_FALSE(mistakes.empty()) << each.text;
    EXPECT_THAT(mistakes.front(), HasSubstr(each.mistake)) << each.text;
  }
}

/// A library with a good tool at T101001, called good, and a mistaken one, and how the import shows the latter.
struct Mistaken {
  std::string file;
  std::string text;
  std::string shown;
};

TEST(ToolImport, TakesTheOthersWhereAnEntryIsMistaken) {
  const auto fusion_with = [](std::string_view other) {
    return fmt::format(
        R"({{"data": [{}, {{"description": "good", "unit": "millimeters", "type": "drill", "geometry": {{"DC": 6}}}}]}})",
        other);
  };
  const Mistaken libraries[] = {
      {"a.json", fusion_with("7"), "! not taken: a.json:1:11: error: data[0]: an object in braces is needed here\n"},
      {"a.json", fusion_with(R"({"description": "odd", "unit": "furlongs", "post-process": {"number": 8}})"),
       "! 8 odd: not taken: a.json:1:42: error: data[0].unit: furlongs is no unit known here: millimeters, inches\n"},
      {"a.json", fusion_with(R"({"description": "odd", "type": "drill", "geometry": {"DC": -3, "SIG": 200}})"),
       "! odd: not taken: a.json:1:70: error: data[0].geometry.DC: -3 is no length of a tool: above 0 and at most "
       "10000 "
       "mm\n    a.json:1:81: error: data[0].geometry.SIG: 200 is no angle of a tool: above 0 and below 180 degrees\n"},
      {"a.json", R"({"4": {"units": "cubits", "description": "odd"}, "5": {"diameter": 6, "description": "good"}})",
       "! 4 odd: not taken: a.json:1:17: error: 4.units: cubits is no unit known here: metric, imperial\n"},
      {"a.tbl", "T4 D6 Rx ;odd\nT5 D6 ;good\n",
       "! 4 odd: not taken: a.tbl:1:7: error: Rx is no entry of a tool table, such as T1, P1, D6 or Z40\n"},
      {"a.tbl", "D6 ;odd\nT5 D6 ;good\n",
       "! odd: not taken: a.tbl:1:1: error: a line of a tool table needs a T with a number\n"},
      {"a.csv", "T;name;radius\n101;odd;3\nT101001;good;3\n",
       "! odd: not taken: a.csv:2:1: error: T: 101 is no place of a tool: six digits for head, holder and tool, such "
       "as "
       "\"101001\"\n"},
      {"a.csv", "T;name;radius\nT101002;odd;3;4\nT101001;good;3\n",
       "! odd: not taken: a.csv:2:15: error: a row with more cells than there are columns; decimals with a comma need "
       "another separator\n"},
      {"a.csv", "T;name;radius\nT101001;good;3\nT101002;odd;three\n",
       "! odd: not taken: a.csv:3:13: error: radius: three is no number\n"},
  };
  for (const Mistaken& each : libraries) {
    const Library library = read(each.file, each.text);
    const std::string difference = shown({}, library, map_of({{"good", 101001}}));
    EXPECT_THAT(difference, HasSubstr("+ T101001 \"good\": radius 3\n")) << each.text;
    EXPECT_THAT(difference, HasSubstr(each.shown)) << each.text;
    EXPECT_THAT(difference, HasSubstr("1 new, 0 changed, 0 as before, 0 of the machine not in the library, 1 of the "
                                      "library not taken\n"));
    EXPECT_TRUE(
        has_mistaken_entry(std::get<ToolImport>(import_tools({}, library, {.map = map_of({{"good", 101001}})}))));
  }
  const Library unmapped = read("a.csv", "number;name;radius\n1;good;3\n2;other;4\n");
  EXPECT_FALSE(
      has_mistaken_entry(std::get<ToolImport>(import_tools({}, unmapped, {.map = map_of({{"good", 101001}})}))))
      << "a tool without a place is no mistake";
}

// The tool of the machine stays as it is, and is not called one that the library does not have.
TEST(ToolImport, LeavesTheToolOfAMistakenEntryAlone) {
  const MachineConfiguration machine = machine_of(
      R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "name": "mill", "length": 100, "radius": 3}]}})");
  const Library library = read("a.csv", "T;name;radius;length\nT101001;mill;4;long\nT101002;other;4;90\n");
  EXPECT_EQ(shown(machine, library, {}),
            "+ T101002 \"other\": length 90, radius 4\n"
            "! mill: not taken: a.csv:2:16: error: length: long is no number\n"
            "1 new, 0 changed, 0 as before, 0 of the machine not in the library, 1 of the library not taken\n");
}

TEST(ToolImport, RefusesWhatIsNotClear) {
  const Library twins = read("a.csv", "number;name;radius\n1;a;2\n1;b;3\n");
  EXPECT_EQ(shown({}, twins, map_of({{"1", 101001}})),
            "the map's 1 means 2 tools of the library: a, b; map them by their names");
  EXPECT_THAT(shown({}, twins, map_of({{"a", 101001}, {"b", 101002}})), HasSubstr("2 new"));
  // The name of one leaves the number to the other.
  EXPECT_THAT(shown({}, twins, map_of({{"a", 101001}, {"1", 101002}})), HasSubstr("+ T101002 \"b\": radius 3\n"));
  const Library copies = read("a.csv", "number;name;radius\n1;a;2\n2;a;2\n");
  EXPECT_EQ(shown({}, copies, map_of({{"a", 101001}})),
            "the map's a means 2 tools of the library; map them by their numbers: 1, 2");
  EXPECT_THAT(shown({}, copies, map_of({{"1", 101001}, {"2", 101002}})), HasSubstr("2 new"));
  const Library alike = read("a.csv", "number;name;radius\n1;a;2\n1;a;2\n");
  EXPECT_EQ(shown({}, alike, map_of({{"1", 101001}})),
            "the map's 1 means 2 tools of the library: a, a; give them other names or numbers in the library");
  const Library same = read("a.csv", "T;name\nT101001;a\nT101001;b\n");
  EXPECT_EQ(shown({}, same, {}), "two tools of the library stand at T101001: a and b");
}

TEST(ToolImport, TellsToolsThatCannotBe) {
  const Library library = read("a.csv", "T;name;length;radius;shape;cutLength\nT101001;a;20;3;flat;40\n");
  EXPECT_EQ(shown({}, library, {}),
            "! a: not taken: cutLength: 40 is too large: 20 mm of the tool are outside the holder\n"
            "0 new, 0 changed, 0 as before, 0 of the machine not in the library, 1 of the library not taken\n");
}

constexpr std::string_view kShop = R"({
  // The big router
  "machine": {
    "axes": {"X": {"min": 0, "max": 3200}}, /* all of it */
    "tools": [
      {"head": 1, "holder": 1, "tool": 1, "name": "cutter 20", /* by T1 */ "length": 120.5, "radius": 10}, // the good one
      {
        "head": 1, "holder": 2, "tool": 2,
        "name": "ball" // of steel
      } // bought in May
      // more to come
    ] // tools
  }
}
)";

TEST(ToolImport, KeepsCommentsAndLayout) {
  const Library library =
      read("a.csv", "T;name;length;radius\nT101001;cutter 20;118;10\nT102002;ball;80;3\nT103003;drill;90;4\n");
  const auto import = std::get<ToolImport>(import_tools(machine_of(kShop), library, {}));
  std::string expected(kShop);
  const auto replace = [&](std::string_view before, std::string_view after) {
    expected.replace(expected.find(before), before.size(), after);
  };
  replace("120.5", "118");
  replace("\"ball\" // of steel", "\"ball\", // of steel\n        \"length\": 80,\n        \"radius\": 3");
  replace("} // bought in May",
          "}, // bought in May\n      {\"head\": 1, \"holder\": 3, \"tool\": 3, \"name\": \"drill\", \"length\": 90, "
          "\"radius\": 4}");
  EXPECT_EQ(with_import(kShop, "/shop", import), expected);
}

TEST(ToolImport, WritesWhereThereIsNoList) {
  const Library library = read("a.csv", "T;radius\nT101001;10\n");
  const auto import = std::get<ToolImport>(import_tools({}, library, {}));
  constexpr std::string_view kTool = "{\"head\": 1, \"holder\": 1, \"tool\": 1, \"radius\": 10}";
  const auto written = [&](std::string_view text) { return with_import(text, "/shop", import).value_or("none"); };
  EXPECT_EQ(written(""), fmt::format("{{\n  \"machine\": {{\n    \"tools\": [\n      {}\n    ]\n  }}\n}}\n", kTool));
  EXPECT_EQ(written("{\"language\": \"it\"}"),
            fmt::format("{{\"language\": \"it\", \"machine\": {{\n    \"tools\": [\n      {}\n    ]\n  }}}}", kTool));
  EXPECT_EQ(written("{\r\n  \"machine\": {\"tools\": [ // none yet\r\n  ]}\r\n}\r\n"),
            fmt::format("{{\r\n  \"machine\": {{\"tools\": [ // none yet\r\n    {}\r\n  ]}}\r\n}}\r\n", kTool));
}

TEST(ToolImport, LeavesOtherShapesBehind) {
  constexpr std::string_view kBull =
      R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 6, "shape": "bull", "cornerRadius": 2}]}})";
  const Library library = read("a.csv", "T;shape\nT101001;flat\n");
  const auto import = std::get<ToolImport>(import_tools(machine_of(kBull), library, {}));
  EXPECT_THAT(shown_import(import, Language::Italian),
              HasSubstr("~ T101001: shape \"bull\" -> \"flat\", cornerRadius 2 -> -\n"));
  EXPECT_THAT(with_import(kBull, "/shop", import).value_or(""),
              HasSubstr(R"([{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 6, "shape": "flat"}])"));
}

TEST(ToolImport, KeepsWhatIsAskedFor) {
  const Library library = read("a.csv", "T;name;length;radius\nT101001;cutter 20;118;9\nT102002;ball;80;3\n");
  const auto import = std::get<ToolImport>(import_tools(machine_of(kShop), library, {.kept = {"length", "name"}}));
  const std::string shown = shown_import(import, Language::English);
  EXPECT_THAT(shown, HasSubstr("~ T101001 \"cutter 20\": radius 10 -> 9\n"));
  EXPECT_THAT(shown, HasSubstr("~ T102002 \"ball\": length 80, radius 3\n"));  // It had none.
}

// A holder of the machine may hold other tools: it stays, and so does a holder of the library that is called as a
// number would call another.
TEST(ToolImport, HoldersOfTheMachineStay) {
  const auto tool = [](int number, std::string_view holder, double diameter) {
    return fmt::format(
        R"({{"description": "t{0}", "type": "drill", "unit": "millimeters", "geometry": {{"DC": 6, "LB": 30, "SIG": 118}}, "post-process": {{"number": {0}}},
      "holder": {{"description": "{1}", "segments": [{{"height": 30, "lower-diameter": {2}, "upper-diameter": {2}}}]}}}})",
        number, holder, diameter);
  };
  const Library library = read("a.json", fmt::format(R"({{"data": [{}, {}, {}, {}]}})", tool(1, "H", 30),
                                                     tool(2, "H", 31), tool(3, "H 2", 50), tool(4, "M", 9)));
  const ToolMap map = map_of({{"1", 101001}, {"2", 101002}, {"3", 101003}, {"4", 101004}});
  constexpr std::string_view kMachine =
      R"({"machine": {"holders": {"M": [[40, 60, 60]]}, "tools": [{"head": 1, "holder": 9, "tool": 9, "length": 99, "body": "M"}]}})";
  const auto import = std::get<ToolImport>(import_tools(machine_of(kMachine), library, {.map = map}));
  std::vector<std::string> bodies;
  for (const auto& each : import.changes) bodies.push_back(each.tool.body);
  EXPECT_THAT(bodies, ElementsAre("H", "H 3", "H 2", "M 2"));
  const std::string text = with_import(kMachine, "/shop", import).value_or("");
  EXPECT_THAT(text, HasSubstr(R"("M": [[40, 60, 60]])"));
  EXPECT_THAT(shown(machine_of(text), library, map), HasSubstr("0 new, 0 changed, 4 as before"));
}

TEST(ToolImport, ReadsArchivesWhateverTheirSize) {
  // Of Python's zipfile: the last byte of the packed text is the last one of its stream.
  constexpr std::string_view kArchive{
      "\120\113\003\004\024\000\000\000\010\000\000\000\041\134\234\062\071\201\144\000\000\000\201\000\000\000\012\000"
      "\000\000\164\157\157\154\163\056\152\163\157\156\065\212\073\012\200\100\014\104\257\042\251\265\260\261\260\325"
      "\133\210\205\272\101\002\356\207\044\026\262\354\335\215\242\325\314\274\067\031\334\242\013\364\325\224\301\241"
      "\154\114\111\051\006\003\340\351\070\240\256\100\257\204\317\166\374\201\063\220\376\007\362\250\310\362\340\035"
      "\243\015\276\114\145\030\007\213\256\030\116\121\264\111\034\067\024\171\125\070\375\212\154\265\055\145\056\067"
      "\120\113\001\002\024\003\024\000\000\000\010\000\000\000\041\134\234\062\071\201\144\000\000\000\201\000\000\000"
      "\012\000\000\000\000\000\000\000\000\000\000\000\200\001\000\000\000\000\164\157\157\154\163\056\152\163\157\156"
      "\120\113\005\006\000\000\000\000\001\000\001\000\070\000\000\000\214\000\000\000\000\000"sv};
  const Library library = read("a.tools", kArchive);
  EXPECT_THAT(library.mistakes, IsEmpty());
  EXPECT_EQ(library.tools.size(), 1U);
}

TEST(ToolImport, HoldersOfOneNameStayApart) {
  const auto tool = [](int number, double height) {
    return fmt::format(
        R"({{"description": "t{}", "type": "drill", "unit": "millimeters", "geometry": {{"DC": 6, "LB": 30}}, "post-process": {{"number": {}}},
      "holder": {{"description": "ER", "segments": [{{"height": {}, "lower-diameter": 20, "upper-diameter": 20}}]}}}})",
        number, number, height);
  };
  const Library library =
      read("a.json", fmt::format(R"({{"data": [{}, {}, {}]}})", tool(1, 40), tool(2, 50), tool(3, 40)));
  const auto import =
      std::get<ToolImport>(import_tools({}, library, {.map = map_of({{"1", 101001}, {"2", 101002}, {"3", 101003}})}));
  ASSERT_EQ(import.holders.size(), 2U);
  EXPECT_EQ(import.holders[1].holder.name, "ER 2");
  EXPECT_EQ(import.changes[1].tool.body, "ER 2");
  EXPECT_EQ(import.changes[2].tool.body, "ER");
  // The same library once more changes nothing.
  const std::string text = with_import("", "/shop", import).value_or("");
  EXPECT_THAT(shown(machine_of(text), library, map_of({{"1", 101001}, {"2", 101002}, {"3", 101003}})),
              HasSubstr("0 new, 0 changed, 3 as before"));
}

// A table says all of the tools, in both languages, whatever they are called.
TEST(ToolTable, IsReadAsItIsWritten) {
  constexpr const char* kNames[] = {"",      "mill",       " mill", "mill  ",   "a;b", "a,b",
                                    "\"q\"", " \"q\" ",    "=1+2",  "'=1",      "-5",  "''@x",
                                    "'x",    "due\nrighe", " ",     "\xC3\xA8", "\tx", "a\r"};
  // Numbers that are not a few thousandths: those of presetters, of inches, and next to a simple one.
  const auto some_length = [](support::Random& random) {
    const double simple = static_cast<double>(random.below(1'000'000) + 1) / 1000;
    switch (random.below(4)) {
      case 0:
        return simple / 7;
      case 1:
        return simple / 100 * 25.4;
      case 2:
        return std::nextafter(simple, 0);
      default:
        return simple;
    }
  };
  for (const std::uint64_t seed : support::seeds(50)) {
    support::Random random(seed);
    std::vector<configuration::Tool> tools;
    for (int i = 1; i <= 9; ++i) {
      configuration::Tool tool;
      tool.code = {1, i, i};
      tool.name = kNames[random.below(std::size(kNames))];
      if (random.below(2) == 0) tool.length = some_length(random) + 40;
      if (random.below(2) == 0) tool.radius = some_length(random);
      if (random.below(4) == 0) tool.corner_radius = 0;  // Of another shape than a bull nose it means nothing.
      if (tool.length && random.below(3) == 0) {
        tool.profile = {{0, 0.5}, {static_cast<double>(random.below(50) + 1) / 64, some_length(random)}};
      } else if (tool.length && tool.radius && random.below(2) == 0) {
        tool.shape = random.below(2) == 0 ? "bull" : "flat";
        if (tool.shape == "bull" && !tool.corner_radius) tool.corner_radius = std::min(*tool.radius / 3, 1.0);
      }
      tools.push_back(tool);
    }
    MachineConfiguration machine;
    machine.tools = tools;
    for (const Language language : {Language::English, Language::Italian}) {
      const Library read = read_library_text("t.csv", columns_of(tools, language), false, Language::English);
      ASSERT_THAT(read.mistakes, IsEmpty());
      ASSERT_EQ(read.tools.size(), tools.size());
      for (std::size_t i = 0; i < tools.size(); ++i) {
        EXPECT_EQ(read.tools[i].tool.code, tools[i].code);
        EXPECT_EQ(read.tools[i].tool.name, tools[i].name);
        EXPECT_EQ(read.tools[i].tool.length, tools[i].length);
        EXPECT_EQ(read.tools[i].tool.radius, tools[i].radius);
        EXPECT_EQ(read.tools[i].tool.profile, tools[i].profile);
      }
      for (const std::string& table : {columns_of(tools, language), presetter_list(tools, language)}) {
        const Library back = read_library_text("t.csv", table, false, Language::English);
        ASSERT_THAT(mistakes_of(back), IsEmpty()) << table;
        const ToolImport import = std::get<ToolImport>(import_tools(machine, back, {}));
        EXPECT_EQ(import.unchanged, tools.size()) << shown_import(import, Language::English) << table;
      }
    }
  }
}

TEST(NewMachine, IsWhatWasAnswered) {
  std::istringstream answers("table\n0\n2000\n\n\n-300\n100\n-5\n110\n\n\n\n\n\n30000\n\nabc\n24000\n\n\n\n\n12,5\n");
  std::ostringstream questions;
  const std::string text =
      ask_for_machine("{\n  // ours\n  \"language\": \"it\"\n}\n", answers, questions, Language::English)
          .value_or("none");
  const MachineConfiguration machine = machine_of(text);
  EXPECT_EQ(machine.kind, "table");
  EXPECT_EQ(machine.setup.limits.travel[0].maximum, 2000);
  EXPECT_THAT(text, HasSubstr("// ours"));
  EXPECT_THAT(text, HasSubstr("// "));
  EXPECT_THAT(questions.str(), HasSubstr("abc is neither a number"));
  EXPECT_THAT(questions.str(), testing::Not(HasSubstr("kinematics.pivot")));
  EXPECT_EQ(machine.timed.durations.tool_change, 12.5);
}

TEST(NewMachine, GoesBackToTheQuestionBefore) {
  // The first question has none before it. A wrong minimum refuses the maximum, and is corrected.
  std::istringstream answers("<\ntable\n<\nthree-axis\n500\n300\n<\n0\n300\n7\n<\n" + std::string(30, '\n'));
  std::ostringstream questions;
  const std::string text = ask_for_machine("", answers, questions, Language::English).value_or("none");
  const MachineConfiguration machine = machine_of(text);
  EXPECT_EQ(machine.kind, "three-axis");
  EXPECT_EQ(machine.setup.limits.travel[0].minimum, 0);
  EXPECT_EQ(machine.setup.limits.travel[0].maximum, 300);
  EXPECT_THAT(text, testing::Not(HasSubstr("\"Y\""))) << "its minimum has been taken back";
}

TEST(NewMachine, AsksAgainForWhatCannotBe) {
  std::istringstream answers("ball\n\n0\n-5\n3200\n");
  std::ostringstream questions;
  EXPECT_EQ(ask_for_machine("", answers, questions, Language::Italian), std::nullopt);
  EXPECT_THAT(questions.str(), HasSubstr("ball non è né un numero né una delle parole richieste"));
  EXPECT_THAT(questions.str(), HasSubstr("machine.axes.X.max: "));
}

}  // namespace
}  // namespace isocnc::tool_library
