#include "interpreter/configuration/path_patterns.h"

#include <gtest/gtest.h>

namespace isocnc::configuration {
namespace {

bool matches(const std::string& pattern, const char* file) {
  return PathPatterns("/shop/parts", {pattern}).match(file);
}

TEST(PathPatterns, NameFilesWhereverTheyAre) {
  EXPECT_TRUE(matches("*.nc", "/shop/parts/a.nc"));
  EXPECT_TRUE(matches("*.nc", "/shop/parts/deep/er/a.nc"));
  EXPECT_FALSE(matches("*.nc", "/shop/parts/a.iso"));
  EXPECT_FALSE(matches("a", "/shop/parts/ab"));
}

TEST(PathPatterns, NamePathsFromTheirFolder) {
  EXPECT_TRUE(matches("old/*.iso", "/shop/parts/old/a.iso"));
  EXPECT_TRUE(matches("/a.iso", "/shop/parts/a.iso"));
  EXPECT_TRUE(matches("./a.iso", "/shop/parts/a.iso"));
  EXPECT_TRUE(matches("**/b/*.iso", "/shop/parts/x/y/b/a.iso"));
  EXPECT_FALSE(matches("old/*.iso", "/shop/parts/x/old/a.iso"));
  EXPECT_FALSE(matches("/a.iso", "/shop/parts/x/a.iso"));
}

TEST(PathPatterns, NameWhatLiesInAFolder) {
  EXPECT_TRUE(matches("old", "/shop/parts/old/deep/a.iso"));
  EXPECT_TRUE(matches("old/", "/shop/parts/x/old/a.iso"));
  EXPECT_TRUE(matches("x/old/", "/shop/parts/x/old/deep/a.iso"));
  EXPECT_FALSE(matches("old/", "/shop/parts/old"));
}

TEST(PathPatterns, DoNotLookAboveTheirFolder) {
  EXPECT_FALSE(matches("parts", "/shop/parts/a.iso"));
  EXPECT_FALSE(matches("shop", "/shop/parts/a.iso"));
  EXPECT_FALSE(matches("shop", "/shop/other/a.iso"));
  EXPECT_TRUE(matches("other", "/shop/other/a.iso"));
  EXPECT_TRUE(matches("*.iso", "/elsewhere/a.iso"));
  EXPECT_FALSE(matches("/elsewhere/*.iso", "/elsewhere/a.iso"));
}

/// As a search finds programs by their extensions.
TEST(PathPatterns, MatchInUpperAndLowerCase) {
  EXPECT_TRUE(matches("*.iso", "/shop/parts/PART.ISO"));
  EXPECT_TRUE(matches("Old/[A-C]*.ISO", "/shop/parts/old/b1.iso"));
  EXPECT_FALSE(matches("*.iso", "/shop/parts/PART.NC"));
}

TEST(PathPatterns, AreWellFormedOrNot) {
  for (const char* const pattern : {"a", "*", "a/", "/a/", "[a-z]*.iso", "**/x", "\\!a"})
    EXPECT_TRUE(PathPatterns::is_well_formed(pattern)) << pattern;
  for (const char* const pattern : {"", "/", "[", "a[b", "a\\"})
    EXPECT_FALSE(PathPatterns::is_well_formed(pattern)) << pattern;
}

}  // namespace
}  // namespace isocnc::configuration
