#include <gtest/gtest.h>

#include <string_view>

#include "interpreter/execution/block_recorder.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::execution {
namespace {

State state_after(std::string_view text, const State& before) {
  const syntax::ParsedLine line(text);
  return BlockRecorder(line.tree(), before, Setup{}).state();
}

/// A G92 dismounts a face as well (with an error).
TEST(Face, IsNoLongerInForceOnceItIsDismounted) {
  const State mounted = state_after("G29 C90", State{});
  EXPECT_EQ(mounted.mode(dialect::ModalGroup::Face), 29);
  for (const char* const line : {"G27", "G92 X0"})
    EXPECT_EQ(state_after(line, mounted).mode(dialect::ModalGroup::Face), 27) << line;
}

}  // namespace
}  // namespace isocnc::execution
