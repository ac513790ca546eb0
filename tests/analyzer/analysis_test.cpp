#include "analyzer/analysis.h"

#include <gtest/gtest.h>

#include "analyzer/check_text.h"
#include "tests/support/random_program.h"
#include "tests/support/report_text.h"

namespace isocnc::analyzer {
namespace {

using support::Random;
using support::RandomProgram;
using syntax::Document;

const execution::Setup kSetup;

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

TEST(Analysis, AnEditDoesNotRunTheLinesFarBehindItAgain) {
  Document document(zigzag(20'000));
  Analysis analysis(document, kSetup);
  document.replace({5'000, 4}, {5'000, 5}, "7");
  analysis.update();
  EXPECT_LE(analysis.lines_checked(), 600u);
  EXPECT_TRUE(analysis.report().findings.empty());
}

TEST(Analysis, FindingsBehindAnInsertedLineMoveWithoutBeingCheckedAgain) {
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

TEST(Analysis, KnowsWhereTheCheckStandsBeforeALine) {
  const Document document("M06 T101001\nG1 X10 F100\nX20\nIF VGPL=1 GOTO N5\nX30\nN5 X40\nM02\n");
  const Analysis analysis(document, kSetup);
  const Frontier before_jump = analysis.frontier_before(3);
  ASSERT_EQ(before_jump.live.size(), 1u);
  EXPECT_EQ(before_jump.live[0].state.position.tip.x(), 20);
  const Frontier skipped = analysis.frontier_before(5);
  EXPECT_EQ(skipped.live.size(), 1u);
  EXPECT_EQ(skipped.waiting.size(), 1u);
  EXPECT_EQ(analysis.frontier_before(6).live.size(), 1u);
  EXPECT_TRUE(analysis.frontier_before(7).finished());
}

void edit_once(Random& random, RandomProgram& program, Document& document) {
  const std::size_t line = random.below(document.line_count());
  switch (random.between(0, 5)) {
    case 0:
      document.replace({line, 0}, {line, document.line(line).text.size()}, program.line());
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
    analysis.update();
    const std::vector<std::string> report = support::texts_of(analysis.report());
    const std::string which = fmt::format("seed {}, edit {}", seed, i);
    ASSERT_EQ(report, support::texts_of(Analysis(document, kSetup).report())) << which << ", fresh analysis";
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

}  // namespace
}  // namespace isocnc::analyzer
