#include "interpreter/syntax/formatter.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace isocnc::syntax {
namespace {

struct FormatCase {
  std::string_view before;
  std::string_view after;
};

void expect_all(const LineStyle& style, const std::vector<FormatCase>& cases) {
  for (const auto& [before, after] : cases) {
    EXPECT_EQ(formatted(before, style), after) << "of " << before;
    EXPECT_EQ(formatted(after, style), after) << "a second time";
  }
}

TEST(Formatter, WritesUpperCaseAndOneBlankBetweenWords) {
  expect_all({}, {
                     {"", ""},
                     {" \t ", ""},
                     {"G 0 1 X - 5 . 0", "G01 X-5.0"},
                     {"g0z-5.65", "G0 Z-5.65"},
                     {"  n10  g1\tx+5.  y.5 f1e", "  n10  g1\tx+5.  y.5 f1e"},
                     {"  n10  g1\tx+5.  y.5  ", "N10 G1 X+5. Y.5"},
                     {"M 06 T 1 30 207", "M06 T130207"},
                     {"v25=78.99", "V25 = 78.99"},
                     {"V1=0V2=3.5G0X10", "V1 = 0 V2 = 3.5 G0 X10"},
                     {"M100 P 1 = 2.5P2=-3", "M100 P1=2.5 P2=-3"},
                     {"ifv1=1goton30", "IF V1 = 1 GOTO N30"},
                     {"N10 I F V G P L < > 1.50 G O T O N 3 0", "N10 IF VGPL <> 1.50 GOTO N30"},
                     {"IF V5<=18GOTO N80 N5", "IF V5 <= 18 GOTO N80 N5"},
                 });
}

TEST(Formatter, KeepsCommentsByteForByte) {
  expect_all({}, {
                     {"g1x5(Caf\xE9  g1)y2", "G1 X5 (Caf\xE9  g1) Y2"},
                     {"X(a)10", "X10 (a)"},
                     {"X1(a)0(b)Y2", "X10 (a) (b) Y2"},
                     {"G(a)0(b)1 X(c)-(d)5;e  ", "G01 (a) (b) X-5 (c) (d) ;e  "},
                     {"V1(a)=(b)5", "V1 (a) = 5 (b)"},
                     {"M100 P1(a)=(b)2", "M100 P1=2 (a) (b)"},
                     {"I(a)F V1<(b)=1 GO(c)TO N3", "IF (a) V1 <= (b) 1 GOTO (c) N3"},
                     {"(a)(b)", "(a) (b)"},
                     {"(a); b (", "(a) ; b ("},
                     {"(( ;) g1x1 ", "(( ;) G1 X1"},
                 });
}

TEST(Formatter, LeavesCommentsAtTheEndInTheirColumn) {
  expect_all({}, {
                     {"  ; as it stands", "  ; as it stands"},
                     {"\t(tab)  ", "\t(tab)"},
                     {"g1x1      ; kept", "G1 X1     ; kept"},
                     {"g1x1 ; one blank", "G1 X1 ; one blank"},
                     {"g1x1; none", "G1 X1 ; none"},
                     {"g1x1y1z1  ; pushed on", "G1 X1 Y1 Z1 ; pushed on"},
                     {"G1     X1      ; kept", "G1 X1          ; kept"},
                     {"g1x1\t\t; tabs", "G1 X1\t\t; tabs"},
                     {"g1x1   (a)  (b)", "G1 X1  (a)  (b)"},
                     {"g1   (a)   x1", "G1 (a) X1"},
                 });
}

TEST(Formatter, LeavesLinesWithAnErrorAlone) {
  for (const std::string_view line :
       {"g1  x1.2.3 ", " g1 x1  x2", "g1 (open ", "g77  x1", "x  ", "\xC3\xA8 x1 ", "if v1 ", "m02  x1", "%  ", " m0"})
    EXPECT_EQ(formatted(line, {.max_decimals = 3, .g_digits = GDigits::Two, .word_order = true}), line);
}

TEST(Formatter, DropsZerosThatMeanNothingAndNeverRounds) {
  expect_all({.max_decimals = 3}, {
                                      {"X5.000", "X5"},
                                      {"X5.", "X5"},
                                      {"X-.5", "X-0.5"},
                                      {"X+0.120000 Y.0 Z-.0", "X+0.12 Y0 Z-0"},
                                      {"X1.2345", "X1.2345"},
                                      {"X.2345", "X.2345"},
                                      {"X1.234500", "X1.234500"},
                                      {"X007.10", "X7.1"},
                                      {"X007 Y-00.5 Z+000", "X7 Y-0.5 Z+0"},
                                      {"X(a)00(b)7", "X7 (a) (b)"},
                                      {"X100", "X100"},
                                      {"G1 X1(a).50(b)0", "G1 X1.5 (a) (b)"},
                                      {"V1 = .500", "V1 = 0.5"},
                                      {"M100 P1=2.50", "M100 P1=2.5"},
                                      {"IF V1 = 34.5670 GOTO N3", "IF V1 = 34.567 GOTO N3"},
                                      {"F1000.0", "F1000"},
                                  });
  expect_all({.max_decimals = 0}, {{"X5.0 Y1.50", "X5 Y1.50"}});
}

TEST(Formatter, WritesGWithTheDigitsAskedFor) {
  expect_all({.g_digits = GDigits::Two},
             {{"G1 X1", "G01 X1"}, {"G0001 X1", "G01 X1"}, {"G000 X1", "G00 X1"}, {"G017", "G17"}, {"G909", "G909"}});
  expect_all({.g_digits = GDigits::One},
             {{"G01 X1", "G1 X1"}, {"G00 X1", "G0 X1"}, {"G009", "G9"}, {"G17 M06 T101001", "G17 M06 T101001"}});
}

TEST(Formatter, OrdersWordsWhereTheirOrderMeansNothing) {
  expect_all({.word_order = true}, {
                                       {"G1 Z3 Y2 X1", "G1 X1 Y2 Z3"},
                                       {"Y2 X1 N10", "N10 X1 Y2"},
                                       {"G1 F2000 Y2 X1 M8", "G1 X1 Y2 F2000 M8"},
                                       {"F2000 G1 Y2 F X1", "F2000 G1 Y2 F X1"},
                                       {"S500 F2000 G90 G1 Y2 X1", "S500 G90 G1 X1 Y2 F2000"},
                                       {"G2 R5 X1 Y2", "G2 X1 Y2 R5"},
                                       {"G2 J1 I2 Y2 X1 G09", "G2 X1 Y2 I2 J1 G09"},
                                       {"G24 A1 I0 J1 K0 R1 X1 Z3", "G24 X1 Z3 A1 I0 J1 K0 R1"},
                                       {"IF V1 = 1 GOTO N30 N10", "N10 IF V1 = 1 GOTO N30"},
                                       {"M100 P2=1 P1=2", "M100 P2=1 P1=2"},
                                       {"F5 G09 X1", "F5 G09 X1"},
                                       {"(a) Y2 X1 (b)", "(a) X1 Y2 (b)"},
                                       {"G1 Y2 (a) X1", "G1 Y2 (a) X1"},
                                       {"V2 = 1 V1 = 2", "V2 = 1 V1 = 2"},
                                       {"M100 N10 P1=2", "N10 M100 P1=2"},
                                       {"F2000 G90 G01 Y2 X1", "G90 G01 X1 Y2 F2000"},
                                       {"F2000 M08 G01 Y2 X1", "M08 G01 X1 Y2 F2000"},
                                       {"G1 Y2 X(a)1", "G1 X1 Y2 (a)"},
                                   });
}

std::string changed(std::string_view line, const LineChange& change) {
  const ParsedLine parsed(line);
  return std::string(Formatter({}).format(parsed.tree(), change));
}

TEST(Formatter, WritesNewLineNumbersAndTargets) {
  EXPECT_EQ(changed("n007 g1x1", {.line_number = 20}), "N20 G1 X1");
  EXPECT_EQ(changed("g1x1 n(a)7", {.line_number = 20}), "G1 X1 N20 (a)");
  EXPECT_EQ(changed("(a) G1 X1", {.line_number = 20}), "(a) N20 G1 X1");
  EXPECT_EQ(changed("N1 IF V1 = 1 GOTO N2", {.line_number = 20, .target = 30}), "N20 IF V1 = 1 GOTO N30");
  EXPECT_EQ(changed("IF V1 = 1 GOTO N2 N1", {.line_number = 20, .target = 30}), "IF V1 = 1 GOTO N30 N20");
  EXPECT_EQ(changed("IF V1 = 1 GOTO N2", {.line_number = 20, .target = 30}), "N20 IF V1 = 1 GOTO N30");
}

TEST(Formatter, WritesAndDropsMotions) {
  const LineChange write{.motion = LineChange::MotionEdit::Write, .motion_in_force = 1};
  const LineChange drop{.motion = LineChange::MotionEdit::Drop};
  EXPECT_EQ(changed("N1 G41 X1 F5", write), "N1 G41 G01 X1 F5");
  EXPECT_EQ(changed("S5 (a) X1 G40", write), "S5 (a) G01 X1 G40");
  EXPECT_EQ(changed("N1 G41 G(a)1 X1 G09", drop), "N1 G41 (a) X1 G09");
}

}  // namespace
}  // namespace isocnc::syntax
