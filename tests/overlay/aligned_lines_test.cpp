#include "interpreter/overlay/aligned_lines.h"

#include <gtest/gtest.h>

#include <string>

#include "interpreter/overlay/comparison_page.h"
#include "tests/comparison/compared.h"

namespace isocnc::overlay {
namespace {

/// `1|1 2-3|2 -|3`: the lines that stand beside each other, from 1.
std::string aligned(const std::string& old_program, const std::string& new_program) {
  const comparison::RecordedRun old_run = comparison::recorded(old_program);
  const comparison::RecordedRun new_run = comparison::recorded(new_program);
  std::string shown;
  std::size_t old_line = 1;
  std::size_t new_line = 1;
  const auto lines = [](std::size_t& first, std::size_t count) {
    const std::size_t start = first;
    first += count;
    if (count == 0) return std::string("-");
    return count == 1 ? std::to_string(start) : std::to_string(start) + "-" + std::to_string(first - 1);
  };
  for (const AlignedLines& each : aligned_lines({old_program, old_run}, {new_program, new_run}, 0.001))
    for (std::size_t i = 0; i < each.repeats; ++i) {
      const std::string old_lines = lines(old_line, each.old_count);
      shown += (shown.empty() ? "" : " ") + old_lines + "|" + lines(new_line, each.new_count);
    }
  return shown;
}

const std::string kStart = "M06 T101001\nS12000 M03\nG00 X10 Y20 Z40\nG01 Z-5 F2000\n";
const std::string kEnd = "G00 Z40\nM02\n";

TEST(AlignedLines, OfEqualProgramsStandBesideEachOther) {
  const std::string program = kStart + "X100\n" + kEnd;
  EXPECT_EQ(aligned(program, program), "1|1 2|2 3|3 4|4 5|5 6|6 7|7");
  const comparison::RecordedRun run = comparison::recorded(program);
  EXPECT_EQ(aligned_lines({program, run}, {program, run}, 0.001), (std::vector<AlignedLines>{{1, 1, 7}}));
  EXPECT_EQ(aligned("", ""), "");
}

TEST(AlignedLines, GoByWhatTheMachineDoes) {
  // The same square under G91, with numbers of lines: by text, nothing would be beside anything.
  EXPECT_EQ(aligned(kStart + "X100\nY80\nX10\n" + kEnd,
                    "N1 M06 T101001\nN2 S12000 M03\nN3 G00 X10 Y20 Z40\nN4 G01 Z-5 F2000\nN5 G91\nN6 X90\nN7 Y60\n"
                    "N8 X-90\nN9 G90\nN10 G00 Z40\nN11 M02\n"),
            "1|1 2|2 3|3 4|4 -|5 5|6 6|7 7|8 -|9 8|10 9|11");
}

TEST(AlignedLines, HaveGapsWhereOneProgramDoesNothing) {
  EXPECT_EQ(aligned(kStart + "X100\n" + kEnd, kStart + "Y50\nY20\nX100\n" + kEnd), "1|1 2|2 3|3 4|4 -|5-6 5|7 6|8 7|9");
  EXPECT_EQ(aligned(kStart + "Y50\nY20\nX100\n" + kEnd, kStart + "X100\n" + kEnd), "1|1 2|2 3|3 4|4 5-6|- 7|5 8|6 9|7");
}

TEST(AlignedLines, StandTogetherWhereOneLineIsSeveral) {
  EXPECT_EQ(aligned(kStart + "X100\nY80\n" + kEnd, kStart + "X40\nX100\nY80\n" + kEnd),
            "1|1 2|2 3|3 4|4 5|5-6 6|7 7|8 8|9");
}

TEST(AlignedLines, StandBesideTheLinesThatTakeTheirPlace) {
  EXPECT_EQ(aligned(kStart + "X100\nY80\n" + kEnd, kStart + "X101\nY80\n" + kEnd), "1|1 2|2 3|3 4|4 5|5 6|6 7|7 8|8");
  EXPECT_EQ(aligned(kStart + "X100\n" + kEnd, "M06 T101001\nS9000 M03\nG00 X10 Y20 Z40\nG01 Z-5 F2000\nX100\n" + kEnd),
            "1|1 2|2 3|3 4|4 5|5 6|6 7|7");
}

TEST(AlignedLines, ThatDoNothingGoByTheirTexts) {
  EXPECT_EQ(aligned(kStart + "; pocket\nX100\n" + kEnd, kStart + "; new\nN70 ; pocket\nX100\n" + kEnd),
            "1|1 2|2 3|3 4|4 -|5 5|6 6|7 7|8 8|9");
}

TEST(AlignedLines, AreAllLinesOfBothProgramsToTheEnd) {
  // An error ends the first run: its line stands beside the other end, and what is behind it is not run.
  EXPECT_EQ(aligned(kStart + "G01\nX1\n; end", kStart + "X100\n" + kEnd), "1|1 2|2 3|3 4|4 -|5-6 5|7 6-7|-");
  EXPECT_EQ(aligned("", "M02\n"), "-|1");
}

TEST(AlignedLines, AreTheSameForSwappedPrograms) {
  const std::string one = kStart + "X100\nY80\nX20\nX100\n" + kEnd;
  const std::string other = kStart + "X100\nY80\nG04 P1000\nX20\nX100\nX20\nX100\n" + kEnd;
  const comparison::RecordedRun one_run = comparison::recorded(one);
  const comparison::RecordedRun other_run = comparison::recorded(other);
  const auto there = aligned_lines({one, one_run}, {other, other_run}, 0.001);
  auto back = aligned_lines({other, other_run}, {one, one_run}, 0.001);
  for (AlignedLines& each : back) std::swap(each.old_count, each.new_count);
  EXPECT_EQ(there, back);
}

TEST(ComparisonFacts, HoldTheChangesInBothLanguages) {
  const auto written = [](const char* text) {
    nlohmann::ordered_json json;
    json["same"] = false;
    json["changes"] = nlohmann::ordered_json::array({{{"kind", "moved"}, {"old", {5, 6}}, {"text", text}}});
    return json;
  };
  const auto facts = nlohmann::json::parse(comparison_facts(written("moved by X1"), written("spostato di X1")));
  ASSERT_EQ(facts.at("changes").size(), 1U);
  EXPECT_EQ(facts.at("changes")[0].at("text"), (nlohmann::json{{"en", "moved by X1"}, {"it", "spostato di X1"}}));
  EXPECT_EQ(facts.at("changes")[0].at("old"), (nlohmann::json{5, 6}));
  EXPECT_EQ(facts.at("same"), false);
}

TEST(ComparisonFacts, AreThoseOfTwoRunsAlone) {
  const comparison::RecordedRun old_run = comparison::recorded(kStart + "X100\n" + kEnd);
  const comparison::RecordedRun new_run = comparison::recorded(kStart + "X101\n" + kEnd);
  const auto changes = comparison::compare(old_run, new_run, {});
  const auto facts = nlohmann::json::parse(comparison_facts({old_run, new_run, changes}));
  ASSERT_EQ(facts.at("changes").size(), 1U);
  EXPECT_EQ(facts.at("changes")[0].at("text"), (nlohmann::json{{"en", "moved by X1"}, {"it", "spostato di X1"}}));
  EXPECT_EQ(facts.at("changes")[0].at("old"), (nlohmann::json{5, 6}));
}

TEST(AlignmentBytes, AreThreePackedNumbersForEachEntry) {
  EXPECT_EQ(alignment_bytes({{1, 1, 300}, {0, 2, 1}}), std::string("\x01\x01\xac\x02\x00\x02\x01", 7));
}

}  // namespace
}  // namespace isocnc::overlay
