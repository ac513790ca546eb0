#include "analyzer/check/jump_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/text/characters.h"
#include "tests/support/random.h"

namespace isocnc::check {
namespace {

using support::Random;
using testing::ElementsAre;
using Target = JumpMap::Target;

JumpMap collected(std::string_view text) {
  JumpCollector collector;
  each_event_in(text, [&](const FlowEvent& event) { collector.add(event.line, event); });
  return std::move(collector).finish();
}

TEST(JumpMap, HoldsTheJumpsOfATextWithTheirLines) {
  const JumpMap jumps("G0 X1\nIF V1=2 GOTO N9\n\n(GOTO N5)\nif VGPL<3 goto n7\nN7\nN9\n");
  ASSERT_EQ(jumps.sites().size(), 2u);
  EXPECT_EQ(jumps.sites()[0].line, 1u);
  EXPECT_EQ(jumps.sites()[1].line, 4u);
  EXPECT_THAT(jumps.labels(), ElementsAre(7, 9));
  EXPECT_TRUE(jumps.names(7));
  EXPECT_FALSE(jumps.names(5));
  EXPECT_EQ(jumps.compared(), register_bit(1));
  EXPECT_THAT(jumps.constants(1), ElementsAre(2));
}

TEST(JumpMap, HasNoJumpsWhereATextHasNone) {
  const JumpMap jumps("N1 G0 X1 (IF V1=2 GOTO N9)\nM02\n");
  EXPECT_TRUE(jumps.empty());
  EXPECT_FALSE(jumps.compares_registers());
  EXPECT_FALSE(jumps.names(1));
}

/// Reading them would take a second look at programs that number each line.
TEST(JumpMap, ReadsNoLabelsWhereNoRegisterIsCompared) {
  const JumpMap jumps("IF VGPL=1 GOTO N9\n");
  EXPECT_FALSE(jumps.knows_labels());
  EXPECT_EQ(jumps.target_of(0), Target::Below);
  EXPECT_TRUE(jumps.may_repeat(9));
}

TEST(JumpMap, KnowsWhichJumpsLand) {
  const JumpMap jumps = JumpMap::with_labels(
      "N1\nIF VGPL=1 GOTO N1\nIF VGPL=1 GOTO N2\nN3 IF VGPL=1 GOTO N3\nIF VGPL=1 GOTO N4\nN4\nN4\n");
  ASSERT_TRUE(jumps.knows_labels());
  EXPECT_EQ(jumps.target_of(0), Target::Above);
  EXPECT_EQ(jumps.target_of(1), Target::NotFound);
  EXPECT_EQ(jumps.target_of(2), Target::Above);  // Its own line.
  EXPECT_EQ(jumps.target_of(3), Target::Below);
  EXPECT_TRUE(jumps.may_repeat(4));
  EXPECT_FALSE(jumps.may_repeat(1));
}

TEST(JumpMap, KnowsWhichRegistersAreStillRead) {
  const JumpMap jumps("IF V1=1 GOTO N5\nV2=1\nIF V2=1 GOTO N6\nN5\nIF V3=1 GOTO N6\nN6\n");
  EXPECT_EQ(jumps.read_before(0), register_bit(1) | register_bit(3));
  EXPECT_EQ(jumps.read_after(0), register_bit(3));
  EXPECT_EQ(jumps.read_at_target(0), register_bit(3));
  EXPECT_EQ(jumps.read_before(1), register_bit(2) | register_bit(3));
  EXPECT_EQ(jumps.read_at_target(2), 0u);
  EXPECT_EQ(jumps.read_before(3), 0u);
}

TEST(JumpMap, MovesItsJumpsToOtherLines) {
  JumpMap jumps("IF V1=1 GOTO N9\nIF V1=2 GOTO N9\nIF V1=3 GOTO N9\nN9\n");
  const std::vector<JumpMap::Site> second = {{.line = 4, .jump = jumps.sites()[1].jump}};
  jumps = std::move(jumps).moved(1, second, 5);
  EXPECT_EQ(jumps.sites()[0].line, 0u);
  EXPECT_EQ(jumps.sites()[1].line, 4u);
  EXPECT_EQ(jumps.sites()[2].line, 7u);
  EXPECT_EQ(jumps.first_from(5), 2u);
  EXPECT_EQ(jumps.first_from(8), 3u);
  EXPECT_TRUE(jumps.knows_labels());
}

TEST(JumpCollector, MakesAnEmptyMapOfLabelsAlone) {
  const JumpMap jumps = collected("N1\nV1=3\nN1\n");
  EXPECT_TRUE(jumps.empty());
  EXPECT_FALSE(jumps.names(1));
}

std::string random_program(Random& random) {
  const auto number = [&] { return random.between(1, 4); };
  const auto line = [&]() -> std::string {
    switch (random.between(0, 8)) {
      case 8:  // Two blocks on one line (D68).
        return fmt::format("N{} IF V{}=1 GOTO N{} N{} IF V{}=2 GOTO N{}", number(), number(), number(), number(),
                           number(), number());
      case 0:
        return fmt::format("IF V{}={} GOTO N{}", number(), number(), number());
      case 1:
        return fmt::format("n{} if V{} < {} goto (N1) n{}", number(), number(), number(), number());
      case 2:
        return fmt::format("IF VGPL=1 GOTO N{}", number());
      case 3:
        return fmt::format("IF V{}=x GOTO N{}", number(), number());
      case 4:
        return fmt::format("V{}={} V{}={}", number(), number(), number(), number());
      case 5:
        return fmt::format("G0 N{} X1", number());
      case 6:
        return fmt::format("N{} G1 X{} Y{} F1000 ; GOTO", number(), number(), number());
      default:
        return fmt::format("N{}{} M02", number(), number());
    }
  };
  std::string text;
  for (int i = random.between(1, 12); i > 0; --i) text += line() + std::string(random.any_of({"\n", "\r\n", "\r"}));
  return text;
}

/// Two maps that the check of a program could not tell apart.
void expect_same(const JumpMap& one, const JumpMap& other, const std::string& which) {
  ASSERT_EQ(one.sites().size(), other.sites().size()) << which;
  EXPECT_EQ(one.labels(), other.labels()) << which;
  EXPECT_EQ(one.compared(), other.compared()) << which;
  for (int reg = 1; reg <= dialect::kRegisterCount; ++reg) EXPECT_EQ(one.constants(reg), other.constants(reg)) << which;
  for (std::uint32_t jump = 0; jump < one.sites().size(); ++jump) {
    EXPECT_EQ(one.sites()[jump].line, other.sites()[jump].line) << which;
    EXPECT_TRUE(one.is_equivalent(jump, other, jump)) << which;
  }
  for (const std::uint64_t label : one.labels()) EXPECT_EQ(one.may_repeat(label), other.may_repeat(label)) << which;
}

TEST(JumpCollectorProperty, MakesTheMapOfTheText) {
  for (const std::uint64_t seed : support::seeds(500)) {
    Random random(seed);
    const std::string text = random_program(random);
    const std::string which = fmt::format("seed {}:\n{}", seed, text);
    const JumpMap from_events = collected(text);
    expect_same(from_events, JumpMap::with_labels(text), which);
    if (from_events.compares_registers()) expect_same(from_events, JumpMap(text), which);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(JumpMapProperty, ThreadsFindTheSameJumps) {
  for (const std::uint64_t seed : support::seeds(4)) {
    Random random(seed);
    std::string text;
    while (text.size() < 2'500'000) {
      text += random_program(random);
      text += "IF V1=1 GOTO N1 (";  // A thread may begin amid the comment.
      for (int i = random.between(1, 5'000); i > 0; --i) text += "GO";
      text += random.one_in(2) ? ")\r" : ")\n";
    }
    const std::string which = fmt::format("seed {}", seed);
    const JumpMap jumps(text, 3);
    expect_same(JumpMap::with_labels(text), JumpMap::with_labels(text, 3), which);
    const char* const end = text.data() + text.size();
    std::size_t line = 0;
    for (const char* p = text.data(); p != end; p = text::next_line(p, end), ++line) {
      ASSERT_EQ(jumps.count_above(static_cast<std::size_t>(p - text.data())), jumps.first_from(line)) << which;
    }
  }
}

}  // namespace
}  // namespace isocnc::check
