#include "analyzer/selection/suppressions.h"

#include <gtest/gtest.h>

#include <string>

#include "analyzer/check/check_text.h"

namespace isocnc::selection {
namespace {

check::Report checked(const std::string& text, const Selection& selection = {}) {
  return suppress(check::check_text(text, {}), text, selection);
}

std::string codes_of(const check::Report& report) {
  std::string codes;
  for (const check::LocatedFinding& located : report.findings) {
    if (!codes.empty()) codes += ' ';
    codes += std::to_string(located.line + 1) + ":" + std::string(dialect::definition(located.finding.id).code);
  }
  return codes;
}

TEST(Suppressions, CountLinesAtEachKindOfLineEnd) {
  EXPECT_EQ(codes_of(checked("M06 T101001\rG00 X1\r\n\nG00 U2 ;isolint: ignore\rG00 X1 U3\nM02")), "5:ISO003");
}

TEST(Suppressions, NeedNoLineEnd) { EXPECT_EQ(codes_of(checked("M06 T101001\nM02 U5 ;isolint: ignore")), ""); }

TEST(Suppressions, AreFoundInTextOfAnyKind) {
  for (const std::string text :
       {":", "isolint", "isolint:", "(isolint:", "(isolint:)", "(:isolint::isolint:)", ";isolint:,", "solint: ignore",
        "(isolint: ignore", "(isolint: ignore ISO001", ";isolint: enable,,"})
    checked(text + "\nM02\n" + text);
  EXPECT_EQ(codes_of(checked("M02 (x isolint: ignore ISO001")), "");
}

/// What was not looked for cannot be found: no reason to blame the comment.
TEST(Suppressions, AreSparedWhereTheirCodeIsOff) {
  Selection selection;
  ASSERT_TRUE(selection.follow({.ignore = {"W001"}}, dialect::Language::English).empty());
  EXPECT_EQ(codes_of(checked("M02 ;isolint: ignore W001\n")), "1:W190");
  EXPECT_EQ(codes_of(checked("M02 ;isolint: ignore W001\n", selection)), "");
  EXPECT_EQ(codes_of(checked("M02 ;isolint: ignore W001 W002\n", selection)), "1:W190");
}

TEST(Suppressions, LeaveTheOrderOfThePlaces) {
  const check::Report report = checked("M06 T101001 (isolint: ignore W003) H1 (isolint: ignore W003) D2\nM02\n");
  EXPECT_EQ(codes_of(report), "1:W190 1:ISO003 1:W190 1:ISO003");
}

/// Many comments on one line, and many lines: nothing is looked through again and again.
TEST(Suppressions, CostNoMoreThanTheirNumber) {
  std::string line = "G00 X1 ";
  for (int i = 0; i < 50'000; ++i) line += "(isolint: ignore ISO003)U1 ";
  std::string text = "M06 T101001\n" + line + "\n";
  for (int i = 0; i < 100'000; ++i) text += "G00 U1 ;isolint: ignore\n";
  EXPECT_LT(checked(text + "M02\n").findings.size(), 50'000u);
}

}  // namespace
}  // namespace isocnc::selection
