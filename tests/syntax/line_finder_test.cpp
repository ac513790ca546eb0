#include "interpreter/syntax/line_finder.h"

#include <gtest/gtest.h>

namespace isocnc::syntax {
namespace {

TEST(LineFinder, CountsColumnsInCharactersInAnyOrder) {
  LineFinder lines("G1\r\n(\xC3\xA8) X5\n");
  EXPECT_EQ(lines.line(0), "G1");
  EXPECT_EQ(lines.column(0), 1u);
  EXPECT_EQ(lines.column(1), 2u);
  EXPECT_EQ(lines.line(1), "(\xC3\xA8) X5");
  EXPECT_EQ(lines.column(5), 5u);  // The X.
  EXPECT_EQ(lines.column(0), 1u);
  EXPECT_EQ(lines.column(3), 3u);
  EXPECT_EQ(lines.column(1), 2u);
}

}  // namespace
}  // namespace isocnc::syntax
