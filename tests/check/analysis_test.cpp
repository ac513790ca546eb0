#include "analyzer/check/analysis.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analyzer/check/check_text.h"
#include "analyzer/check/folding.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::check {
namespace {

using support::Random;
using support::RandomProgram;
using syntax::Document;

const rules::CheckSetup kSetup;

std::string zigzag(int count) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\n";
  for (int i = 2; i + 1 < count; ++i) text += fmt::format("G1 X{} Y{} Z{}\n", i % 100, i % 70, i % 5);
  return text + "M02\n";
}

TEST(Analysis, ChecksAllLinesOnce) {
  const Document document(zigzag(20'000));
  const Analysis analysis(document, kSetup);
  EXPECT_EQ(analysis.lines_checked(), document.line_count());
  EXPECT_TRUE(analysis.report().findings.empty());
}

TEST(Analysis, AnEditDoesNotRunTheLinesFarAfterItAgain) {
  Document document(zigzag(20'000));
  Analysis analysis(document, kSetup);
  document.replace({5'000, 4}, {5'000, 5}, "7");
  analysis.update();
  EXPECT_LE(analysis.lines_checked(), 600u);
  EXPECT_TRUE(analysis.report().findings.empty());
}

TEST(Analysis, FindingsAfterAnInsertedLineMoveWithoutBeingCheckedAgain) {
  Document document(zigzag(20'000));
  document.replace({15'000, 0}, {15'000, 0}, "G1 X1 X2\n");
  Analysis analysis(document, kSetup);
  document.replace({100, 0}, {100, 0}, "G1 X1\n");
  analysis.update();
  EXPECT_LE(analysis.lines_checked(), 600u);
  ASSERT_EQ(analysis.report().findings.size(), 1u);
  EXPECT_EQ(analysis.report().findings[0].line, 15'001u);
}

TEST(Analysis, NothingChangedCostsNothing) {
  Document document(zigzag(2'000));
  Analysis analysis(document, kSetup);
  analysis.update();
  EXPECT_EQ(analysis.lines_checked(), 0u);
}

TEST(Analysis, AModeWrittenAboveReachesTheEnd) {
  Document document(zigzag(20'000));
  document.replace({19'990, 0}, {19'990, 0}, "G2 X1 Y0 I0.5 J0 Z3\n");
  Analysis analysis(document, kSetup);
  const Report before = analysis.report();
  document.replace({1, 0}, {1, 3}, "G91");
  analysis.update();
  EXPECT_NE(support::texts_of(analysis.report()), support::texts_of(before));
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

/// The same, with parts that an IF may leave out.
std::string optional_parts(int count) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\nV1=1\n";
  for (int part = 1; part <= count; ++part)
    text += fmt::format("IF VGPL={} GOTO N{}\nG1 X{}\nY5\nN{} X7 Y7\n", part % 5, part, part % 9, part);
  return text + "IF V1=1 GOTO N1000000\nX1\nN1000000 X2 Y2\nM02\n";
}

TEST(Analysis, WhatAnIfComparesIsCheckedAgainWhereItMatters) {
  Document document(optional_parts(5'000));
  Analysis analysis(document, kSetup);
  const std::size_t line = 3 + 4 * 2'000;
  ASSERT_EQ(document.text_of_line(line), "IF VGPL=1 GOTO N2001");
  const auto expect_few = [&](std::uint64_t maximum) {
    analysis.update();
    EXPECT_LE(analysis.lines_checked(), maximum);
    EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
  };
  document.replace({line, 8}, {line, 9}, "7");  // IF VGPL=7
  expect_few(600);
  document.replace({line, 0}, {line, 9}, "IF V1>=0.5");
  expect_few(1'200);  // The assignment as well: 1 is distinguished from other values now.
  document.replace({line, 7}, {line, 10}, "2.5");
  expect_few(1'200);
  document.replace({line + 3, 1}, {line + 3, 2}, "8");  // The label is N8001 now, and nowhere is N2001.
  expect_few(1'200);
  EXPECT_EQ(analysis.report().findings.front().line, line);
  document.replace({line + 3, 1}, {line + 3, 2}, "2");
  expect_few(1'200);
}

/// Each of some registers is given a value and compared once.
std::string registers_in_turn() {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\n";
  for (int i = 1; i <= 9; ++i) {
    text += fmt::format("V{0}=1\nIF V{0}=1 GOTO N{0}\nX1\nN{0} X2\n", i);
    for (int line = 0; line < 2'300; ++line) text += fmt::format("X{}\n", line % 50);
  }
  return text + "M02\n";
}

TEST(Analysis, AnIfThatIsInsertedIsCheckedWhereItMatters) {
  for (const std::string& text : {optional_parts(5'000), zigzag(20'000), registers_in_turn()}) {
    Document document(text);
    Analysis analysis(document, kSetup);
    const auto expect_few = [&] {
      analysis.update();
      EXPECT_LE(analysis.lines_checked(), 400u);
      EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
    };
    document.replace({8'003, 0}, {8'003, 0}, "IF VGPL=9 GOTO N88888\nX1\nN88888 X2\n");
    expect_few();
    document.replace({4'003, 0}, {4'003, 0}, "V2=9\nIF V2=9 GOTO N77777\nX1\nN77777 X2\n");
    expect_few();
    EXPECT_EQ(analysis.frontier_before(15'000), Analysis(document, kSetup).frontier_before(15'000));
    document.replace({4'003, 0}, {4'007, 0}, "");
    expect_few();
    document.replace({8'003, 0}, {8'004, 0}, "");
    expect_few();
  }
}

TEST(Analysis, ALabelThatIsRemovedKeepsNoPathWaiting) {
  std::string text = zigzag(20'000);
  text.insert(text.find("G1 X2 "), "IF VGPL=1 GOTO N2\n");
  Document document(text);
  document.replace({1'000, 0}, {1'000, 0}, "N2 ");
  Analysis analysis(document, kSetup);
  for (const char digit : {'3', '2'}) {
    document.replace({1'000, 1}, {1'000, 2}, std::string(1, digit));
    analysis.update();
    EXPECT_LE(analysis.lines_checked(), 1'600u);
    EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
    EXPECT_EQ(analysis.frontier_before(20'000), Analysis(document, kSetup).frontier_before(20'000));
  }
}

TEST(Analysis, AJumpMovesUpWhenLinesAboveAreRemoved) {
  const std::string below = "IF V9=1 GOTO N5\nX1\nN5 X2\nM02\n";
  const std::string text = zigzag(1'000);
  for (std::size_t first = 60; first < 460; ++first) {  // Whole chunks, too.
    Document document(text.substr(0, text.size() - 4) + below);
    Analysis analysis(document, kSetup);
    document.replace({first, 0}, {first + 128, 0}, "");
    analysis.update();
    const Report report = analysis.report();
    ASSERT_EQ(report.findings.size(), 1u);  // Nothing gives V9 a value.
    ASSERT_EQ(report.findings[0].line, document.line_count() - 5) << first;
  }
}

/// A finding far below says which way it was reached, also where other jumps came or went above that one.
TEST(Analysis, AJumpKeepsItsNumberOfPathsWhereAnotherComesAbove) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\nIF VGPL=1 GOTO N5\nG41\nN5 X1\n";
  text += "IF VGPL=2 GOTO N6\nX4\nN6 X5\n";
  for (int i = 0; i < 1'000; ++i) text += fmt::format("G1 X{}\n", i % 100);
  Document document(text + "M02\n");
  Analysis analysis(document, kSetup);
  const auto expect_same_path = [&] {
    const std::vector<std::string> report = support::texts_of(analysis.report());
    EXPECT_EQ(report, support::texts_of(check_text(document.text(), kSetup)));
    ASSERT_EQ(report.size(), 1u);
    EXPECT_NE(report[0].find("via not "), std::string::npos) << report[0];
  };
  expect_same_path();
  for (const bool is_inserted : {true, false}) {
    document.replace({2, 0}, {is_inserted ? 2u : 3u, 0}, is_inserted ? "IF VGPL=3 GOTO N4\nX7\nN4 X8\n" : "");
    analysis.update();
    EXPECT_LE(analysis.lines_checked(), 300u);
    expect_same_path();
  }
}

TEST(Analysis, LabelsThatAreNamedFromNowOnAreFound) {
  std::string moves;
  for (int i = 0; i < 1'000; ++i) moves += fmt::format("G1 X{}\n", i % 100);
  const std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\nIF VGPL=1 GOTO N5\n" + moves + "N7 X5\nN5 X6\n";
  Document document(text + moves + "N7 X5\nM02\n");
  Analysis analysis(document, kSetup);
  EXPECT_TRUE(analysis.report().findings.empty());
  document.replace({2, 16}, {2, 17}, "7");
  analysis.update();
  ASSERT_EQ(analysis.report().findings.size(), 1u);  // The second N7.
  EXPECT_EQ(analysis.report().findings[0].line, document.line_count() - 3);
  EXPECT_EQ(analysis.frontier_before(500), Analysis(document, kSetup).frontier_before(500));
  document.replace({2, 16}, {2, 17}, "5");
  analysis.update();
  EXPECT_TRUE(analysis.report().findings.empty());
}

/// Mostly G91, with arcs, and now and then an absolute coordinate.
std::string incremental_zigzag(int count) {
  std::string text = "M06 T101001\nG90 G1 X0.1 Y0.2 Z0.3 F1000\nG91\n";
  for (int i = 3; i + 2 < count; ++i) {
    const int step = i % 7 - 3;
    text += i % 50 == 0 ? "G2 X0.2 Y0 I0.1 J0\nG1 X0.1\n" : fmt::format("X0.{} Y{}.{}\n", i % 10, step, i % 3);
  }
  return text + "G90 X5 Y5\nM02\n";
}

void expect_frontiers_of_fresh_check(const Analysis& analysis, const Document& document) {
  const Analysis fresh(document, kSetup);
  for (std::size_t line = 0; line < document.line_count(); line += 97)
    ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << line;
  EXPECT_EQ(analysis.frontier_before(document.line_count()), fresh.frontier_before(document.line_count()));
}

TEST(Analysis, AShiftPassesOverIncrementalMoves) {
  Document document(incremental_zigzag(20'000));
  Analysis analysis(document, kSetup);
  document.replace({2'000, 0}, {2'000, 0}, "X7.123\n");
  analysis.update();
  EXPECT_LE(analysis.lines_checked(), 1'000u);
  EXPECT_TRUE(analysis.report().findings.empty());
  expect_frontiers_of_fresh_check(analysis, document);
}

TEST(Analysis, AShiftPassesOverWrongIncrementalArcs) {
  std::string text = incremental_zigzag(20'000);
  for (std::size_t arc = text.find("I0.1"); arc != std::string::npos; arc = text.find("I0.1", arc + 1))
    text.replace(arc, 4, "I0.2");
  Document document(text);
  Analysis analysis(document, kSetup);
  document.replace({2'000, 0}, {2'000, 0}, "X7.123\n");
  analysis.update();
  EXPECT_LE(analysis.lines_checked(), 1'000u);
  EXPECT_GT(analysis.finding_count(), 100u);
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

TEST(Analysis, AShiftOfEachAxisPassesOverIncrementalMoves) {
  std::string text = "M06 T101001\nG49\nG91\nG1 F1000 X1 Y1 Z1 B1 C1\n";
  for (int i = 0; i < 1'000; ++i) text += fmt::format("X0.{} Y0.1 Z0.2 B0.3 C0.{}\n", i % 10, i % 7);
  for (const char* const axis : {"X", "Y", "Z", "B", "C"}) {
    for (const bool is_far : {false, true}) {
      const std::size_t line = 4;
      Document document(text + "M02\n");
      document.replace({line, 0}, {line, 0}, axis + std::string(is_far ? "600000\n" : "7\n"));
      Analysis analysis(document, kSetup);
      document.replace({line, 0}, {line, 0}, axis + std::string("0.25\n"));
      analysis.update();
      // Far away, increments need not add up exactly.
      EXPECT_EQ(analysis.lines_checked() > 1'000, is_far) << axis;
      expect_frontiers_of_fresh_check(analysis, document);
    }
  }
}

/// A block whose line break is lost takes nothing from what the lines around it have read.
TEST(Analysis, AShiftIsNotPassedOverByAnArcAboveALostLineBreak) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\nG91\n";
  for (int i = 0; i < 300; ++i) text += "X0.1\nX-0.1\n";
  text += "G90 G2 X10 Y0 I5 J0\nG1\nX5 Y5\n";
  for (int i = 0; i < 300; ++i) text += "X1\n";
  Document document(text + "M02\n");
  Analysis analysis(document, kSetup);
  document.replace({3, 0}, {3, 0}, "X2\n");
  analysis.update();
  const std::vector<std::string> report = support::texts_of(analysis.report());
  EXPECT_EQ(report, support::texts_of(check_text(document.text(), kSetup)));
  EXPECT_GT(report.size(), 1u);
}

/// Lines on two paths are judged for their depth, too.
TEST(Analysis, AShiftIsNotPassedOverByADepthOnTwoPaths) {
  rules::CheckSetup setup;
  setup.house_rules = std::make_shared<rules::HouseRules>(
      std::vector<dialect::HouseWatch>{{.rule = "depth", .kind = dialect::HouseWatch::Kind::Depth, .minimum = -9}});
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\nG91\n";
  for (int i = 0; i < 300; ++i) text += "Z0.1\nZ-0.1\n";
  text += "IF VGPL=1 GOTO N5\nG38\nN5 X1\n";
  for (int i = 0; i < 300; ++i) text += "Z0.1\nZ-0.1\n";
  text += "Z-8.5\n";
  for (int i = 0; i < 300; ++i) text += "X1\n";
  Document document(text + "M02\n");
  Analysis analysis(document, setup);
  const std::size_t before = analysis.report().findings.size();
  document.replace({3, 0}, {3, 0}, "Z-1\n");
  analysis.update();
  const std::vector<std::string> report = support::texts_of(analysis.report());
  EXPECT_EQ(report, support::texts_of(check_text(document.text(), setup)));
  EXPECT_GT(report.size(), before);
}

TEST(Analysis, AShiftIsNotPassedOverByWhatDependsOnThePosition) {
  Document document(incremental_zigzag(4'000));
  Analysis analysis(document, kSetup);
  // The arc is right from where the moves above lead to, and from nowhere else.
  const double x = analysis.frontier_before(3'000).live[0].state.position.tip.x();
  const double y = analysis.frontier_before(3'000).live[0].state.position.tip.y();
  document.replace({3'000, 0}, {3'000, 0}, fmt::format("G90 G2 X{} Y{} I{} J{}\nG91 G1 X1\n", x + 2, y, x + 1, y));
  analysis.update();
  EXPECT_TRUE(analysis.report().findings.empty());
  document.replace({100, 0}, {100, 0}, "X0.5\n");
  analysis.update();
  ASSERT_EQ(analysis.report().findings.size(), 1u);
  EXPECT_EQ(dialect::definition(analysis.report().findings[0].finding.id).code, "ISO031");
  EXPECT_LE(analysis.lines_checked(), 1'000u);
}

/// What plain motions do not read is passed on by them, also where a mode or a number is typed that lasts.
TEST(Analysis, WhatPlainMotionsDoNotReadPassesOverThem) {
  Document document(zigzag(20'000));
  document.replace({19'000, 0}, {19'000, 0}, "G40\nM05\nG4 F1\n");
  Analysis analysis(document, kSetup);
  for (const char* const line : {"G41", "S5000", "M03", "F700", "G18", "G92 X0 Y0 Z0", "G38", "T101002 M06", "M05"}) {
    const auto expect_few = [&] {
      analysis.update();
      EXPECT_LE(analysis.lines_checked(), 1'500u) << line;
      const Analysis fresh(document, kSetup);
      EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(fresh.report())) << line;
      for (const std::size_t place : {100u, 499u, 502u, 9'000u, 18'990u, 19'500u, 20'000u})
        EXPECT_EQ(analysis.frontier_before(place), fresh.frontier_before(place)) << line << ", line " << place;
    };
    document.replace({500, 0}, {500, 0}, std::string(line) + "\n");
    expect_few();
    document.replace({500, 0}, {501, 0}, "");
    expect_few();
  }
}

/// An arc reads its plane, and a line without F the way feeds are given.
TEST(Analysis, WhatPlainMotionsReadIsNotPassedOver) {
  Document document(zigzag(20'000));
  document.replace({15'000, 0}, {15'000, 0}, "G1 X0 Y0\nG2 X10 Y0 I5 J0\nG1 X5\n");
  Analysis analysis(document, kSetup);
  ASSERT_TRUE(analysis.report().findings.empty());
  for (const char* const line : {"G18", "G93", "G70", "G91"}) {
    document.replace({500, 0}, {500, 0}, std::string(line) + "\n");
    analysis.update();
    EXPECT_FALSE(analysis.report().findings.empty()) << line;
    EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup))) << line;
    document.replace({500, 0}, {501, 0}, "");
    analysis.update();
    EXPECT_TRUE(analysis.report().findings.empty()) << line;
  }
}

/// Where the units are in doubt, a move sets its axes to 0, wherever they were.
TEST(Analysis, AShiftEndsWhereTheUnitsAreInDoubt) {
  std::string text = incremental_zigzag(2'000);
  text.insert(text.find("G90 X5"), "70\nX1\n" + support::joined(std::vector<std::string>(1'000, "Y1")));
  Document document(text);
  Analysis analysis(document, kSetup);
  document.replace({100, 0}, {100, 0}, "X0.5\n");
  analysis.update();
  expect_frontiers_of_fresh_check(analysis, document);
}

TEST(Analysis, GoesOnWhereItWasStopped) {
  Document document(zigzag(60'000));
  Analysis analysis(document, kSetup, Analysis::Unchecked{});
  int pieces = 1;
  int chunks = 0;
  while (!analysis.update([&] { return ++chunks % 64 == 0; })) {
    ++pieces;
    document.replace({30'000, 0}, {30'000, 0}, pieces % 2 == 0 ? "G1 X1 X2\n" : "G91\n");
  }
  EXPECT_GE(pieces, 3);
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

TEST(Analysis, FirstChecksWhatIsBelowTheEdit) {
  Document document(zigzag(20'000));
  document.replace({19'000, 0}, {19'000, 0}, "G1 X1 X2\n");
  Analysis analysis(document, kSetup);
  document.replace({500, 0}, {500, 0}, "G93\nG9\n");
  int chunks = 0;
  EXPECT_FALSE(analysis.update([&] { return ++chunks == 5; }));
  EXPECT_LE(analysis.lines_checked(), 800u);
  const std::vector<LocatedFinding> known = analysis.report().findings;
  ASSERT_GE(known.size(), 3u);
  EXPECT_EQ(known[0].line, 501u);                   // What the edit itself has wrong,
  EXPECT_EQ(known[1].line, 502u);                   // and what it has made wrong below,
  EXPECT_EQ(known.back().line, 19'002u);            // and what was wrong before,
  EXPECT_LT(known[known.size() - 2].line, 2'000u);  // but not yet all of it.
  EXPECT_TRUE(analysis.update());
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

TEST(Analysis, ChecksUpToALineAlone) {
  Document document(zigzag(20'000));
  Analysis analysis(document, kSetup);
  document.replace({500, 0}, {500, 0}, "G91\n");
  for (const std::size_t line : {501u, 700u, 4'000u, 2'000u}) {
    EXPECT_TRUE(analysis.update_before(line));
    EXPECT_LE(analysis.lines_checked(), line);
    EXPECT_EQ(analysis.frontier_before(line), Analysis(document, kSetup).frontier_before(line)) << line;
  }
  EXPECT_EQ(analysis.lines_checked(), 0u) << "checked already";
  EXPECT_TRUE(analysis.update());
  EXPECT_GT(analysis.lines_checked(), 15'000u);
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

TEST(Analysis, AnExcerptHasTheFirstFindingsAndCountsTheOthers) {
  std::string text = "G1 X1\n";
  for (int i = 0; i < 5'000; ++i) text += i % 3 == 0 ? "G1 X1 X2\n" : "G1 Q7\n";
  const Document document(text + "IF V3=1 GOTO N9\nIF V3=2 GOTO N1\nN9 X7\n");
  const Analysis analysis(document, kSetup);
  const Report all = analysis.report();
  for (const std::size_t maximum : {0u, 1u, 100u, 4'999u, 100'000u}) {
    const auto is_even = [](dialect::DiagnosticId id) { return static_cast<int>(id) % 2 == 0; };
    const auto severity = [&](dialect::DiagnosticId id) {
      return is_even(id) ? std::optional(dialect::Severity::Error) : std::nullopt;
    };
    const FirstFindings excerpt = analysis.excerpt({.max = maximum, .severity = severity});
    const std::vector<std::string> texts = support::texts_of(excerpt.report);
    const auto counted = [&](const Report& report) {
      return std::count_if(report.findings.begin(), report.findings.end(),
                           [&](const LocatedFinding& located) { return is_even(located.finding.id); });
    };
    const std::vector<std::string> expected = support::texts_of(all);
    EXPECT_TRUE(std::equal(texts.begin(), texts.end(), expected.begin())) << maximum;
    EXPECT_GE(static_cast<std::size_t>(counted(excerpt.report)),
              std::min<std::size_t>(maximum, static_cast<std::size_t>(counted(all))));
    EXPECT_EQ(static_cast<std::size_t>(counted(excerpt.report)) + excerpt.left_out,
              static_cast<std::size_t>(counted(all)));
  }
}

TEST(AnalysisProperty, AnExcerptIsTheStartOfTheFoldedReport) {
  std::size_t repetitions = 0;
  for (const std::uint64_t seed : support::seeds(40)) {
    Random random(seed);
    RandomProgram program(random);
    program.jump_chances = 40;
    program.end_chances = 5'000;
    std::vector<std::string> lines = program.lines(600);
    for (std::string& line : lines)
      if (random.one_in(3))
        line = random.any_of({"G1 X1 B5", "G1 X2 C7", "G00 X3 F500", "12.5 G01 X3", "G94", "G93", "G48"});
    const Document document(support::joined(lines));
    const Analysis analysis(document, kSetup);
    const Report all = folded(analysis.report());
    for (const std::size_t maximum : {0u, 5u, 50u, 300u}) {
      const FirstFindings excerpt = analysis.excerpt({.max = maximum, .folds = true});
      const std::string which = fmt::format("seed {}, at most {}", seed, maximum);
      ASSERT_EQ(excerpt.report.findings.size() + excerpt.left_out, all.findings.size()) << which;
      const std::vector<std::string> texts = support::texts_of(excerpt.report);
      const std::vector<std::string> expected = support::texts_of(all);
      ASSERT_TRUE(std::equal(texts.begin(), texts.end(), expected.begin())) << which;
      for (std::size_t i = 0; i < texts.size(); ++i) {
        const auto theirs = excerpt.report.repetitions_of(excerpt.report.findings[i]);
        const auto ours = all.repetitions_of(all.findings[i]);
        ASSERT_TRUE(std::equal(theirs.begin(), theirs.end(), ours.begin(), ours.end())) << which;
        repetitions += theirs.size();
      }
    }
  }
  EXPECT_GT(repetitions, support::often(1'000));
}

TEST(Analysis, KnowsWhereTheCheckStandsBeforeALine) {
  const Document document("M06 T101001\nG1 X10 F100\nX20\nIF VGPL=1 GOTO N5\nX30\nN5 X40\nM02\n");
  const Analysis analysis(document, kSetup);
  const Frontier before_jump = analysis.frontier_before(3);
  ASSERT_EQ(before_jump.live.size(), 1u);
  EXPECT_EQ(before_jump.live[0].state.position.tip.x(), 20);
  const Frontier skipped = analysis.frontier_before(5);
  EXPECT_EQ(skipped.live.size(), 1u);
  EXPECT_EQ(skipped.waiting().size(), 1u);
  EXPECT_EQ(analysis.frontier_before(6).live.size(), 1u);
  EXPECT_TRUE(analysis.frontier_before(7).finished());
}

void edit_once(Random& random, RandomProgram& program, Document& document) {
  const std::size_t line = random.below(document.line_count());
  switch (random.between(0, 5)) {
    case 0:
      document.replace({line, 0}, {line, document.text_of_line(line).size()}, program.line());
      break;
    case 1:
      document.replace({line, 0}, {line, 0}, program.line() + "\n");
      break;
    case 2:
      document.replace({line, 0}, {line + random.below(3) + 1, 0}, "");
      break;
    case 3:
      document.replace({line, random.below(8)}, {line, random.below(8)},
                       random.any_of({"1", "", "X", "(", " ", "\n", "N3"}));
      break;
    case 4:
      document.replace({line, 0}, {line + random.below(200), 0},
                       random.one_in(3) ? support::joined(program.lines(150)) : "");
      break;
    default:
      document.replace({line, 0}, {line, 1}, "");
      break;
  }
}

/// Edits on moves alone, as a program with G91 has them.
void edit_moves(Random& random, Document& document) {
  const std::size_t line = random.below(document.line_count());
  const std::string move =
      fmt::format("X{}.{:03} Y{}\n", random.between(-9, 9), random.between(0, 999), random.between(-9, 9));
  const std::string any = std::string(
      random.any_of({"G90\n", "G91\n", "G90 X3\nG91\n", "G92 X1\n", "G70\n", "G71\n", "G2 X2 Y0 I1 J0\nG1 Y1\n",
                     "G2 X2 Y0 I1.5 J0\nG1 Y1\n", "G3 X2 Y0 R0.5\nG1 Y1\n", "G90 G3 X5 Y5 R50\nG91 G1 X1\n",
                     "IF VGPL=1 GOTO N7\n", "N7\n", "G29 B90\n", "G27\n"}));
  document.replace({line, 0}, {line + random.below(2), 0}, random.one_in(4) ? any : move);
}

/// Edits a program at random; the analysis that follows gives what a fresh one gives, and what a check of the text
/// gives.
void edit_and_compare(std::uint64_t seed, int lines, int edits, int jump_chances) {
  Random random(seed);
  RandomProgram program(random);
  program.jump_chances = jump_chances;
  if (lines > 200) program.end_chances = 2'000;
  Document document(support::joined(program.lines(lines)));
  Analysis analysis(document, kSetup);
  for (int i = 0; i < edits; ++i) {
    for (int k = random.between(1, 3); k > 0; --k) edit_once(random, program, document);
    const std::string which = fmt::format("seed {}, edit {}", seed, i);
    const Analysis fresh(document, kSetup);
    if (random.one_in(3)) {
      int chunks = random.between(1, 6);
      analysis.update([&] { return --chunks == 0; });
      const Report known = analysis.has_known_findings() ? analysis.report() : Report();
      for (const LocatedFinding& located : known.findings) ASSERT_LT(located.line, document.line_count());
      const std::size_t line = random.below(document.line_count() + 1);
      ASSERT_TRUE(analysis.update_before(line));
      ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << which << ", line " << line;
      if (random.one_in(3)) continue;  // With the next edit.
    }
    analysis.update();
    const std::vector<std::string> report = support::texts_of(analysis.report());
    ASSERT_EQ(report, support::texts_of(fresh.report())) << which << ", fresh analysis";
    const std::size_t line = random.below(document.line_count() + 1);
    ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << which << ", line " << line;
    ASSERT_EQ(report, support::texts_of(check_text(document.text(), kSetup))) << which << ", check of the text";
  }
}

TEST(AnalysisProperty, EditedEqualsFresh) {
  for (const std::uint64_t seed : support::seeds(150)) {
    edit_and_compare(seed, 30, 15, 8);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(AnalysisProperty, EditedEqualsFreshOverManyChunks) {
  for (const std::uint64_t seed : support::seeds(30)) {
    edit_and_compare(1'000 + seed, 900, 12, seed % 2 == 0 ? 15 : 200);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// A line of a program in which much depends on the values of a few registers.
std::string line_with_registers(Random& random, int labels) {
  static constexpr std::string_view kComparisons[] = {"=", "<>", "<", ">", "<=", ">="};
  const auto number = [&] { return fmt::format("{}{}", random.between(-2, 3), random.one_in(3) ? ".5" : ""); };
  const std::string label = random.one_in(6) ? fmt::format("N{} ", random.between(1, labels)) : "";
  switch (random.between(0, 5)) {
    case 0:
      return label + fmt::format("V{}={}", random.between(1, 3), number());
    case 1:
      return label +
             fmt::format("IF {} {} {} GOTO N{}", random.one_in(5) ? "VGPL" : fmt::format("V{}", random.between(1, 3)),
                         kComparisons[random.below(std::size(kComparisons))], number(), random.between(1, labels));
    case 2:
      return label + std::string(random.any_of({"G90", "G91", "G70", "G71", "F500", "G1 X1 X2", "G92 X1", "N3 N4"}));
    default:
      return label + fmt::format("G1 X{} Y{}", random.between(0, 9), random.between(0, 9));
  }
}

/// Changes what a line does to registers, or some digit in it, as fingers do.
void edit_registers(Random& random, Document& document, int labels) {
  const std::size_t line = random.below(document.line_count());
  const std::string text(document.text_of_line(line));
  const std::size_t digit = text.find_first_of("0123456789", random.below(text.size() + 1));
  if (digit != std::string::npos && !random.one_in(3)) {
    document.replace({line, digit}, {line, digit + 1}, fmt::format("{}", random.between(0, 9)));
  } else if (random.one_in(4)) {
    document.replace({line, 0}, {line + random.below(2), 0}, line_with_registers(random, labels) + "\n");
  } else {
    document.replace({line, 0}, {line, text.size()}, line_with_registers(random, labels));
  }
}

TEST(AnalysisProperty, JumpsEditedEqualFresh) {
  for (const std::uint64_t seed : support::seeds(100)) {
    Random random(seed);
    const int lines = random.one_in(2) ? 60 : 1'500;
    const int labels = lines / 6;
    std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\n";
    for (int i = 0; i < lines; ++i) {
      // Labels that mostly rise, so that many jumps find theirs below.
      const bool is_plain = lines > 60 && !random.one_in(10);
      if (i % 6 == 0) text += fmt::format("N{} ", 1 + i / 6);
      text += (is_plain ? fmt::format("X{}", i % 10) : line_with_registers(random, labels)) + "\n";
    }
    Document document(text + "M02\n");
    Analysis analysis(document, kSetup);
    for (int i = 0; i < 25; ++i) {
      for (int k = random.between(1, 3); k > 0; --k) edit_registers(random, document, labels);
      int chunks = random.between(1, 6);
      if (random.one_in(4) && !analysis.update([&] { return --chunks == 0; })) continue;  // With the next edit.
      analysis.update();
      const Analysis fresh(document, kSetup);
      const std::string which = fmt::format("seed {}, edit {}\n{}", seed, i, lines > 60 ? "" : document.text());
      ASSERT_EQ(support::texts_of(analysis.report()), support::texts_of(fresh.report())) << which;
      ASSERT_EQ(support::texts_of(fresh.report()), support::texts_of(check_text(document.text(), kSetup))) << which;
      ASSERT_EQ(analysis.finding_count(), fresh.finding_count()) << which;
      for (std::size_t line = 0; line <= document.line_count(); line += 61)
        ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << which << ", line " << line;
      const std::size_t end = document.line_count();
      ASSERT_EQ(analysis.frontier_before(end), fresh.frontier_before(end)) << which << ", end";
    }
  }
}

/// Whether arcs are suspected depends on others, however far away (W142).
TEST(AnalysisProperty, CentersEditedEqualFresh) {
  std::size_t suspected = 0;
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    const auto line = [&] {
      return std::string(random.any_of({"G00 X110 Y110", "G02 X110 Y110 I-5 J0", "G02 X110 Y110 I-5 J0", "X1 Y2",
                                        "G90 G00 X100 Y100", "G91 G00 X1", "G03 X120 Y100 J10 I10", "G70", "G71",
                                        "IF VGPL=1 GOTO N7", "N7 G00 X110", "G02 X100 Y100 I100 J90", "G01 X3 F500"}));
    };
    std::string text = "M06 T101001\nF1000\n";
    for (int i = 0; i < 1'000; ++i)
      text += (random.one_in(40) ? line() : fmt::format("G90 G71 G00 X110 Y{}", i % 7)) + "\n";
    Document document(text + "M02\n");
    Analysis analysis(document, kSetup);
    for (int i = 0; i < 20; ++i) {
      const std::size_t at = random.below(document.line_count());
      // An arc that fits only with its center counted from the start comes, or one of them goes.
      const std::string arc = random.one_in(3) ? "G90 G00 X110 Y110\nG02 X120 Y120 I10 J0\n" : line() + "\n";
      document.replace({at, 0}, {at, 0}, arc);
      const std::size_t found = document.text().find("G02 X120 Y120 I10 J0");
      if (random.one_in(2) && found != std::string::npos) {
        const std::string all = document.text();
        const auto number =
            static_cast<std::size_t>(std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
        document.replace({number, 0}, {number + 1, 0}, "");
      }
      int chunks = random.between(1, 6);
      if (random.one_in(4) && !analysis.update([&] { return --chunks == 0; })) continue;  // With the next edit.
      analysis.update();
      const std::vector<std::string> report = support::texts_of(analysis.report());
      const std::string which = fmt::format("seed {}, edit {}", seed, i);
      ASSERT_EQ(report, support::texts_of(Analysis(document, kSetup).report())) << which;
      ASSERT_EQ(report, support::texts_of(check_text(document.text(), kSetup))) << which;
      suspected += analysis.suspects_centers() ? 1 : 0;
    }
  }
  EXPECT_GT(suspected, support::often(200));
  EXPECT_LT(suspected, support::often(1'000));
}

TEST(AnalysisProperty, ShiftedEqualsFresh) {
  for (const std::uint64_t seed : support::seeds(25)) {
    Random random(seed);
    Document document(incremental_zigzag(2'500));
    Analysis analysis(document, kSetup);
    for (int i = 0; i < 20; ++i) {
      edit_moves(random, document);
      analysis.update();
      const Analysis fresh(document, kSetup);
      const std::string which = fmt::format("seed {}, edit {}", seed, i);
      ASSERT_EQ(support::texts_of(analysis.report()), support::texts_of(fresh.report())) << which;
      for (std::size_t line = 0; line < document.line_count(); line += 101)
        ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << which << ", line " << line;
    }
  }
}

/// A G27 without its G leaves the face all the same, and so turns the position of all axes.
TEST(Analysis, AShiftEndsWhereAFaceIsLeftByMistake) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F800\nG29 X1 B45 C90\nG91\nX1\n";
  for (int i = 0; i < 200; ++i) text += "Z1\n";
  text += "27\n";
  for (int i = 0; i < 200; ++i) text += "Z1\n";
  Document document(text + "M02\n");
  Analysis analysis(document, kSetup);
  document.replace({4, 1}, {4, 2}, "2");
  analysis.update();
  const Analysis fresh(document, kSetup);
  for (const std::size_t line : {100u, 256u, 384u})
    EXPECT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << line;
}

/// A `=` without its register may assign any of them: no W121 where an IF is typed that compares one.
TEST(Analysis, AnAssignmentWithoutItsRegisterIsSeenByAnIfTypedLater) {
  std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F800\n=G1 Z0\n";
  for (int i = 0; i < 200; ++i) text += "X1\n";
  text += "X2\n";
  for (int i = 0; i < 150; ++i) text += "X1\n";
  Document document(text + "N8 X5\nM02\n");
  Analysis analysis(document, kSetup);
  document.replace({203, 0}, {203, 2}, "IF V1>0.5 GOTO N8");
  analysis.update();
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

/// House rules that plain motions start, or that depend on the tool, the feed and the depth.
rules::CheckSetup house_setup(Random& random) {
  using Kind = dialect::HouseEvent::Kind;
  using dialect::HouseWatch;
  const auto tools = [&] {
    return random.one_in(3) ? std::vector<dialect::ToolRange>{} : std::vector<dialect::ToolRange>{{101'002, 101'002}};
  };
  std::vector<HouseWatch> watches;
  if (random.one_in(2))
    watches.push_back({.rule = "coolant",
                       .reported = {{.kind = Kind::M, .number = 8}},
                       .started = {{.kind = random.one_in(2) ? Kind::Motion : Kind::Cut}},
                       .ended = {{.kind = Kind::M, .number = 9}}});
  if (random.one_in(2))
    watches.push_back(
        {.rule = "feed", .kind = HouseWatch::Kind::Feed, .minimum = 400, .maximum = 900, .tools = tools()});
  if (random.one_in(2))
    watches.push_back({.rule = "speed", .kind = HouseWatch::Kind::Speed, .maximum = 6'000, .tools = tools()});
  if (random.one_in(3))
    watches.push_back({.rule = "depth", .kind = HouseWatch::Kind::Depth, .minimum = 0, .tools = tools()});
  rules::CheckSetup setup;
  if (!watches.empty()) setup.house_rules = std::make_shared<rules::HouseRules>(watches);
  return setup;
}

/// Compares an analysis with a fresh one.
void expect_as_fresh(const Analysis& analysis, const Document& document, const rules::CheckSetup& setup,
                     const std::string& which) {
  const Analysis fresh(document, setup);
  ASSERT_EQ(support::texts_of(analysis.report()), support::texts_of(fresh.report())) << which;
  for (std::size_t chunk = 0; chunk <= document.chunk_count(); ++chunk) {
    const std::size_t line =
        chunk < document.chunk_count() ? document.first_line_of_chunk(chunk) : document.line_count();
    ASSERT_EQ(analysis.frontier_before(line), fresh.frontier_before(line)) << which << ", line " << line;
  }
}

/// What a line leaves for the next motions, where these are in another chunk than the line.
TEST(Analysis, TheLastLineOfAChunkCountsForThoseBelow) {
  using Kind = dialect::HouseEvent::Kind;
  using dialect::HouseWatch;
  const std::vector<dialect::ToolRange> second = {{101'002, 101'002}};
  rules::CheckSetup setup;
  setup.house_rules = std::make_shared<rules::HouseRules>(std::vector<HouseWatch>{
      {.rule = "coolant",
       .reported = {{.kind = Kind::M, .number = 8}},
       .started = {{.kind = Kind::Cut}},
       .ended = {{.kind = Kind::M, .number = 9}}},
      {.rule = "clamp", .reported = {{.kind = Kind::Cut}}, .started = {{.kind = Kind::M, .number = 10}}},
      {.rule = "feed", .kind = HouseWatch::Kind::Feed, .minimum = 900, .tools = second},
      {.rule = "depth", .kind = HouseWatch::Kind::Depth, .minimum = -1, .tools = {{101'003, 101'003}}}});
  std::string text = "M06 T101001\nS5000 M03\nG90 G1 X0 Y0 Z0 F1000\n";
  for (int i = 3; i < 127; ++i) text += "X1\n";
  text += "G90\n";  // The line that is edited.
  for (int i = 128; i < 2'000; ++i) text += fmt::format("X{} Z{}{}\n", i % 50, i % 7 - 3, i % 60 == 0 ? " F800" : "");
  text += "M08\nM06 T101001\nM02\n";
  for (const char* const line : {"M05", "M09", "M10", "M06 T101002", "M06 T101003", "M06 T101004", "M05 M06 T101002",
                                 "G41", "S7000", "F2000", "G92 Z1", "G04 F1"}) {
    Document document(text);
    Analysis analysis(document, setup);
    ASSERT_EQ(document.first_line_of_chunk(1), 128u);
    document.replace({127, 0}, {127, 3}, line);
    analysis.update();
    expect_as_fresh(analysis, document, setup, line);
  }
}

/// A word that changes what the lines below do, or half of one.
std::string lasting_word(Random& random) {
  static constexpr std::string_view kWords[] = {"G41",         "G42",          "G40",
                                                "S5000",       "S9000",        "M03",
                                                "M04",         "M05",          "M08",
                                                "M09",         "M10",          "F500",
                                                "F1000",       "G17",          "G18",
                                                "G19",         "G38",          "G39",
                                                "G27",         "G48",          "G49",
                                                "G93",         "G94",          "G91",
                                                "G90",         "G70",          "G71",
                                                "G",           "G4",           "G1",
                                                "S",           "N7",           "27",
                                                "M0",          "G92 X1 Y1 Z0", "T101002 M06",
                                                "T101001 M06", "G29 B90",      "IF VGPL=1 GOTO N7"};
  return std::string(kWords[random.below(std::size(kWords))]);
}

/// A line of a row of plain motions of some kind.
std::string line_of_row(int kind, int i, Random& random) {
  if (random.one_in(100)) return fmt::format("X{} F{}", i % 5, random.one_in(2) ? 700 : 500);
  switch (kind) {
    case 0:
      return fmt::format("X{} Y{}", i % 50, i % 30);
    case 1:
      return i % 3 == 0 ? fmt::format("G2 X{} Y{} R90", i % 20, i % 3) : fmt::format("G1 X{}", i % 7);
    case 2:
      return i % 3 == 0 ? fmt::format("G3 X{} Z{} R90", i % 20, i % 3) : fmt::format("G1 Z{}", i % 7);
    case 3:
      return i % 3 == 0 ? fmt::format("G2 Y{} Z{} R90", i % 20, i % 3) : fmt::format("G1 Y{}", i % 7);
    case 4:
      return i % 3 == 0 ? fmt::format("X{} B{} C{}", i % 50, i % 30, i % 20) : fmt::format("Y{}", i % 7);
    case 5:
      return i % 2 == 0 ? fmt::format("G0 Z{}", i % 9) : "G1 Z-1";
    default:
      return i % 2 == 0 ? "(note)" : fmt::format("N{}", i);
  }
}

/// Edits of the line above some rows of plain motions: what it changes passes through the chunks of these.
TEST(AnalysisProperty, PassedThroughRowsEqualsFresh) {
  std::uint64_t checked = 0;
  for (const std::uint64_t seed : support::seeds(120)) {
    Random random(seed);
    const rules::CheckSetup setup = house_setup(random);
    std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0\nF1000\nS5000 M03\n";
    const int kind = random.between(0, 5);
    text += kind == 2 ? "G18\n" : kind == 3 ? "G19\n" : kind == 4 ? "G49\n" : "G17\n";
    text += random.one_in(4) ? "G91\n" : "G90\n";
    for (int i = 6; i < 128; ++i) text += "(note)\n";
    const int rows = random.between(2, 4);
    for (int i = 0; i < 128 * rows; ++i)
      text += line_of_row(random.one_in(400) ? random.between(0, 6) : kind, i, random) + "\n";
    Document document(text + "N7 X5\nT101002 M06\nG4 F1\nM08\nG27\nM02\n");
    Analysis analysis(document, setup);
    for (int i = 0; i < 20; ++i) {
      const std::size_t line = 127 - random.below(2);
      document.replace({line, 0}, {line, document.text_of_line(line).size()},
                       random.one_in(2) ? "(note)" : lasting_word(random));
      int chunks = random.between(1, 6);
      if (random.one_in(4) && !analysis.update([&] { return --chunks == 0; })) continue;  // With the next edit.
      analysis.update();
      checked += analysis.lines_checked();
      expect_as_fresh(analysis, document, setup, fmt::format("seed {}, edit {}", seed, i));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_LT(checked, support::often(120) * 20 * 400);
}

/// Edits of what lasts, in a program of plain motions with little between them.
TEST(AnalysisProperty, PassedOnEqualsFresh) {
  for (const std::uint64_t seed : support::seeds(60)) {
    Random random(seed);
    const rules::CheckSetup setup = house_setup(random);
    const auto motion = [&](int i) {
      if (random.one_in(700)) return lasting_word(random);
      if (random.one_in(200)) return fmt::format("G2 X{} Y{} R90\nG1 X1", i % 50, i % 40);
      if (random.one_in(80)) return fmt::format("G0 Z{}\nG1 Z{}", i % 9, -(i % 3));
      return fmt::format("X{} Y{}{}", i % 50, i % 70, random.one_in(80) ? " F800" : "");
    };
    std::string text = "M06 T101001\nG90 G1 X0 Y0 Z0 F1000\n";
    for (int i = 0; i < 2'000; ++i) text += motion(i) + "\n";
    Document document(text + "M02\n");
    Analysis analysis(document, setup);
    for (int i = 0; i < 25; ++i) {
      for (int k = random.between(1, 2); k > 0; --k) {
        std::size_t line = random.below(document.line_count());
        // What is remembered up to the next motion is remembered beyond the end of a chunk.
        if (random.one_in(2)) line = document.first_line_of_chunk(document.chunk_of_line(line)) - random.below(2);
        line = std::min(line, document.line_count());
        document.replace({line, 0}, {line + random.below(2), 0}, random.one_in(5) ? "" : lasting_word(random) + "\n");
      }
      int chunks = random.between(1, 6);
      if (random.one_in(4) && !analysis.update([&] { return --chunks == 0; })) continue;  // With the next edit.
      analysis.update();
      expect_as_fresh(analysis, document, setup, fmt::format("seed {}, edit {}", seed, i));
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

/// Where there are too many states, axes in which they differ become unknown. That no shift of positions passes on.
TEST(Analysis, ChecksReductionsAgain) {
  std::string text = "M06 T101001\nM03 S12000\nG91\nG01 X1 Y1 F1000\n";
  const auto add_rows = [&](int count) {
    for (int i = 0; i < count; ++i) text += "X0.5 Y0.25\n";
  };
  add_rows(300);
  for (int i = 0; i < 10; ++i)
    text += fmt::format("IF VGPL={} GOTO N{}\nX{}\nN{} Z0.001\n", i + 1, 10 + i, 1 << i, 10 + i);
  add_rows(550);
  text += "IF VGPL=20 GOTO N50\nX\nM06 T101002\nN50 M06 T101003\nM03 S12000\n";
  add_rows(300);
  text += "M05\nM02\n";
  syntax::Document document(text);
  Analysis analysis(document, kSetup);
  document.replace({5, 0}, {5, 4}, "X1.5");
  analysis.update();
  EXPECT_EQ(support::texts_of(analysis.report()), support::texts_of(check_text(document.text(), kSetup)));
}

}  // namespace
}  // namespace isocnc::check
