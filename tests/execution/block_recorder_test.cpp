#include "interpreter/execution/block_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "interpreter/syntax/tree_store.h"

namespace isocnc::execution {
namespace {

using namespace dialect::literals;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

BlockRecorder recorded(std::string_view block, const State& before = initial_state({})) {
  return {syntax::ParsedLine(block).tree(), before, {}};
}

/// The state after some lines, with a tool and a feed.
State after_lines(std::initializer_list<std::string_view> lines) {
  State state = recorded("M06 T101001").state();
  state = recorded("G01 X0 F1000", state).state();
  for (const std::string_view line : lines) state = recorded(line, state).state();
  return state;
}

TEST(BlockRecorder, RecordsAMotionWithTheStateInWhichItRuns) {
  const State before = after_lines({"G01 X1 Y2 Z3"});
  const BlockRecorder done = recorded("G91 G02 X10 I5 J0 F200", before);
  EXPECT_FALSE(done.has_error());
  ASSERT_EQ(done.motions().size(), 1u);
  const ProgrammedMove& arc = done.motion()->move;
  EXPECT_EQ(arc.kind, MoveKind::Arc);
  EXPECT_EQ(arc.from.tip, geometry::Vec3(1, 2, 3));
  EXPECT_EQ(arc.to.tip, geometry::Vec3(11, 2, 3));
  EXPECT_EQ(arc.center, geometry::Vec3(6, 2, 3));
  EXPECT_EQ(arc.feed, 200);
  EXPECT_TRUE(done.modes().incremental());
  EXPECT_FALSE(before.incremental());
  EXPECT_EQ(done.state().position.tip, geometry::Vec3(11, 2, 3));
}

/// The frame in force is part of the state of the motion, and may have changed at the end of the block.
TEST(BlockRecorder, KeepsTheModesOfTheMotionWhereTheBlockChangesThem) {
  const BlockRecorder done = recorded("G00 X1 G70", after_lines({}));
  ASSERT_NE(done.motion(), nullptr);
  EXPECT_EQ(done.modes().mm_per_unit(), 1);
  EXPECT_EQ(done.state().mm_per_unit(), 25.4);
}

TEST(BlockRecorder, HasTheModesAfterTheBlockWhereNothingMoves) {
  const BlockRecorder done = recorded("G70", after_lines({}));
  EXPECT_EQ(done.motion(), nullptr);
  EXPECT_EQ(done.modes(), done.state());
  EXPECT_EQ(done.modes().mm_per_unit(), 25.4);
}

TEST(BlockRecorder, RecordsEachMotionOfABlockWithTwo) {
  const BlockRecorder done = recorded("G00 X1 G01 Y2", after_lines({}));
  EXPECT_TRUE(done.has_error());
  ASSERT_EQ(done.motions().size(), 2u);
  EXPECT_EQ(done.motions()[0].move.kind, MoveKind::Rapid);
  EXPECT_EQ(done.motion()->move.kind, MoveKind::Feed);
}

TEST(BlockRecorder, RecordsDwellsAndAssignments) {
  EXPECT_EQ(recorded("G04 P1.5").dwell(), 1.5);
  EXPECT_EQ(recorded("M03 S100").dwell(), 0);
  const BlockRecorder done = recorded("V3=1.5 V4=x V3=2");
  ASSERT_EQ(done.assignments().size(), 3u);
  EXPECT_EQ(done.assignments()[0].reg, 3);
  EXPECT_EQ(done.assignments()[0].value, 1.5);
  EXPECT_EQ(done.assignments()[1].reg, 4);
  EXPECT_TRUE(std::isnan(done.assignments()[1].value));
  EXPECT_EQ(done.assignments()[2].value, 2);
}

TEST(BlockRecorder, HasTheFindingsOfTheTextAndOfTheExecution) {
  EXPECT_THAT(recorded("G01 X5 F100", after_lines({})).findings(), IsEmpty());
  const BlockRecorder done = recorded("G01 X5 X6 B3", after_lines({}));
  EXPECT_TRUE(done.has_error());
  EXPECT_THAT(done.findings(), ElementsAre(Field(&syntax::Finding::id, "repeated-argument"_diag),
                                           Field(&syntax::Finding::id, "five-axis-not-enabled"_diag)));
}

TEST(BlockRecorder, CallsNoWarningAnError) {
  const BlockRecorder done = recorded("G71", recorded("G71").state());
  EXPECT_THAT(done.findings(), ElementsAre(Field(&syntax::Finding::id, "redundant-modal"_diag)));
  EXPECT_FALSE(done.has_error());
}

}  // namespace
}  // namespace isocnc::execution
