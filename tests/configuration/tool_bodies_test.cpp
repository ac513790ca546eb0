#include "interpreter/configuration/tool_bodies.h"

#include <gtest/gtest.h>

#include <string>

#include <fmt/format.h>

#include "interpreter/configuration/read.h"
#include "interpreter/solids/tool_shapes.h"

namespace isocnc::configuration {
namespace {

using dialect::Language;
using verification::ToolBodies;

/// A configuration with one tool of these keys, and two holders of 77 mm and 40 mm.
std::string with_tool(std::string_view keys) {
  return fmt::format(
      R"({{"machine": {{"holders": {{"HSK63-ER32": [[35, 50, 50], [42, 50, 63]], "SK40": [[40, 30, 40]]}},
"tools": [
{{"head": 1, "holder": 1, "tool": 1, {}}}]}}}})",
      keys);
}

std::string tool_mistakes(std::string_view keys, Language language = Language::English) {
  const std::string text = with_tool(keys);
  std::string said;
  for (const Mistake& mistake : read_configuration(text, "/").mistakes)
    said += (said.empty() ? "" : "\n") + mistake.message(language);
  return said;
}

ToolBodies bodies_of(std::string_view keys) {
  const ReadConfiguration read = read_configuration(with_tool(keys), "/");
  EXPECT_TRUE(read.mistakes.empty()) << keys;
  const MachineConfiguration& machine = read.configuration.machine;
  return std::get<ToolBodies>(tool_bodies(machine, machine.tools->front()));
}

/// Where a body begins and ends, and its largest radius.
std::string extent_of(const std::optional<solids::RevolvedBody>& body) {
  if (!body) return "none";
  return fmt::format("{:.6g} to {:.6g}, {:.6g}", body->bottom(), body->top(), body->maximum_radius());
}

TEST(ToolBodies, GoFromTheTipToTheNose) {
  const ToolBodies tool = bodies_of(
      R"("length": 150.5, "radius": 10, "shape": "flat", "cutLength": 45, "shank": 25, "body": "HSK63-ER32")");
  EXPECT_EQ(tool.length, 150.5);
  EXPECT_EQ(extent_of(tool.cutter), "0 to 45, 10");
  EXPECT_EQ(extent_of(tool.shank), "45 to 73.5, 12.5");
  EXPECT_EQ(extent_of(tool.holder), "73.5 to 150.5, 31.5");
}

TEST(ToolBodies, HaveTheCutterUpToTheHolderUnlessItEndsBefore) {
  EXPECT_EQ(extent_of(bodies_of(R"("length": 90, "radius": 4, "shape": "ball")").cutter), "0 to 90, 4");
  const ToolBodies held = bodies_of(R"("length": 90, "radius": 4, "shape": "ball", "body": "SK40")");
  EXPECT_EQ(extent_of(held.cutter), "0 to 50, 4");
  EXPECT_EQ(extent_of(held.shank), "none");
  EXPECT_EQ(extent_of(held.holder), "50 to 90, 20");
  const ToolBodies shorter = bodies_of(R"("length": 90, "radius": 4, "shape": "flat", "cutLength": 30)");
  EXPECT_EQ(extent_of(shorter.cutter), "0 to 30, 4");
  EXPECT_EQ(extent_of(shorter.shank), "30 to 90, 4");
}

TEST(ToolBodies, HaveTheHolderWithTheColletBelow) {
  const auto holder = bodies_of(R"("length": 100, "body": "SK40")").holder;
  ASSERT_EQ(holder->pieces().size(), 1U);
  EXPECT_EQ(holder->pieces()[0].core.bottom, 60);
  EXPECT_EQ(holder->pieces()[0].core.bottom_radius, 15);
  EXPECT_EQ(holder->pieces()[0].core.top_radius, 20);
}

/// The body, as the function of solids makes it.
void expect_same(const std::optional<solids::RevolvedBody>& body, const solids::BodyOrProblem& wanted) {
  const auto& expected = std::get<solids::RevolvedBody>(wanted);
  ASSERT_TRUE(body);
  ASSERT_EQ(body->pieces().size(), expected.pieces().size());
  for (std::size_t i = 0; i < expected.pieces().size(); ++i) {
    const solids::BodyPiece& a = body->pieces()[i];
    const solids::BodyPiece& b = expected.pieces()[i];
    EXPECT_EQ(a.rounding, b.rounding);
    EXPECT_EQ(a.core.bottom, b.core.bottom);
    EXPECT_EQ(a.core.bottom_radius, b.core.bottom_radius);
    EXPECT_EQ(a.core.top, b.core.top);
    EXPECT_EQ(a.core.top_radius, b.core.top_radius);
  }
}

TEST(ToolBodies, HaveTheirShape) {
  const std::string size = R"("length": 60, "radius": 8, )";
  expect_same(bodies_of(size + R"("shape": "flat")").cutter, solids::flat_body(8, 60));
  expect_same(bodies_of(size + R"("shape": "ball")").cutter, solids::ball_body(8, 60));
  expect_same(bodies_of(size + R"("shape": "bull", "cornerRadius": 3)").cutter, solids::bull_body(8, 3, 60));
  expect_same(bodies_of(size + R"("shape": "cone", "tipAngle": 60)").cutter, solids::cone_body(8, 0, 60, 60));
  expect_same(bodies_of(size + R"("shape": "drill", "tipAngle": 118)").cutter, solids::drill_body(8, 118, 60));
  expect_same(bodies_of(size + R"("shape": "flat", "cornerRadius": 0, "tipAngle": 118)").cutter,
              solids::flat_body(8, 60));
  const ToolBodies disc = bodies_of(R"("length": 60, "radius": 50, "shape": "disc", "cutLength": 4, "shank": 16)");
  expect_same(disc.cutter, solids::disc_body(50, 4));
  EXPECT_EQ(extent_of(disc.shank), "4 to 60, 8");
}

TEST(ToolBodies, HaveNoCutterWithoutAShape) {
  const ToolBodies known = bodies_of(R"("length": 60, "radius": 8)");
  EXPECT_EQ(known.length, 60);
  EXPECT_FALSE(known.cutter || known.shank || known.holder);
  const ToolBodies with_shank = bodies_of(R"("length": 60, "radius": 8, "cutLength": 20, "shank": 10)");
  EXPECT_EQ(extent_of(with_shank.cutter), "none");
  EXPECT_EQ(extent_of(with_shank.shank), "20 to 60, 5");
  EXPECT_EQ(bodies_of(R"("radius": 8, "cutLength": 70)").length, 0);
}

TEST(ToolBodies, FollowAProfile) {
  const std::string profile = R"("length": 60, "profile": [[0, 2], [10, 12], [10, 5], [30, 5]])";
  EXPECT_EQ(extent_of(bodies_of(profile).cutter), "0 to 30, 12");
  EXPECT_EQ(extent_of(bodies_of(profile).shank), "30 to 60, 5");
  EXPECT_EQ(extent_of(bodies_of(profile + R"(, "shank": 14)").shank), "30 to 60, 7");
  const ToolBodies divided = bodies_of(profile + R"(, "cutLength": 5, "shank": 14)");
  EXPECT_EQ(extent_of(divided.cutter), "0 to 5, 7");
  EXPECT_EQ(extent_of(divided.shank), "5 to 60, 12");
  const ToolBodies at_step = bodies_of(profile + R"(, "cutLength": 10)");
  EXPECT_EQ(extent_of(at_step.cutter), "0 to 10, 12");
  EXPECT_EQ(extent_of(at_step.shank), "10 to 60, 5");
  EXPECT_EQ(extent_of(bodies_of(R"("length": 60, "profile": [[0, 5], [60, 5]])").shank), "none");
}

TEST(ToolBodies, NeedKeysThatOthersDoNot) {
  const std::pair<std::string, std::string> wrong[] = {
      {R"("radius": 5, "shape": "flat")", "shape: this needs the key length"},
      {R"("profile": [[0, 5], [9, 5]])", "profile: this needs the key length"},
      {R"("cutLength": 9, "shank": 5)", "shank: this needs the key length"},
      {R"("body": "SK40")", "body: this needs the key length"},
      {R"("length": 90, "shape": "flat")", "shape: this needs the key radius"},
      {R"("length": 90, "radius": 5, "shape": "bull")", "shape: this needs the key cornerRadius"},
      {R"("length": 90, "radius": 5, "shape": "cone")", "shape: this needs the key tipAngle"},
      {R"("length": 90, "radius": 5, "shape": "drill")", "shape: this needs the key tipAngle"},
      {R"("length": 90, "radius": 5, "shape": "disc", "shank": 4)", "shank: this needs the key cutLength"},
      {R"("length": 90, "radius": 5, "shape": "disc", "cutLength": 4)", "shape: this needs the key shank"},
      {R"("length": 90, "radius": 5, "shape": "flat", "shank": 4)", "shank: this needs the key cutLength"},
  };
  for (const auto& [keys, said] : wrong) EXPECT_EQ(tool_mistakes(keys), "machine.tools[0]." + said) << keys;
}

TEST(ToolBodies, ContradictThemselves) {
  const std::pair<std::string, std::string> wrong[] = {
      {R"("length": 90, "radius": 5, "shape": "flat", "profile": [[0, 5], [9, 5]])",
       "profile: there is shape already; one of them is enough"},
      {R"("length": 90, "radius": 5, "shape": "flat", "cornerRadius": 1)",
       "cornerRadius: only a tool with the shape bull has this"},
      {R"("length": 90, "radius": 5, "shape": "bull", "cornerRadius": 5.5)",
       "cornerRadius: 5.5 is too large: at most 5 mm"},
      {R"("length": 90, "radius": 5, "shape": "ball", "cutLength": 9)", "cutLength: 9 is too small: at least 10 mm"},
      {R"("length": 90, "radius": 30, "shape": "ball", "body": "SK40")",
       "length: 50 mm of the tool are outside the holder, and its shape needs 60 mm"},
      {R"("length": 90, "radius": 5, "shape": "flat", "cutLength": 50.5, "body": "SK40")",
       "cutLength: 50.5 is too large: 50 mm of the tool are outside the holder"},
      {R"("length": 90, "body": "SK4")", "body: there is no SK4 in machine.holders; did you mean SK40?"},
      {R"("length": 77, "body": "HSK63-ER32")", "body: the holder is 77 mm high, and the tool 77 mm long"},
      {R"("length": 90, "profile": [[1, 5], [9, 5]])",
       "profile[0][0]: the rows start at the tip, that is at z = 0, not at 1 mm"},
      {R"("length": 90, "profile": [[0, 5], [9, 5], [8, 4]])", "profile[2][0]: 8 is less than 9 in the row before"},
      {R"("length": 90, "profile": [[0, 5], [0, 7]])", "profile: these rows enclose nothing"},
      {R"("length": 90, "profile": [[0, 5]])", "profile: these rows enclose nothing"},
      {R"("length": 90, "profile": [[0, 5], [51, 7]], "body": "SK40")",
       "profile[1][0]: 51 is too large: 50 mm of the tool are outside the holder"},
      {R"("length": 90, "profile": [[0, 5], [20, 7]], "cutLength": 21)", "cutLength: 21 is too large: at most 20 mm"},
      {R"("length": 90, "profile": [[0, 0], [20, 0], [30, 4]], "cutLength": 15)",
       "cutLength: these rows enclose nothing"},
  };
  for (const auto& [keys, said] : wrong) {
    EXPECT_EQ(tool_mistakes(keys), "machine.tools[0]." + said) << keys;
    const std::string italian = tool_mistakes(keys, Language::Italian);
    EXPECT_TRUE(italian.starts_with("machine.tools[0]." + said.substr(0, said.find(':') + 1))) << italian;
    EXPECT_NE(italian, tool_mistakes(keys)) << keys;
  }
}

/// Other mistakes could be why a holder is missing.
TEST(ToolBodies, AreJudgedInAFileWithoutOtherMistakes) {
  const std::string text = R"({"machine": {"holders": {"a": [[1, 2]]},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 90, "body": "a"}]}})";
  EXPECT_EQ(read_configuration(text, "/").mistakes.size(), 1U);
}

TEST(ToolBodies, HaveAsManyRowsAsSolidsTake) {
  const auto read = [](std::size_t rows) {
    std::string text;
    for (std::size_t i = 0; i < rows; ++i) text += fmt::format("{}[0.1, 5, 5]", i == 0 ? "" : ", ");
    const std::string all = fmt::format(R"({{"machine": {{"nose": [{}]}}}})", text);
    const ReadConfiguration result = read_configuration(all, "/");
    return result.mistakes.empty() ? "" : result.mistakes.front().message(Language::English);
  };
  EXPECT_EQ(read(solids::kMaxShapePoints), "");
  EXPECT_EQ(read(solids::kMaxShapePoints + 1), "machine.nose: more than 256 rows");
}

}  // namespace
}  // namespace isocnc::configuration
