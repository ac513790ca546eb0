#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "revisions.h"

namespace isocnc::revisions {
namespace {

/// X leaves its travel on lines 4 and 7, F9000 is above the machine's on line 6.
constexpr std::string_view kProgram =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X10 Y20\n"
    "X130\n"
    "X50\n"
    "G01 Y50 F9000\n"
    "X140\n"
    "X20\n"
    "M02\n";

/// kProgram with another text in one place.
std::string with(std::string_view what, std::string_view instead) {
  std::string program(kProgram);
  return program.replace(program.find(what), what.size(), instead);
}

struct FindingCase {
  std::string name;
  std::string new_program;
  std::string findings;
};

class FindingTable : public testing::TestWithParam<FindingCase> {};

TEST_P(FindingTable, NamesTheFindings) {
  const FindingCase& each = GetParam();
  EXPECT_EQ(shown_findings(compared(kProgram, each.new_program)), each.findings) << each.new_program;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, FindingTable,
    testing::Values(
        FindingCase{"Itself", std::string(kProgram), ""},
        FindingCase{"LinesAbove", "( a comment )\n\n" + std::string(kProgram), ""},
        FindingCase{"Incremental", with("X130\nX50\n", "G91\nX120\nX-80\nG90\n"), ""},
        FindingCase{"SplitWhereItLeaves", with("X130\n", "X60\nX130\n"), ""},
        FindingCase{"LaterInTime", with("G00 X10", "G04 P5\nG00 X10"), ""},
        FindingCase{"FeedElsewhereOnItsLine", with("Y50 F9000", "F9000 Y50"), ""},
        FindingCase{"TheFirstOneGone", with("X130", "X90"), "gone E160 4|-\n"},
        FindingCase{"TheSecondOneGone", with("X140", "X90"), "gone E160 7|-\n"},
        FindingCase{"Farther", with("X130", "X135"), "changed E160 4|4\n"},
        FindingCase{"AnotherOneBefore", with("G00 X10 Y20", "G00 X10 Y20\nX110\nX10\nY21\nY20"), "new E160 -|4\n"},
        FindingCase{"TheSameOneEarlier", with("G00 X10 Y20", "G00 X10 Y20\nX110\nX10"), "changed E160 4|4\n"},
        FindingCase{"OtherEndOfTheTravel", with("X130", "X-30"), "gone E160 4|-\nnew E160 -|4\n"},
        FindingCase{"FeedWithin", with("F9000", "F4000"), "gone W131 6|-\n"},
        FindingCase{"FeedFurtherAbove", with("F9000", "F9500"), "changed W131 6|6\n"},
        FindingCase{"TheSameElsewhere",
                    "M06 T101001\nS12000 M03\nG00 X10 Y20\nX50\nG01 Y50 F9000\nX140\nX20\nY51\nX130\nX20\nM02\n",
                    "gone E160 4|-\nnew E160 -|9\n"},
        FindingCase{"AllGone", "M02\n", "gone E160 4|-\ngone W131 6|-\ngone E160 7|-\n"}),
    [](const auto& info) { return info.param.name; });

TEST(FindingChanges, AreMirroredWhereTheProgramsAreSwapped) {
  for (const std::string& other : {with("X130", "X90"), with("F9000", "F4000"), with("X130", "X-30")}) {
    const RevisionComparison there = compared(kProgram, other);
    const RevisionComparison back = compared(other, kProgram);
    ASSERT_EQ(there.findings.size(), back.findings.size());
    const auto count = [](const RevisionComparison& of, FindingChangeKind kind) {
      return std::count_if(of.findings.begin(), of.findings.end(),
                           [&](const FindingChange& each) { return each.kind == kind; });
    };
    EXPECT_EQ(count(there, FindingChangeKind::New), count(back, FindingChangeKind::Gone));
    EXPECT_EQ(count(there, FindingChangeKind::Gone), count(back, FindingChangeKind::New));
  }
}

/// A comment hides a finding, and the machine does the same.
TEST(FindingChanges, OfAloneMakeNoDifference) {
  const std::string silenced = with("F9000", "F9000 ;isolint: ignore W131");
  const RevisionComparison hidden = compared(kProgram, silenced);
  EXPECT_EQ(shown_findings(hidden), "gone W131 6|-\n");
  EXPECT_TRUE(hidden.is_same());
  EXPECT_EQ(text_of(hidden, {}),
            "no difference\n"
            "findings\n"
            "  gone: old line 6: warning[W131]: F9000 means 9000 mm/min, more than the machine's 5000\n");
}

}  // namespace
}  // namespace isocnc::revisions
