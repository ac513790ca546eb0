#include "interpreter/solids/stl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using Refusal = StlProblem::Kind;

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n";

std::string text_with(const std::string& facets) { return "solid a part\n" + facets + "endsolid a part\n"; }

/// A coordinate replaced by another word.
std::string text_with_coordinate(const std::string& word) {
  std::string facet = kFacet;
  facet.replace(facet.find("1 0 0"), 1, word);
  return text_with(facet);
}

std::string number(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
  return bytes;
}

/// A binary file that states `stated` triangles and has `held`, whose coordinates are 0, 1, 2, ...
std::string binary(std::uint32_t stated, std::uint32_t held, const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  bytes += number(stated);
  for (std::uint32_t i = 0; i < held; ++i) {
    bytes.append(12, '\0');
    for (std::uint32_t j = 0; j < 9; ++j) bytes += number(std::bit_cast<std::uint32_t>(static_cast<float>(9 * i + j)));
    bytes.append(2, '\x7F');
  }
  return bytes;
}

std::string binary_with_coordinate(float value) {
  std::string bytes = binary(1, 1);
  return bytes.replace(84 + 12 + 8, 4, number(std::bit_cast<std::uint32_t>(value)));
}

const std::vector<Triangle>& triangles_of(const TrianglesOrProblem& read) {
  return std::get<std::vector<Triangle>>(read);
}

TEST(Stl, ReadsText) {
  const auto read = read_stl(text_with(kFacet));
  ASSERT_EQ(triangles_of(read).size(), 1U);
  EXPECT_EQ(triangles_of(read)[0].corners[1], geometry::Vec3(1, 0, 0));
}

TEST(Stl, ReadsTextInAnyCaseWithAnyBlanks) {
  std::string text = "\r\n SOLID\r\n" + kFacet + "\tEndSolid";
  EXPECT_EQ(triangles_of(read_stl(text)).size(), 1U);
  EXPECT_EQ(triangles_of(read_stl(text_with_coordinate("+1.25E+01")))[0].corners[1].x(), 12.5);
  EXPECT_EQ(triangles_of(read_stl(text_with(kFacet) + "\n" + text_with(kFacet + kFacet))).size(), 3U);
}

TEST(Stl, ReadsTextWithAByteOrderMarkAndLoneCarriageReturns) {
  EXPECT_EQ(triangles_of(read_stl("\xEF\xBB\xBF" + text_with(kFacet))).size(), 1U);
  std::string text = text_with(kFacet);
  std::replace(text.begin(), text.end(), '\n', '\r');
  EXPECT_EQ(triangles_of(read_stl(text)).size(), 1U);
}

TEST(Stl, ReadsBinary) {
  const auto read = read_stl(binary(2, 2));
  ASSERT_EQ(triangles_of(read).size(), 2U);
  EXPECT_EQ(triangles_of(read)[1].corners[2], geometry::Vec3(15, 16, 17));
}

/// Several programs write a header that starts like text.
TEST(Stl, ReadsBinaryThatStartsWithSolid) {
  EXPECT_EQ(triangles_of(read_stl(binary(2, 2, "solid of a CAD system"))).size(), 2U);
}

TEST(Stl, ReadsWhatItWrites) {
  const std::vector<Triangle> ball = scenes::bumpy_ball({1, 2, 3}, 10, 6, 0.1);
  const std::string bytes = write_stl(ball);
  const auto read = read_stl(bytes);
  ASSERT_EQ(triangles_of(read).size(), ball.size());
  for (std::size_t i = 0; i < ball.size(); ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_TRUE(triangles_of(read)[i].corners[j].isApprox(ball[i].corners[j], 1e-6));
}

struct BadFile {
  const char* what;
  std::string bytes;
  Refusal kind;
  std::size_t line = 0;
};

std::vector<BadFile> bad_files() {
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  return {
      {"nothing", "", Refusal::Empty},
      {"a few bytes", "PK", Refusal::Truncated},
      {"header alone", std::string(80, 'x'), Refusal::Truncated},
      {"2^32 triangles claimed", binary(0xFFFFFFFF, 1), Refusal::Truncated},
      {"2^32 triangles claimed after solid", binary(0xFFFFFFFF, 1, "Solid"), Refusal::Truncated},
      {"cut off", binary(3, 3).substr(0, 200), Refusal::Truncated},
      {"more than stated", binary(0, 3), Refusal::TooLong},
      {"binary without triangles", binary(0, 0), Refusal::Empty},
      {"binary NaN", binary_with_coordinate(not_a_number), Refusal::NotFinite},
      {"binary infinite", binary_with_coordinate(-infinite), Refusal::NotFinite},
      {"binary far away", binary_with_coordinate(1e30F), Refusal::TooFar},
      {"text without triangles", text_with(""), Refusal::Empty, 3},
      {"text cut off", text_with(kFacet).substr(0, 60), Refusal::Truncated, 5},
      {"no endsolid", "solid\n" + kFacet, Refusal::Truncated, 9},
      {"a huge name", "solid " + std::string(1'000'000, 'x'), Refusal::Truncated, 1},
      {"no normal", text_with("facet outer loop\n"), Refusal::UnexpectedWord, 2},
      {"a normal cut off", "solid\nfacet normal 0 0", Refusal::Truncated, 2},
      {"no loop", text_with("facet normal 0 0 1 vertex 0 0 0\n"), Refusal::UnexpectedWord, 2},
      {"another word", text_with("face\n"), Refusal::UnexpectedWord, 2},
      {"four corners", text_with("facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 1 1 0 vertex 0 1 0"),
       Refusal::UnexpectedWord, 2},
      {"text NaN", text_with_coordinate("nan"), Refusal::NotFinite, 5},
      {"text infinite", text_with_coordinate("-inf"), Refusal::NotFinite, 5},
      {"text overflow", text_with_coordinate("1e999"), Refusal::NotFinite, 5},
      {"text far away", text_with_coordinate("1000001"), Refusal::TooFar, 5},
      {"text with a comma", text_with_coordinate("1,5"), Refusal::NotANumber, 5},
      {"text hexadecimal", text_with_coordinate("0x10"), Refusal::NotANumber, 5},
      {"only a sign", text_with_coordinate("+"), Refusal::NotANumber, 5},
      {"zeros", std::string(1000, '\0'), Refusal::TooLong},
  };
}

TEST(Stl, RefusesHostileFiles) {
  for (const BadFile& bad : bad_files()) {
    SCOPED_TRACE(bad.what);
    const auto read = read_stl(bad.bytes);
    const auto* const problem = std::get_if<StlProblem>(&read);
    ASSERT_TRUE(problem);
    EXPECT_EQ(static_cast<int>(problem->kind), static_cast<int>(bad.kind));
    EXPECT_EQ(problem->line, bad.line);
    EXPECT_LE(problem->offset, bad.bytes.size());
  }
}

TEST(Stl, SaysWhereABinaryFileIsWrong) {
  std::string bytes = binary(3, 3);
  bytes.replace(84 + 2 * 50 + 12, 4, number(0x7FC00000));
  const auto read = read_stl(bytes);
  const auto& problem = std::get<StlProblem>(read);
  EXPECT_EQ(problem.triangle, 2U);
  EXPECT_EQ(problem.offset, 84U + 2 * 50 + 12);
  EXPECT_EQ(std::get<StlProblem>(read_stl(binary(7, 3))).stated, 7U);
  EXPECT_EQ(std::get<StlProblem>(read_stl(binary(0, 0))).offset, 80U) << "where the number of triangles is";
}

TEST(Stl, KeepsDegenerateTriangles) {
  const std::string point = "facet normal 0 0 0 outer loop vertex 1 1 1 vertex 1 1 1 vertex 1 1 1 endloop endfacet\n";
  const Mesh mesh(triangles_of(read_stl(text_with(point))));
  EXPECT_EQ(mesh.topology().degenerate, 1U);
  const RevolvedBody tool = scenes::body(flat_body(1, 10));
  EXPECT_NEAR(clearance(tool, {{1, 1, 3}, {0, 0, 1}}, mesh).lower, 2, 2e-6);
}

}  // namespace
}  // namespace isocnc::solids
