#include "analyzer/formatting/program_formatter.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace isocnc::formatting {
namespace {

std::string format(std::string_view text, const ProgramStyle& style) {
  ProgramFormatter formatter(text, style);
  std::string formatted;
  while (const auto piece = formatter.next()) formatted += piece->after;
  return formatted;
}

const ProgramStyle kWrite{.motions = MotionStyle::Write};
const ProgramStyle kFold{.motions = MotionStyle::Fold};
const ProgramStyle kTens{.numbers = NumberStyle{}};
const ProgramStyle kAllTens{.numbers = NumberStyle{.all_lines = true}};

TEST(ProgramFormatter, KeepsLineEndsAndTheLackOfOne) {
  EXPECT_EQ(format("g1x1 \r\n\rg1x2\n\n m02", {}), "G1 X1\r\n\rG1 X2\n\nM02");
  EXPECT_EQ(format("", {}), "");
  EXPECT_EQ(format(" ", {}), "");
  EXPECT_EQ(format("\n", {}), "\n");
}

/// CR and LF together end one line.
TEST(ProgramFormatter, KeepsBlanksBetweenLineEnds) {
  EXPECT_EQ(format("G1 X1\r \nG1 X2 \r\n \n", {}), "G1 X1\r \nG1 X2\r\n\n");
}

TEST(ProgramFormatter, PiecesMakeUpTheProgram) {
  std::string text;
  std::string expected;
  while (text.size() < 300'000) {
    text += "G1 X1 Y2\ng1y3\nZ1 ; note\n";
    expected += "G1 X1 Y2\nG1 Y3\nZ1 ; note\n";
  }
  EXPECT_TRUE(format(text, {}) == expected);
}

TEST(ProgramFormatter, WritesTheMotionInForce) {
  EXPECT_EQ(format("X1\nG0 X1\nX2\nG1 F5\nX3 F5\nG17\nN5 G90 Y3\nG3 X1 R5\nX2 R5\n", kWrite),
            "X1\nG0 X1\nG00 X2\nG1 F5\nX3 F5\nG17\nN5 G90 Y3\nG3 X1 R5\nG03 X2 R5\n");
}

TEST(ProgramFormatter, FoldsRepeatedMotions) {
  EXPECT_EQ(format("G0 X1\nG00 X2\nG1 X3 F5\nG41 G1 X4\nG1 X5 G40\nS5 G01 X6 G09\nG0 X1\n", kFold),
            "G0 X1\nX2\nG1 X3 F5\nG41 X4\nX5 G40\nS5 X6 G09\nG0 X1\n");
}

/// A comment after a G that is removed is before the words that remain.
TEST(ProgramFormatter, OrdersWhatIsLeftAfterAFoldedMotion) {
  const ProgramStyle style{.line = {.word_order = true}, .motions = MotionStyle::Fold};
  const std::string once = format("G01 X1 F500\nG01 (lap) Y5 X2\nG90 G01 (lap) Y5 X2\nN5 G01 (lap) Y5 X2\n", style);
  EXPECT_EQ(once, "G01 X1 F500\n(lap) X2 Y5\nG90 (lap) Y5 X2\nN5 (lap) Y5 X2\n");
  EXPECT_EQ(format(once, style), once);
}

TEST(ProgramFormatter, TouchesNoMotionWherePathsDisagree) {
  const std::string text =
      "G0 X1\n"
      "IF VGPL = 1 GOTO N10\n"
      "G1 X2 F5\n"
      "N10 X3\n"
      "G1 X4\n"
      "G1 X5\n";
  EXPECT_EQ(format(text, kWrite), text);
  EXPECT_EQ(format(text, kFold), text.substr(0, text.size() - 6) + "X5\n");
}

TEST(ProgramFormatter, FollowsMotionsWherePathsAgree) {
  EXPECT_EQ(format("G1 X1 F5\nIF V1 = 1 GOTO N10\nG0 X2\nM02\nX3\nN10 X3\n", kWrite),
            "G1 X1 F5\nIF V1 = 1 GOTO N10\nG0 X2\nM02\nX3\nN10 G01 X3\n");
  EXPECT_EQ(format("G1 X1 F5\nIF V1 = 1 GOTO N10\nG0 X2\nM02\nG1 X3\nN10 G1 X3\n", kFold),
            "G1 X1 F5\nIF V1 = 1 GOTO N10\nG0 X2\nM02\nG1 X3\nN10 X3\n");
}

TEST(ProgramFormatter, TouchesNoMotionAfterAnError) {
  EXPECT_EQ(format("G1 X1 F5\nG77 X1\nX2\nG1 X3\nX4\n", kWrite), "G1 X1 F5\nG77 X1\nX2\nG1 X3\nG01 X4\n");
  EXPECT_EQ(format("G1 X1 F5\nG1 X1 X2\nG1 X3\nG1 X4\n", kFold), "G1 X1 F5\nG1 X1 X2\nG1 X3\nX4\n");
}

/// Words that the line above lacks belong to its block, and stay without a motion of their own.
TEST(ProgramFormatter, LeavesTheWordsThatTheLineAboveLacks) {
  EXPECT_EQ(format("G1 F5\nX1\nX2\nG2 X4\n; (1)\nY2 I1 J1\nX6 R1\n", kWrite),
            "G1 F5\nX1\nX2\nG2 X4\n; (1)\nY2 I1 J1\nG02 X6 R1\n");
  EXPECT_EQ(format("G1 X1 F5\nG1\nG1 X2\nG1 X3\nG2 X4\nG2 Y2 I1 J1\nG2 X6 R1\n", kFold),
            "G1 X1 F5\nG1\nG1 X2\nX3\nG2 X4\nG2 Y2 I1 J1\nX6 R1\n");
  EXPECT_EQ(format("G2 X4 Y0 I2 J0 F5\nX8 I6\nJ0 Y0\nX12 R2\nX16 R2\n", kWrite),
            "G2 X4 Y0 I2 J0 F5\nX8 I6\nJ0 Y0\nX12 R2\nG02 X16 R2\n");
  const ProgramStyle numbered{.numbers = NumberStyle{.all_lines = true}};
  EXPECT_EQ(format("G1 X1 F5\nG1\nX2\nX3\nG2 X4\nY2 I1 J1\nX6 R1\nM06\nT101001\nG1\nM05\n", numbered),
            "N10 G1 X1 F5\nG1\nX2\nN20 X3\nN30 G2 X4\nY2 I1 J1\nN40 X6 R1\nM06\nT101001\nG1\nN50 M05\n");
}

/// Such words stay at the start of their line.
TEST(ProgramFormatter, LeavesTheOrderOfWhatTheLineAboveLacks) {
  const ProgramStyle ordered{.line = {.word_order = true}};
  EXPECT_EQ(format("G02 X60 Y20 TH R10\nF5 G01 X80\nF6 G01 X90\n", ordered),
            "G02 X60 Y20 TH R10\nF5 G01 X80\nG01 X90 F6\n");
  EXPECT_EQ(format("G1\nY2 X1\nY4 X3\n", ordered), "G1\nY2 X1\nX3 Y4\n");
}

TEST(ProgramFormatter, LeavesMotionsThatCannotTakeWhatStandsThere) {
  const std::string text = "G1 X1 F5\nX2 I5\nI5\nA5 X1\n";
  EXPECT_EQ(format(text, kWrite), text);
}

TEST(ProgramFormatter, RenumbersLinesThatHaveANumber) {
  EXPECT_EQ(format("N3 G0 X1\nX2\nN3 X4\nIF V1 = 1 GOTO N007\nn1 x3\nN7 M02\n", kTens),
            "N10 G0 X1\nX2\nN20 X4\nIF V1 = 1 GOTO N40\nN30 X3\nN40 M02\n");
}

TEST(ProgramFormatter, RenumbersEveryBlock) {
  EXPECT_EQ(format("(head)\nG0 X1\n\nN5\nIF V1 = 1 GOTO N5\nM02\n", kAllTens),
            "(head)\nN10 G0 X1\n\nN20\nN30 IF V1 = 1 GOTO N20\nN40 M02\n");
  EXPECT_EQ(format("G0 X1\nG0 X1 X2\nM02\n", kAllTens), "N10 G0 X1\nG0 X1 X2\nN20 M02\n");
}

TEST(ProgramFormatter, FollowsLabelsOfAnyLength) {
  EXPECT_EQ(format("IF V1 = 1 GOTO N00012345678901234567890\nN12345678901234567890 M02\n", kTens),
            "IF V1 = 1 GOTO N10\nN10 M02\n");
}

std::string obstacle(std::string_view text, NumberStyle style = {}) {
  const ProgramFormatter formatter(text, {.numbers = style});
  return formatter.obstacle() ? formatter.obstacle()->message(dialect::Language::English) : "";
}

TEST(ProgramFormatter, RefusesToRenumberWhatIsAmbiguous) {
  EXPECT_EQ(obstacle("IF V1 = 1 GOTO N7\nN7 X1\nN07 X2\n"),
            "line 3 is one more N7, to which a jump leads; which of them is meant?");
  EXPECT_EQ(obstacle("IF V1 = 1 GOTO N8\nN7 X1\n"), "line 1 jumps to N8, which is no line's number");
  EXPECT_EQ(obstacle("G0 X1\nN7 X1 X2\n"), "line 2 has an error and a line number or a jump; correct it first");
  EXPECT_EQ(obstacle("IF V1 GOTO N8\nN8 X1\n"), "line 1 has an error and a line number or a jump; correct it first");
  EXPECT_EQ(obstacle("N1\nN2\n", {.start = 999'999'999'999'999}), "line 2 would have a number of more than 15 digits");
  EXPECT_EQ(obstacle("N7 X1\nN7 X2\nG0 X1 X2\n"), "");
  EXPECT_EQ(format("IF V1 = 1 GOTO N8\nn7 x1\n", kTens), "");
}

}  // namespace
}  // namespace isocnc::formatting
