#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analyzer/check/check_text.h"
#include "tests/support/report_text.h"

/// Programs with so many paths that following each would never end. None of these tests measures time; each would run
/// into its limit.
namespace isocnc::check {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> codes(const Report& report) {
  std::vector<std::string> all;
  for (const LocatedFinding& located : report.findings)
    if (const std::string_view code = dialect::definition(located.finding.id).code; !support::is_lint(code))
      all.emplace_back(code);
  return all;
}

Report check_on_paths(const std::string& text) { return check_text(text, {}); }

/// An operation that IF skips, as macros for optional borings do.
std::string skippable(int number, const std::string& operation) {
  return fmt::format("IF VGPL={0} GOTO N{0}\n{1}\nN{0}\n", number, operation);
}

constexpr const char* kHead = "M06 T101001\nG1 X0 Y0 Z50 F1000\n";

TEST(ManyPaths, OperationsThatReturnStayExact) {
  std::string text = kHead;
  for (int i = 1; i <= 300; ++i) text += skippable(i, fmt::format("G0 X{} Y{}\nG1 Z-5\nG0 X0 Y0 Z50", i, i % 7));
  text += "G2 X0 Y0 I10 J0\nG2 X0 Y0 I0 J0\nM02\n";
  EXPECT_THAT(codes(check_on_paths(text)), ElementsAre("ISO031"));
}

/// Each leaves the tool elsewhere, so there are 301 places where it may be.
TEST(ManyPaths, OperationsThatEndElsewhereStayExact) {
  std::string text = kHead;
  for (int i = 1; i <= 300; ++i) text += skippable(i, fmt::format("G0 X{} Y{}\nG1 Z-5\nG0 Z50", i, i % 7));
  text += "G2 X0 Y0 I0 J0\nM02\n";
  const Report report = check_on_paths(text);
  EXPECT_THAT(codes(report), ElementsAre("ISO031"));
}

TEST(ManyPaths, AMistakeInEachOperationIsFoundOnce) {
  std::string text = kHead;
  for (int i = 1; i <= 300; ++i) text += skippable(i, "G0 X1 Y1\nG2 X1 Y9 R1\nG0 X0 Y0 Z50");
  const Report report = check_on_paths(text + "M02\n");
  EXPECT_EQ(report.findings.size(), 300u);
  for (const LocatedFinding& located : report.findings)
    EXPECT_EQ(dialect::definition(located.finding.id).code, "ISO030");
}

/// 5,000 IFs to 5,000 labels in reverse order: every one is waited for while all others are passed.
TEST(ManyPaths, ThousandsOfCrossingJumpsEnd) {
  std::string text = kHead;
  for (int i = 1; i <= 5'000; ++i) text += fmt::format("IF VGPL={0} GOTO N{0}\nG1 X{0} Y{1}\n", i, i % 13);
  for (int i = 5'000; i >= 1; --i) text += fmt::format("N{} G1 X{} Z{}\n", i, i, i % 17);
  const std::vector<std::string> found = codes(check_on_paths(text + "M02\n"));
  EXPECT_LE(std::count(found.begin(), found.end(), "W191"), 1);
  EXPECT_LE(found.size(), 1u);
}

/// The last label is after the end, where the jumps alone lead: if that one is given up, nothing is said of what is
/// there, and not that it never runs either.
TEST(ManyPaths, LabelsThatAreWaitedForHaveABound) {
  const auto found_with = [](int labels) {
    std::string text = kHead;
    for (int i = 1; i <= labels; ++i) text += fmt::format("IF VGPL={0} GOTO N{0}\n", i);
    for (int i = 1; i < labels; ++i) text += fmt::format("N{} G1 X1\n", i);
    std::vector<std::string> found;
    for (const LocatedFinding& located : check_on_paths(text + fmt::format("M02\nN{} G80\nM02\n", labels)).findings)
      found.emplace_back(dialect::definition(located.finding.id).code);
    return found;
  };
  EXPECT_THAT(found_with(16'000), ElementsAre("E001"));
  EXPECT_THAT(found_with(17'000), ElementsAre("W191"));
}

TEST(ManyPaths, CrossingJumpsOnRegistersEnd) {
  std::string text = kHead;
  for (int i = 1; i <= 2'000; ++i)
    text += fmt::format("IF V{0}={1} GOTO N{2}\nG1 X{2}\nV{0}={1}\n", i % 30 + 1, i % 11, i);
  for (int i = 2'000; i >= 1; --i) text += fmt::format("N{} G1 Y{}\n", i, i % 17);
  EXPECT_LE(codes(check_on_paths(text + "M02\n")).size(), 1u);
}

/// A few paths are followed as long as it takes: what is found after them must not depend on how long they are.
TEST(ManyPaths, AFewStatesStayExactOverALongProgram) {
  std::string text = std::string(kHead) + "G91\n";
  for (int i = 1; i <= 5; ++i) text += skippable(i, fmt::format("G1 X{0} Y0.5\nX0.25\nY{0}", i * i));
  for (int i = 0; i < 40'000; ++i) text += "X0.1\n";
  text += "G90\nG1 X0 Y0\nG2 X10 Y10 I5 J5\nG2 X20 Y10 I10 J9\nM02\n";
  EXPECT_THAT(codes(check_on_paths(text)), ElementsAre("ISO031"));
}

/// Jumps that cross all the way down: once paths have been given up, each line costs little.
TEST(ManyPaths, CrossingIncrementalJumpsEnd) {
  std::string text = std::string(kHead) + "G91\n";
  for (int i = 1; i <= 20'000; ++i)
    text += fmt::format("IF VGPL={0} GOTO N{1}\nN{0} G1 X{2}\n", i, i + 1 + i * 7 % 50, i % 13);
  for (int i = 20'001; i <= 20'052; ++i) text += fmt::format("N{} G1 X1\n", i);
  EXPECT_THAT(codes(check_on_paths(text + "M02\n")), ElementsAre("W191"));
}

/// Each move may be skipped and each sum is another place: 2^200 positions.
TEST(ManyPaths, DiamondsOfIncrementalMovesEnd) {
  std::string text = std::string(kHead) + "G91\n";
  double step = 0.001;
  for (int i = 1; i <= 200; ++i, step *= 1.1) text += skippable(i, fmt::format("G1 X{:.6f} Y{:.6f}", step, step * i));
  EXPECT_THAT(codes(check_on_paths(text + "M02\n")), ElementsAre("W191"));
}

TEST(ManyPaths, WhatIsGivenUpCausesNoFinding) {
  std::string text = std::string(kHead) + "G91\n";
  for (int i = 1; i <= 200; ++i) text += skippable(i, fmt::format("G1 X{}.{:03}", i, i));
  text += "G2 X10 Y0 I5 J0\nG90\nG1 X0 Y0 Z0\nG2 X10 Y0 I5 J0\nG2 X20 Y0 I14 J0\nM02\n";
  EXPECT_THAT(codes(check_on_paths(text)), ElementsAre("W191", "ISO031"));
}

/// A state with more in it than a position: modes that each may or may not be set.
TEST(ManyPaths, DiamondsOfModesEnd) {
  const char* const modes[] = {"G18", "G91", "G70", "G93", "G39", "G41", "G49", "G92 X5", "G29 B90", "S100"};
  std::string text = kHead;
  for (int i = 1; i <= 200; ++i) text += skippable(i, fmt::format("{}\nG0 X{} Y{}", modes[i % 10], i, i * i % 31));
  const std::vector<std::string> found = codes(check_on_paths(text + "M02\n"));
  EXPECT_LE(std::count(found.begin(), found.end(), "W191"), 1);
}

/// Registers that each may or may not have been set: 2^25 valuations.
TEST(ManyPaths, DiamondsOfAssignmentsEnd) {
  std::string text = kHead;
  for (int i = 1; i <= 25; ++i) text += skippable(i, fmt::format("V{}=1", i));
  for (int i = 1; i <= 25; ++i) text += fmt::format("IF V{0}=1 GOTO N{1}\nG1 X{0} Y{0}\nN{1}\n", i, 100 + i);
  EXPECT_LE(codes(check_on_paths(text + "M02\n")).size(), 1u);
}

TEST(ManyPaths, ConditionsThatAgreeStayExact) {
  std::string text = kHead;
  for (int i = 1; i <= 300; ++i) text += fmt::format("IF V1=1 GOTO N{0}\nG0 X{0}\nN{0}\n", i);
  text += "IF V1<>1 GOTO N999\nG0 X0 Y0\nG2 X0 Y5 I9 J9\nN999\nM02\n";
  EXPECT_THAT(codes(check_on_paths(text)), ElementsAre("ISO031"));
}

}  // namespace
}  // namespace isocnc::check
