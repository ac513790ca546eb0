#include "analyzer/check/frontier.h"

#include <gtest/gtest.h>

#include <utility>

namespace isocnc::check {
namespace {

const JumpMap kJumps("IF V1=1 GOTO N9\nN9\n");

Group group_at(double x, Decisions path = {}) {
  Group group{.state = execution::initial_state({}), .registers = Valuations::unknown(), .path = std::move(path)};
  group.state.position.tip.x() = x;
  return group;
}

TEST(Groups, AddingAKnownStateJoinsThePaths) {
  Groups groups;
  groups.add(group_at(1, {{3, true}, {1, false}}));
  groups.add(group_at(1, {{3, false}, {1, false}}));
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].path, (Decisions{{1, false}}));
}

TEST(Groups, JoiningUnitesWhatTheRegistersMayBe) {
  Group one = group_at(1);
  one.registers.assign(1, 1, kJumps);
  Group other = group_at(1);
  other.registers.assign(1, 2, kJumps);
  Groups groups;
  groups.add(one);
  groups.add(other);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_TRUE(groups[0].registers.where(kJumps.sites()[0].jump, true).possible());
  EXPECT_TRUE(groups[0].registers.where(kJumps.sites()[0].jump, false).possible());
}

TEST(Groups, OtherStatesStayApart) {
  Groups groups;
  groups.add(group_at(1));
  groups.add(group_at(2));
  EXPECT_EQ(groups.size(), 2u);
}

TEST(Groups, ConvergeJoinsStatesThatHaveMet) {
  Groups groups;
  for (int x = 1; x <= 4; ++x) groups.add(group_at(x, {{static_cast<std::uint32_t>(x), true}}));
  for (Group& group : groups) group.state.position.tip.x() = 7;
  groups.converge();
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_TRUE(groups[0].path.empty());
}

TEST(Groups, JoiningEmptiesTheOther) {
  Groups groups;
  Groups others;
  groups.add(group_at(1));
  others.add(group_at(1));
  others.add(group_at(2));
  groups.join(std::move(others));
  EXPECT_EQ(groups.size(), 2u);
}

TEST(Groups, ReducingForgetsPositionsFirst) {
  Groups groups;
  for (int x = 0; x < 10; ++x) groups.add(group_at(x));
  groups.reduce_to(1);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].state.unknown, execution::axis_bit(execution::Axis::X));
}

/// The same value stands there in both, but in one it is not known.
TEST(Groups, ReducingKeepsWhatEitherDoesNotKnow) {
  for (const bool is_first : {true, false}) {
    Groups groups;
    for (const bool is_known : {is_first, !is_first}) {
      Group group = group_at(0);
      group.state.position.tip.y() = is_known ? 1 : 2;
      if (!is_known) group.state.unknown = execution::axis_bit(execution::Axis::X);
      groups.add(group);
    }
    groups.reduce_to(1);
    ASSERT_EQ(groups.size(), 1u);
    EXPECT_EQ(groups[0].state.unknown,
              execution::axis_bit(execution::Axis::X) | execution::axis_bit(execution::Axis::Y));
  }
}

TEST(Groups, ReducingLeavesWhatFits) {
  Groups groups;
  for (int x = 0; x < 3; ++x) groups.add(group_at(x));
  groups.reduce_to(3);
  ASSERT_EQ(groups.size(), 3u);
  for (const Group& group : groups) EXPECT_EQ(group.state.unknown, 0);
}

TEST(Groups, ReducingKeepsToItsLimitWhateverDiffers) {
  Groups groups;
  for (const std::uint8_t plane : std::initializer_list<std::uint8_t>{17, 18, 19}) {
    Group group = group_at(1);
    group.state.set_mode(dialect::ModalGroup::Plane, plane);
    groups.add(group);
  }
  groups.reduce_to(2);
  EXPECT_EQ(groups.size(), 2u);
}

TEST(Frontier, IsFinishedWhenNoPathGoesOn) {
  Frontier frontier;
  EXPECT_TRUE(frontier.finished());
  frontier.live.add(group_at(1));
  EXPECT_FALSE(frontier.finished());
  frontier.jump(5, std::exchange(frontier.live, {}));
  EXPECT_FALSE(frontier.finished());
  frontier.drop_highest_label();
  EXPECT_TRUE(frontier.finished());
}

}  // namespace
}  // namespace isocnc::check
