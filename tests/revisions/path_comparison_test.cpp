#include "analyzer/revisions/path_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "analyzer/selection/verified.h"
#include "revisions.h"
#include "tests/support/random.h"

namespace isocnc::revisions {
namespace {

using testing::ElementsAre;

/// Both after a tool change.
PathComparison on_paths(const std::string& old_lines, const std::string& new_lines, std::uint32_t set_registers = 0) {
  const std::string old_program = "M06 T101001\n" + old_lines;
  const std::string new_program = "M06 T101001\n" + new_lines;
  const Revision old_revision = revision_of(old_program);
  const Revision new_revision = revision_of(new_program);
  return compare_on_paths({old_revision, new_revision}, {}, set_registers, {});
}

/// `VGPL <> 1: 0 same`, a line for each combination.
std::string shown(const PathComparison& compared) {
  std::string text;
  for (const PathComparison::ComparedPaths& each : compared.paths)
    text += fmt::format("{}: {} {}\n", each.values, each.vgpl, each.is_same ? "same" : "different");
  return text;
}

TEST(PathComparison, IsOneWithoutJumps) {
  EXPECT_EQ(shown(on_paths("G00 X10\nM02\n", "G00 X10\nM02\n")), ": 0 same\n");
}

TEST(PathComparison, TakesBothSidesOfAnIf) {
  const std::string old_program = "IF VGPL = 1 GOTO N1\nG00 X10\nN1 G00 Y10\nM02\n";
  const std::string new_program = "IF VGPL = 1 GOTO N1\nG00 X11\nN1 G00 Y10\nM02\n";
  EXPECT_EQ(shown(on_paths(old_program, old_program)), "VGPL <> 1: 0 same\nVGPL = 1: 1 same\n");
  const PathComparison compared = on_paths(old_program, new_program);
  EXPECT_EQ(shown(compared), "VGPL <> 1: 0 different\nVGPL = 1: 1 same\n");
  EXPECT_FALSE(compared.is_same());
  EXPECT_TRUE(compared.is_complete());
}

/// Each program alone tells two ranges apart; together there are three.
TEST(PathComparison, CombinesThePathsOfBothPrograms) {
  EXPECT_EQ(shown(on_paths("IF VGPL > 5 GOTO N1\nG00 X10\nN1 M02\n", "IF VGPL < 2 GOTO N1\nG00 X10\nN1 M02\n")),
            "VGPL < 2: 0 different\n2 <= VGPL <= 5: 2 same\nVGPL > 5: 6 different\n");
}

TEST(PathComparison, NeedNotBeWrittenWithTheSameIfs) {
  const PathComparison compared =
      on_paths("IF VGPL = 1 GOTO N1\nIF VGPL = 2 GOTO N1\nG00 X10\nN1 M02\n",
               "IF VGPL < 1 GOTO N2\nIF VGPL <= 1 GOTO N1\nIF VGPL = 2 GOTO N1\nN2 G00 X10\nN1 M02\n");
  EXPECT_TRUE(compared.is_same()) << shown(compared);
  EXPECT_TRUE(compared.is_complete());
}

TEST(PathComparison, SaysWhatItHasNotCompared) {
  std::string program;
  for (int i = 1; i <= 12; ++i) program += fmt::format("IF VGPL = {} GOTO N{}\nG00 X{}\nN{}\n", i, i, 5 * i, i);
  program += "M02\n";
  const PathComparison compared = on_paths(program, program);
  EXPECT_EQ(compared.paths.size(), selection::kMaxVerifiedPaths);
  EXPECT_TRUE(compared.is_same());
  EXPECT_FALSE(compared.is_complete());
  EXPECT_EQ(compared.not_compared, "VGPL = 8, VGPL = 9, VGPL = 10, VGPL = 11, VGPL = 12");
  EXPECT_THAT(text_of(compared, {}),
              testing::HasSubstr("not compared: VGPL = 8, VGPL = 9, VGPL = 10, VGPL = 11, VGPL = 12; more than 8 "));
}

TEST(PathComparison, NamesRegistersThatNobodySets) {
  const std::string program = "IF V3 = 1 GOTO N1\nG00 X10\nN1\nV4 = 2\nIF V4 = 2 GOTO N2\nG00 X20\nN2 M02\n";
  const PathComparison compared = on_paths(program, program);
  EXPECT_THAT(compared.registers, ElementsAre(3));
  EXPECT_FALSE(compared.is_complete());
  EXPECT_TRUE(on_paths(program, program, 1U << 3).is_complete());
}

/// Whatever the IFs are: each value of a list leads both programs along paths that have been compared under one of the
/// values, with the same result.
TEST(PathComparison, CoversEveryValue) {
  support::Random random(20260201);
  const auto program_of = [&](int lines) {
    std::string program = "M06 T101001\n";
    for (int line = 0; line < lines; ++line) {
      program += fmt::format("N{} ", line);
      if (random.one_in(3)) {
        program += fmt::format("IF VGPL {} {} GOTO N{}\n", random.any_of({"=", "<>", "<", "<=", ">", ">="}),
                               random.any_of({"-1", "0", "1.5", "3"}), random.between(line + 1, lines));
      } else {
        program += fmt::format("G00 X{} Y{}\n", random.between(0, 3), line);
      }
    }
    return program + fmt::format("N{} M02\n", lines);
  };
  for (int i = 0; i < 300; ++i) {
    const std::string old_program = program_of(random.between(3, 9));
    const std::string new_program = random.one_in(2) ? old_program : program_of(random.between(3, 9));
    const PathComparison all = on_paths(old_program, new_program);
    if (!all.is_complete()) continue;
    const Revision old_revision = revision_of(old_program);
    const Revision new_revision = revision_of(new_program);
    const auto decisions = [&](double vgpl) {
      CompareOptions options;
      options.run.vgpl = vgpl;
      const RevisionComparison one = compare({old_revision, new_revision}, options);
      return std::tuple(one.old_run.path.decisions, one.new_run.path.decisions, one.is_same());
    };
    std::vector<std::tuple<std::vector<simulation::RunDecision>, std::vector<simulation::RunDecision>, bool>> known;
    for (const PathComparison::ComparedPaths& each : all.paths) {
      known.push_back(decisions(each.vgpl));
      EXPECT_EQ(std::get<2>(known.back()), each.is_same);
    }
    for (const double vgpl : {-7.0, -1.0, -0.5, 0.0, 0.7, 1.5, 2.0, 3.0, 9.0})
      EXPECT_THAT(known, testing::Contains(decisions(vgpl))) << "VGPL " << vgpl << "\n" << old_program << new_program;
    for (std::size_t k = 1; k < known.size(); ++k) EXPECT_NE(known[k - 1], known[k]) << old_program << new_program;
  }
}

}  // namespace
}  // namespace isocnc::revisions
