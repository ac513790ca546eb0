#include "interpreter/sheet/sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/sheet/document.h"
#include "interpreter/sheet/pdf_font.h"
#include "interpreter/verification/scene.h"
#include "tests/support/random.h"

namespace isocnc::sheet {
namespace {

using dialect::Language;
using testing::HasSubstr;
using testing::Not;

Sheet sheet_of(std::string_view text, const configuration::MachineConfiguration& machine = {},
               const verification::Scene* scene = nullptr, double vgpl = 0) {
  running::RunOptions run;
  run.setup = machine.setup;
  run.vgpl = vgpl;
  return survey({.text = text, .name = "part.iso", .bytes = text, .run = run, .machine = machine, .scene = scene});
}

/// One tool in two operations and one that only waits. A tool change takes 8 s.
constexpr std::string_view kPart =
    "M06 T101001\nS12000 M03\nG92 X100 Y50 Z10\nG00 X0 Y0 Z5\nG01 Z-3 F600\nX60 F1200\nM100\nM100\nM101\nM06 T101002\n"
    "G04 P30\nM06 T101001\nS9000 M04\nG01 Y20 F300\nG02 X80 Y20 R10\nM05\nM02";

TEST(Survey, KnowsToolsFunctionsAndZeros) {
  configuration::MachineConfiguration machine;
  machine.functions = {{100, "vuoto", 0}};
  machine.tools.emplace();
  machine.tools->push_back({.code = execution::tool_code(101001), .name = "fresa D20", .length = 90, .radius = 10});
  const Sheet sheet = sheet_of(kPart, machine);
  ASSERT_EQ(sheet.tools.size(), 2U);
  const SheetTool& mill = sheet.tools[0];
  EXPECT_EQ(running::tool_name(mill.code), "T101001");
  EXPECT_EQ(mill.name, "fresa D20");
  EXPECT_EQ(mill.length, 90);
  EXPECT_EQ(mill.radius, 10);
  EXPECT_EQ(mill.uses, 2U);
  EXPECT_EQ(mill.speed.minimum, 12000);
  EXPECT_EQ(mill.speed.maximum, 12000);
  EXPECT_EQ(mill.left_speed.minimum, 9000);
  EXPECT_EQ(mill.left_speed.maximum, 9000);
  EXPECT_EQ(mill.feed.minimum, 300);
  EXPECT_EQ(mill.feed.maximum, 1200);
  EXPECT_NEAR(mill.least_z.value(), -3, 1e-9);
  EXPECT_FALSE(mill.picture.lines.empty());
  const SheetTool& other = sheet.tools[1];
  EXPECT_NEAR(other.seconds, 38, 1e-9);
  EXPECT_EQ(other.uses, 1U);
  EXPECT_FALSE(other.least_z);
  EXPECT_EQ(other.speed.maximum, 0);
  EXPECT_TRUE(other.picture.lines.empty());
  EXPECT_NEAR(sheet.seconds, mill.seconds + other.seconds, 1e-9);
  ASSERT_EQ(sheet.functions.size(), 2U);
  EXPECT_EQ(sheet.functions[0].number, 100);
  EXPECT_EQ(sheet.functions[0].name, "vuoto");
  EXPECT_EQ(sheet.functions[0].calls, 2U);
  EXPECT_EQ(sheet.functions[1].number, 101);
  EXPECT_EQ(sheet.functions[1].calls, 1U);
  ASSERT_EQ(sheet.frames.size(), 1U);
  EXPECT_EQ(sheet.frames[0].line, 2U);
  EXPECT_EQ(sheet.frames[0].frame.origin, geometry::Vec3(100, 50, 10));
  EXPECT_NEAR(sheet.frames[0].extents[0].maximum, 80, 1e-9);
  EXPECT_NEAR(sheet.frames[0].extents[1].maximum, 30, 1e-9) << "the top of the arc";
  EXPECT_NEAR(sheet.frames[0].extents[2].minimum, -10, 1e-9) << "the start of the run, in the machine's zero";
  EXPECT_NEAR(sheet.frames[0].extents[2].maximum, 5, 1e-9);
  EXPECT_EQ(sheet.lines, 17U);
  EXPECT_EQ(sheet.stop, "");
}

TEST(Survey, SaysWhereTheRunStops) {
  const Sheet sheet = sheet_of("M06 T101001\nG04 P5\nG00 X1.2.3\nM02\n");
  EXPECT_THAT(sheet.stop, HasSubstr("on line 3: "));
  EXPECT_NEAR(sheet.seconds, 13, 1e-9);
  EXPECT_EQ(sheet_of("").lines, 0U);
  EXPECT_EQ(sheet_of("M02\n").lines, 1U);
}

/// The setup stands in the first workpiece frame, and the machine's without one.
TEST(Survey, HasTheSetupInTheFirstWorkpieceFrame) {
  verification::Scene scene;
  const auto add = [&](const char* name, verification::BodyRole role, double x, double top, bool is_endless) {
    scene.setup.push_back({.name = name,
                           .role = role,
                           .shape = solids::Cuboid{{x, 0, top - 20}, {x + 100, 100, top}},
                           .described = {},
                           .is_endless = is_endless});
  };
  add("blank", verification::BodyRole::Stock, 0, 0, false);
  add("cup 1", verification::BodyRole::Fixture, 10, -20, false);
  add("", verification::BodyRole::Spoilboard, 0, -40, true);
  for (const bool is_in_workpiece_frame : {true, false}) {
    scene.is_in_workpiece_frame = is_in_workpiece_frame;
    const Sheet sheet = sheet_of(kPart, {}, &scene);
    ASSERT_EQ(sheet.bodies.size(), 3U);
    EXPECT_TRUE(sheet.bodies[2].is_endless);
    EXPECT_EQ(sheet.first_zero, geometry::Vec3(100, 50, 10));
    EXPECT_EQ(sheet.bodies[0].room[0].minimum, is_in_workpiece_frame ? 0 : -100);
    EXPECT_EQ(sheet.bodies[1].room[2].maximum, is_in_workpiece_frame ? -20 : -30);
  }
}

/// The widest mark of a drawing.
double right_end(const Drawing& drawing) {
  double right = 0;
  for (const DrawnLine& line : drawing.lines)
    for (const PaperPoint& point : line.points) right = std::max(right, point.x);
  return right;
}

TEST(Survey, DrawsWithinThePaperHoweverFarAndLongTheProgramIs) {
  std::string text = "M06 T101001\nS9000 M03\nG00 X0 Y0 Z50\nX90000\nG01 X0 Y0 Z0 F1000\n";
  const int moves = support::kTriesAll ? 20'000 : 2'000;
  for (int i = 0; i < moves; ++i) text += fmt::format("X{} Y{}\n", (i * 7919) % 1000, (i * 104729) % 1000);
  const Sheet sheet = sheet_of(text + "M02\n");
  for (const Drawing* const drawing : {&sheet.from_above, &sheet.from_front}) {
    std::size_t points = 0;
    for (const DrawnLine& line : drawing->lines) {
      points += line.points.size();
      for (const PaperPoint& point : line.points) {
        EXPECT_GE(point.x, -0.1);
        EXPECT_LE(point.x, drawing->width + 0.1);
        EXPECT_GE(point.y, -0.1);
        EXPECT_LE(point.y, drawing->height + 0.1);
      }
    }
    EXPECT_LE(points, 130'000U);
    EXPECT_GT(right_end(*drawing), drawing->width / 2);
  }
  EXPECT_TRUE(sheet_of("M02\n").from_above.lines.empty());
  EXPECT_FALSE(sheet_of("M06 T101001\nG00 X5\nM02\n").from_above.lines.empty());
}

TEST(Survey, ShowsAPlungeFromAboveAsADot) {
  const Sheet sheet = sheet_of("M06 T101001\nG00 X10 Y10 Z5\nG01 Z-5 F500\nG00 Z5\nX50\nG01 Z-5\nG00 Z5\nM02\n");
  const auto dots = std::count_if(sheet.from_above.lines.begin(), sheet.from_above.lines.end(),
                                  [](const DrawnLine& line) { return line.points.size() == 1; });
  EXPECT_EQ(dots, 2);
}

/// What another value of VGPL leads to is on the sheet, too, and what it needs.
TEST(AddPath, AddsToolsFunctionsAndRanges) {
  constexpr std::string_view kForked =
      "M06 T101001\nG00 X0 Y0 Z5\nG01 Z-1 F500\nIF VGPL <> 1 GOTO N5\nZ-9 F900\nM100\nM06 T101002\nG04 P20\nN5 M02\n";
  Sheet sheet = sheet_of(kForked);
  ASSERT_EQ(sheet.tools.size(), 1U);
  const configuration::MachineConfiguration machine;
  running::RunOptions run;
  add_path(sheet, {.text = kForked, .name = "", .bytes = kForked, .run = run, .machine = machine}, "VGPL <> 1");
  run.vgpl = 1;
  add_path(sheet, {.text = kForked, .name = "", .bytes = kForked, .run = run, .machine = machine}, "VGPL = 1");
  ASSERT_EQ(sheet.paths.size(), 2U);
  EXPECT_NEAR(sheet.paths[0].seconds, sheet.seconds, 1e-9);
  EXPECT_GT(sheet.paths[1].seconds, sheet.seconds + 28);
  ASSERT_EQ(sheet.tools.size(), 2U);
  EXPECT_EQ(sheet.tools[0].values, "");
  EXPECT_NEAR(sheet.tools[0].least_z.value(), -9, 1e-9);
  EXPECT_EQ(sheet.tools[0].feed.maximum, 900);
  EXPECT_EQ(sheet.tools[0].uses, 1U);
  EXPECT_EQ(sheet.tools[1].values, "VGPL = 1");
  ASSERT_EQ(sheet.functions.size(), 1U);
  EXPECT_EQ(sheet.functions[0].values, "VGPL = 1");
  EXPECT_THAT(html_of(sheet, Language::English), HasSubstr("T101002 (only with VGPL = 1)"));
}

/// A surface in rows: none of them is left out, though the picture takes more lines than it may have.
TEST(Survey, DrawsAllOfAFullPicture) {
  if (!support::kTriesAll) GTEST_SKIP() << "half a minute under the sanitizers";
  std::string text = "M06 T101001\nG00 X0 Y0 Z0\nF5000\n";
  for (int row = 0; row < 250; ++row)
    for (int i = 1; i <= 400; ++i)
      text += fmt::format("G01 X{} Y{} Z{}\n", row % 2 == 0 ? 2 * i : 800 - 2 * i, 2 * row, (i * 37 + row * 11) % 7);
  text += "M06 T101002\nG01 X0 Y0\nX800\nY498\nX0\nY0\nM02\n";
  const Sheet sheet = sheet_of(text);
  std::vector<bool> rows(85);
  bool has_contour = false;
  for (const DrawnLine& line : sheet.from_above.lines) {
    for (const PaperPoint& point : line.points) rows[static_cast<std::size_t>(std::clamp(point.y, 0.0, 84.0))] = true;
    has_contour = has_contour || line.stroke.color == 0xD55E00;
  }
  EXPECT_TRUE(has_contour) << "of the second tool";
  EXPECT_GT(std::count(rows.begin(), rows.end(), true), sheet.from_above.height - 14);
}

TEST(Survey, ShowsShortMovesAsLines) {
  std::string text = "M06 T101001\nG00 X0 Y0 Z0\nG91\nF500\n";
  for (int i = 0; i < 500; ++i) text += "G01 X0.02 Y0.01\n";
  text += "G90\nG00 X200 Y200\nM02\n";
  for (const DrawnLine& line : sheet_of(text + "").from_above.lines) EXPECT_GT(line.points.size(), 1U);
}

TEST(Survey, SaysWithWhatItRunsAndWhereItStopsAsAsked) {
  running::RunOptions run;
  run.vgpl = 2;
  run.registers[3] = 7;
  run.until = 2;
  const configuration::MachineConfiguration machine;
  const Sheet sheet =
      survey({.text = "M06 T101001\nG04 P5\nG04 P9\nM02\n", .name = "", .bytes = "", .run = run, .machine = machine});
  EXPECT_EQ(sheet.values, "VGPL = 2, V3 = 7");
  EXPECT_EQ(sheet.stop, "the run ends before line 3, as asked");
}

/// Where a program has not come far, nothing is said of what it would do.
TEST(SheetOfAStoppedProgram, SaysWhatStoppedIt) {
  struct Case {
    std::string text, stop;
    bool has_tool, has_motion;
  };
  const Case cases[] = {
      {"G01 X\nM02\n", "ISO004 on line 1", false, false},
      {"M06 T101001\nG01 X\nM02\n", "ISO004 on line 2", true, false},
      {"G92 X1 Y2 Z3\nG01 X\nM02\n", "ISO004 on line 2", false, false},
      {"M06 T101001\nG92 X1 Y2 Z3\nG00 X1\nG01 X\nM02\n", "ISO004 on line 4", true, true},
  };
  for (const Case& each : cases) {
    const std::string html = html_of(sheet_of(each.text), Language::English);
    const auto says = [&](const std::string& sentence) { return html.find(sentence) != std::string::npos; };
    EXPECT_TRUE(says("The program does not come to its end: " + each.stop)) << each.text;
    EXPECT_EQ(says("No tool is mounted before the program stops: " + each.stop), !each.has_tool) << each.text;
    EXPECT_EQ(says("Nothing moves from a zero point before the program stops: " + each.stop), !each.has_motion)
        << each.text;
    EXPECT_TRUE(says("Nothing before the program stops: " + each.stop)) << each.text;
    EXPECT_FALSE(says("The program sets no zero point")) << each.text;
    EXPECT_FALSE(says("No tool is mounted.")) << each.text;
  }
  const std::string whole = html_of(sheet_of("G04 P1\nM02\n"), Language::Italian);
  EXPECT_THAT(whole, HasSubstr("Il programma non imposta uno zero"));
  EXPECT_THAT(html_of(sheet_of("G92 X5\nM02\n"), Language::English), HasSubstr("Nothing moves from a zero point.<"));
  EXPECT_THAT(whole, HasSubstr("Non si monta nessun utensile."));
}

/// The colors are twelve: what follows is told apart by its dashes, in the pictures and in the legend.
TEST(SheetOfManyTools, HasNoTwoOfThemAlike) {
  constexpr int kTools = 40;
  std::string text;
  for (int tool = 1; tool <= kTools; ++tool)
    text += fmt::format("M06 T101{:03}\nS9000 M03\nG00 X0 Y{} Z5\nG01 Z-1 F900\nX200\nG00 Z5\nM05\n", tool, 5 * tool);
  const Sheet sheet = sheet_of(text + "M02\n");
  ASSERT_EQ(sheet.tools.size(), std::size_t{kTools});
  std::set<std::pair<std::uint32_t, std::vector<double>>> strokes;
  for (const DrawnLine& line : sheet.from_above.lines)
    if (line.stroke.width == 0.25) strokes.emplace(line.stroke.color, line.stroke.dashes);
  EXPECT_EQ(strokes.size(), std::size_t{kTools});
  std::set<std::uint32_t> colors;
  for (const auto& [color, dashes] : strokes) colors.insert(color);
  EXPECT_EQ(colors.size(), 12U);

  // The mark before each tool in the table.
  const std::string html = html_of(sheet, Language::English);
  std::set<std::string> marks;
  for (int tool = 1; tool <= kTools; ++tool) {
    const std::size_t end = html.find(fmt::format("T101{:03}", tool));
    marks.insert(html.substr(html.rfind("<td>", end), end - html.rfind("<td>", end)));
  }
  EXPECT_EQ(marks.size(), std::size_t{kTools});
  // A PDF has its lengths in points.
  EXPECT_THAT(pdf_of(sheet, Language::English), HasSubstr("[5.1 2.0 0.3 2.0] 0 d\n"));
}

TEST(SheetAsHtml, NeverTakesANameForMarkup) {
  Sheet sheet = sheet_of(kPart);
  sheet.program = "<script>alert('a')</script>&\".iso";
  sheet.tools[0].name = "<img src=x onerror=alert(1)>";
  sheet.findings.push_back({2, dialect::Severity::Error, "ISO028", "a <b> & c"});
  for (const Language language : {Language::English, Language::Italian}) {
    const std::string html = html_of(sheet, language);
    EXPECT_THAT(html, Not(HasSubstr("<script")));
    EXPECT_THAT(html, Not(HasSubstr("<img")));
    EXPECT_THAT(html, HasSubstr("a &lt;b&gt; &amp; c"));
    EXPECT_THAT(html, HasSubstr("Content-Security-Policy"));
  }
  EXPECT_THAT(html_of(sheet, Language::Italian), HasSubstr("Scheda di attrezzaggio"));
}

/// A PDF, read back: what its table of objects says is where it is, and its texts.
class ReadPdf {
 public:
  explicit ReadPdf(const std::string& file) {
    EXPECT_EQ(file.substr(0, 9), "%PDF-1.4\n");
    const std::size_t start = file.rfind("startxref\n");
    std::size_t place = std::stoul(file.substr(start + 10));
    EXPECT_EQ(file.substr(place, 5), "xref\n");
    const std::size_t count = std::stoul(file.substr(place + 7));
    place = file.find('\n', place + 5) + 1;
    for (std::size_t i = 0; i < count; ++i, place += 20) {
      const std::string row = file.substr(place, 20);
      EXPECT_EQ(row.substr(18), " \n");
      if (i == 0) continue;
      const std::string head = fmt::format("{} 0 obj\n", i);
      EXPECT_EQ(file.substr(std::stoul(row), head.size()), head);
    }
    EXPECT_EQ(file.substr(place, 8), "trailer\n");
    for (std::size_t at = file.find("stream\n"); at != std::string::npos; at = file.find("stream\n", at + 1)) {
      if (file[at - 1] == 'd') continue;  // endstream
      const std::size_t length = std::stoul(file.substr(file.rfind("/Length ", at) + 8));
      EXPECT_EQ(file.substr(at + 7 + length, 9), "endstream");
      pages.push_back(texts_of(file.substr(at + 7, length)));
    }
  }

  bool has(const std::string& text) const {
    return std::any_of(pages.begin(), pages.end(),
                       [&](const std::string& page) { return page.find(text) != std::string::npos; });
  }

  std::vector<std::string> pages;  ///< The texts of each, a line for each.

 private:
  static std::string texts_of(const std::string& content) {
    std::string texts;
    for (std::size_t i = content.find(" Td ("); i != std::string::npos; i = content.find(" Td (", i)) {
      for (i += 5; content[i] != ')'; ++i) {
        if (content[i] != '\\') {
          texts += content[i];
        } else if (content[i + 1] >= '0' && content[i + 1] <= '7') {
          texts += static_cast<char>(std::stoi(content.substr(i + 1, 3), nullptr, 8));
          i += 3;
        } else {
          texts += content[++i];
        }
      }
      texts += '\n';
    }
    return texts;
  }
};

TEST(SheetAsPdf, SaysWhatTheHtmlSays) {
  Sheet sheet = sheet_of(kPart);
  sheet.program = "ùtile (1) \\ 日.iso";
  sheet.registers = {3, 7};
  sheet.paths = {{"VGPL = 1", 12, ""}, {"VGPL <> 1", 20, "ISO028 on line 4: x"}};
  const ReadPdf pdf(pdf_of(sheet, Language::English));
  ASSERT_EQ(pdf.pages.size(), 1U);
  for (const char* const text :
       {"\xF9tile (1) \\ ?.iso", "T101001", "T101002", "12000; 9000\nM04\n", "300 \x85 1200", "-3", "X100 Y50 Z10",
        "M100\n", "2\xD7\n", "V3, V7", "VGPL <> 1", "20.0 s; ISO028 on line 4: x", "page 1 of 1", "Set up by"})
    EXPECT_TRUE(pdf.has(text)) << text << "\n" << pdf.pages[0];
  EXPECT_TRUE(pdf.has(sheet.hash));
}

TEST(SheetAsPdf, GoesOnOnFurtherPagesWithTheHeadOfTheTable) {
  Sheet sheet = sheet_of(kPart);
  for (std::size_t i = 0; i < 200; ++i)
    sheet.findings.push_back({i, dialect::Severity::Warning, "W102", fmt::format("finding number {}", i)});
  const ReadPdf pdf(pdf_of(sheet, Language::English));
  ASSERT_GT(pdf.pages.size(), 2U);
  std::size_t count = 0;
  for (std::size_t page = 0; page < pdf.pages.size(); ++page) {
    EXPECT_THAT(pdf.pages[page], HasSubstr(fmt::format("page {} of {}\n", page + 1, pdf.pages.size())));
    if (page > 0 && pdf.pages[page].find("finding") != std::string::npos) {
      EXPECT_THAT(pdf.pages[page], HasSubstr("Message\n"));
    }
    for (std::size_t at = 0; (at = pdf.pages[page].find("finding number", at)) != std::string::npos; ++at) ++count;
  }
  EXPECT_EQ(count, 100U);
  EXPECT_TRUE(pdf.has("100 more: isolint shows all of them."));
}

/// What is a little longer than a page becomes smaller.
TEST(SheetAsPdf, FitsOnePageWhereThatCanBeRead) {
  Sheet sheet = sheet_of(kPart);
  std::vector<std::size_t> pages;
  for (std::size_t i = 0; i < 60; ++i) {
    sheet.findings.push_back({i, dialect::Severity::Warning, "W102", "a finding"});
    pages.push_back(ReadPdf(pdf_of(sheet, Language::English)).pages.size());
  }
  EXPECT_TRUE(std::is_sorted(pages.begin(), pages.end()));
  EXPECT_EQ(pages.front(), 1U);
  EXPECT_EQ(pages.back(), 2U);
  EXPECT_GT(std::count(pages.begin(), pages.end(), 1U), 20) << "they would fill a page at full size before";
}

TEST(PdfFonts, MeasureAndEncodeText) {
  EXPECT_DOUBLE_EQ(width_of("Hello", PdfFont::Regular, 1000), 722 + 556 + 222 + 222 + 556);
  EXPECT_DOUBLE_EQ(width_of("Hello", PdfFont::Bold, 1000), 722 + 556 + 278 + 278 + 611);
  EXPECT_DOUBLE_EQ(width_of(encoded("è"), PdfFont::Regular, 1000), 556);
  EXPECT_DOUBLE_EQ(width_of(encoded("Ì"), PdfFont::Regular, 1000), 278);
  EXPECT_EQ(encoded("è€…–日\t\x80\n"), "\xE8\x80\x85\x96? ??");
  for (int byte = 0x20; byte <= 0xFF; ++byte)
    EXPECT_GT(width_of(std::string(1, static_cast<char>(byte)), PdfFont::Bold, 1), 0) << byte;
}

}  // namespace
}  // namespace isocnc::sheet
