#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// What hovers on motions say of the obstacles around them.
namespace isocnc::lsp {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A flat cutter of radius 10, 100 mm below the nose, which is 120 mm wide.
constexpr std::string_view kObstacleMachine = R"({"machine": {
  "kinematics": {"type": "three-axis"}, "home": {"z": 400}, "nose": [[120, 120, 120]],
  "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat"},
            {"head": 1, "holder": 1, "tool": 2, "length": 150, "radius": 10, "shape": "flat"},
            {"head": 1, "holder": 1, "tool": 3, "length": 100},
            {"head": 1, "holder": 1, "tool": 4, "radius": 10, "shape": "flat"}]}})";

/// A block of 30 mm from X100, in the first workpiece frame.
constexpr std::string_view kClamp = R"({"fixtures": [{"name": "clamp 2", "box": [[100, -20, 0], [140, 20, 30]]}]})";

class Obstacles : public testing::Test {
 protected:
  Obstacles() {
    folder_.write("isocnc.json", kObstacleMachine);
    folder_.write("part.setup.json", kClamp);
  }

  void start(const std::string& language = "en") { session_.start(Json::object(), {{"locale", language}}); }
  void open(const std::string& text) { session_.open(uri_, text, ++version_); }
  std::string hover(int line, int column = 0) {
    const Json place = {{"textDocument", {{"uri", uri_}}}, {"position", {{"line", line}, {"character", column}}}};
    const Json result = session_.request("textDocument/hover", place);
    return result.is_null() ? "" : result["contents"]["value"].get<std::string>();
  }
  /// The last paragraph of a hover.
  std::string last_of_hover(int line, int column = 0) {
    const std::string text = hover(line, column);
    return text.substr(text.rfind("\n\n") == std::string::npos ? 0 : text.rfind("\n\n") + 2);
  }

  const support::TemporaryFolder folder_;
  const std::string uri_ = protocol::uri_of(std::filesystem::canonical(folder_.path()) / "part.iso");
  int version_ = 0;
  Session session_;
};

TEST_F(Obstacles, NearestToAMotionIsNamedWithItsDistance) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nG01 X50 F1000\nX85.8\nX200\nX0 Y-400\nM02\n");
  EXPECT_EQ(last_of_hover(2, 1), "nearest: clamp 2, 40 mm");  // On the G.
  EXPECT_EQ(last_of_hover(2, 5), "nearest: clamp 2, 40 mm");  // On a coordinate.
  EXPECT_EQ(last_of_hover(3), "nearest: clamp 2, 4.2 mm");
  EXPECT_EQ(last_of_hover(4), "hits clamp 2, 20 mm deep");
  EXPECT_THAT(hover(2, 10), Not(HasSubstr("clamp")));  // On the F.
}

TEST_F(Obstacles, UnderG70DistancesAreInInches) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nG70\nG01 X2 F40\nX3.378\nX8\nM02\n");
  EXPECT_EQ(last_of_hover(1), "nearest: clamp 2, 89.4 mm");   // To the nose: 40 mm aside, 80 mm above.
  EXPECT_EQ(last_of_hover(3), "nearest: clamp 2, 1.543 in");  // 39.2 mm
  EXPECT_EQ(last_of_hover(4), "nearest: clamp 2, 0.165 in");
  EXPECT_EQ(last_of_hover(5), "hits clamp 2, 0.787 in deep");
  EXPECT_THAT(hover(3), HasSubstr("workpiece frame (inches): X2 Y0 Z0.3937"));
  EXPECT_THAT(hover(3), HasSubstr("length 2 in"));
}

TEST_F(Obstacles, ItalianSaysTheSame) {
  start("it");
  open("M06 T101001\nG00 X0 Y0 Z10\nG01 X50 F1000\nX200\nM02\n");
  EXPECT_EQ(last_of_hover(2, 1), "più vicino: clamp 2, 40 mm");
  EXPECT_EQ(last_of_hover(3), "urta clamp 2, entra di 20 mm");
}

TEST_F(Obstacles, StandInTheFirstWorkpieceFrame) {
  start();
  open("G92 X1000\nG92 X2000\nM06 T101001\nG92 X1000\nG00 X0 Y0 Z10\nX50\nM02\n");
  EXPECT_EQ(last_of_hover(5), "nearest: clamp 2, 40 mm");
  open("IF V1=1 GOTO N5\nN5 G92 X1000\nG92 X2000\nM06 T101001\nG92 X1000\nG00 X0 Y0 Z10\nX50\nM02\n");
  EXPECT_EQ(last_of_hover(6), "nearest: clamp 2, 40 mm");
  open("IF V1=1 GOTO N5\nG92 X1000\nN5 M06 T101001\nG92 X1000\nG00 X0 Y0 Z10\nX50\nM02\n");
  EXPECT_EQ(last_of_hover(5), "nearest: clamp 2, 40 mm");
}

TEST_F(Obstacles, AreNamedAfterAnEditAndAfterAnotherSetup) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nX50\nM02\n");
  EXPECT_EQ(last_of_hover(2), "nearest: clamp 2, 40 mm");
  session_.edit(uri_, ++version_, {change(0, 0, 0, 0, "G92 Y5\n")});
  session_.edit(uri_, ++version_, {change(3, 1, 3, 3, "60")});
  EXPECT_EQ(last_of_hover(3), "nearest: clamp 2, 30 mm");
  folder_.write("part.setup.json", R"({"fixtures": [{"name": "*stop*", "box": [[80, -20, 0], [140, 20, 30]]}]})");
  session_.notify("workspace/didChangeWatchedFiles",
                  {{"changes", {{{"uri", uri_.substr(0, uri_.size() - 4) + ".setup.json"}, {"type", 2}}}}});
  EXPECT_EQ(last_of_hover(3), "nearest: \\*stop\\*, 10 mm");
}

/// After a change to a longer tool the tip is lower than programmed, until a Z.
TEST_F(Obstacles, AreMeasuredFromWhereTheMachineIs) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z100\nM06 T101002\nX200\nZ100\nX0\nM02\n");
  EXPECT_EQ(last_of_hover(1, 4), "nearest: clamp 2, 114 mm");
  EXPECT_EQ(last_of_hover(3), "nearest: clamp 2, 20 mm");
  EXPECT_EQ(last_of_hover(5), "nearest: clamp 2, 70 mm");
}

/// A line that no path leads to hides nothing.
TEST_F(Obstacles, AreNamedAfterAJumpThatIsAlwaysTaken) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z60\nV1 = 3\nIF V1 = 3 GOTO N30\nX50\nN30 X120 Y0\nZ20\nM02\n");
  EXPECT_EQ(last_of_hover(5, 4), "nearest: clamp 2, 30 mm");
  EXPECT_EQ(last_of_hover(6), "hits clamp 2, 10 mm deep");
}

TEST_F(Obstacles, OnSeveralPathsTheNearestCounts) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nIF V1=1 GOTO N5\nX50\nN5 Y1\nX-30\nX70\nM02\n");
  EXPECT_EQ(last_of_hover(4, 3), "nearest: clamp 2, 40 mm");
  EXPECT_EQ(last_of_hover(5), "nearest: clamp 2, 40 mm");
  EXPECT_EQ(last_of_hover(6), "nearest: clamp 2, 20 mm");
  // On the path of the jump the longer tool is still lower than programmed, beside the clamp.
  open("M06 T101001\nG00 X0 Y0 Z100\nM06 T101002\nIF V1=1 GOTO N5\nZ100\nN5 X50\nM02\n");
  EXPECT_THAT(hover(5, 3), Not(HasSubstr("clamp")));
}

TEST_F(Obstacles, NothingIsSaidWhereTheToolIsNotKnownToBe) {
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nG41 G01 X20 F1000\nX50\nG40\nZ20\nX40 Y1\nX50\nM02\n");
  for (const int line : {3, 5, 6}) EXPECT_THAT(hover(line), Not(HasSubstr("clamp"))) << line;
  EXPECT_THAT(hover(2, 9), Not(HasSubstr("clamp")));
  EXPECT_EQ(last_of_hover(7), "nearest: clamp 2, 40 mm");
  open("M06 T101004\nG00 X0 Y0 Z10\nX50\nM02\n");  // A tool without a length.
  EXPECT_THAT(hover(2), Not(HasSubstr("clamp")));
  // After it, until Z has a coordinate.
  open("M06 T101004\nG00 X0 Y0 Z10\nM06 T101001\nG00 X50\nZ10\nX60\nM02\n");
  for (const int line : {3, 4}) EXPECT_THAT(hover(line), Not(HasSubstr("clamp"))) << line;
  EXPECT_EQ(last_of_hover(5), "nearest: clamp 2, 30 mm");
  open("M06 T101004\nG00 X0 Y0 Z10\nM06 T000000\nG00 X50\nM02\n");
  EXPECT_THAT(hover(3), Not(HasSubstr("clamp")));
  open("M06 T101004\nG00 Z50\nG00 X5\nX6\nM06 T101001\nG00 Y0\nZ10\nX60\nM02\n");
  EXPECT_EQ(last_of_hover(7), "nearest: clamp 2, 30 mm");
}

TEST_F(Obstacles, AToolWithoutAShapeIsSaidToBeLeftOut) {
  start();
  open("M06 T101003\nG00 X0 Y0 Z10\nX50\nM02\n");
  EXPECT_EQ(last_of_hover(2), "nearest: clamp 2, 80 mm (without the tool, which has no shape)");
}

TEST_F(Obstacles, AreNotNamedFarAwayOrWithoutASetup) {
  start();
  open("M06 T101001\nG00 X-900 Y0 Z10\nX-800\nM02\n");
  EXPECT_THAT(hover(2), Not(HasSubstr("clamp")));
  std::filesystem::remove(std::filesystem::path(folder_.path()) / "part.setup.json");
  Session session;
  session.start(Json::object(), {{"locale", "en"}});
  session.open(uri_, "M06 T101001\nG00 X0 Y0 Z10\nX50\nM02\n", 1);
  const Json result = session.request(
      "textDocument/hover", {{"textDocument", {{"uri", uri_}}}, {"position", {{"line", 2}, {"character", 0}}}});
  EXPECT_THAT(result["contents"]["value"].get<std::string>(), EndsWith("s"));
}

/// A cutter may touch the spoilboard and the part: what has to stay away from them counts.
TEST_F(Obstacles, OfWhatACutterMayTouchTheRestCounts) {
  folder_.write("part.setup.json", R"({"spoilboard": {"top": 0, "allow": 0.5}})");
  start();
  open("M06 T101001\nG00 X0 Y0 Z10\nG01 Z0 F1000\nZ-3\nM02\n");
  EXPECT_EQ(last_of_hover(2), "nearest: the spoilboard, 100.5 mm");  // The nose.
  EXPECT_EQ(last_of_hover(3), "hits the spoilboard, 2.5 mm deep");
}

}  // namespace
}  // namespace isocnc::lsp
