#include "analyzer/input/gitignore.h"

#include <gtest/gtest.h>

#include <string>

namespace isocnc::input {
namespace {

/// Asks rules at the root of a work tree for paths below it; a path that ends in a slash is a directory.
bool ignores(const GitIgnore& rules, std::string path) {
  const bool is_directory = path.ends_with('/');
  if (is_directory) path.pop_back();
  return rules.ignores("/shop/" + path, is_directory);
}

bool ignores(std::string_view rules, const std::string& path) {
  return ignores(GitIgnore{}.with(rules, "/shop"), path);
}

TEST(GitIgnore, WithoutRulesNothingIsIgnored) {
  EXPECT_FALSE(ignores(GitIgnore{}, "part.iso"));
  EXPECT_FALSE(ignores("", "part.iso"));
  EXPECT_FALSE(ignores("\n\n", "part.iso"));
}

TEST(GitIgnore, NameWithoutSlashIsFoundAtAnyDepth) {
  EXPECT_TRUE(ignores("part.iso", "part.iso"));
  EXPECT_TRUE(ignores("part.iso", "old/2019/part.iso"));
  EXPECT_TRUE(ignores("part.iso", "part.iso/"));
  EXPECT_FALSE(ignores("part.iso", "part.iso.bak"));
  EXPECT_FALSE(ignores("part.iso", "my-part.iso"));
}

TEST(GitIgnore, PathIsTakenFromTheDirectoryOfTheRules) {
  EXPECT_TRUE(ignores("/part.iso", "part.iso"));
  EXPECT_FALSE(ignores("/part.iso", "old/part.iso"));
  EXPECT_TRUE(ignores("old/part.iso", "old/part.iso"));
  EXPECT_FALSE(ignores("old/part.iso", "very/old/part.iso"));
}

TEST(GitIgnore, RulesSayNothingOfOtherDirectories) {
  const GitIgnore rules = GitIgnore{}.with("*.iso\n/part.nc\n", "/shop/old");
  EXPECT_TRUE(ignores(rules, "old/part.iso"));
  EXPECT_TRUE(ignores(rules, "old/2019/part.iso"));
  EXPECT_TRUE(ignores(rules, "old/part.nc"));
  EXPECT_FALSE(ignores(rules, "part.iso"));
  EXPECT_FALSE(ignores(rules, "older/part.iso"));
}

TEST(GitIgnore, WorkTreeMayBeTheWholeFileSystem) {
  const GitIgnore rules = GitIgnore{}.with("/part.iso", "/");
  EXPECT_TRUE(rules.ignores("/part.iso", false));
  EXPECT_FALSE(rules.ignores("/old/part.iso", false));
}

TEST(GitIgnore, SlashAtTheEndMeansDirectoriesOnly) {
  EXPECT_TRUE(ignores("old/", "old/"));
  EXPECT_FALSE(ignores("old/", "old"));
  EXPECT_TRUE(ignores("old/", "very/old/"));
  EXPECT_TRUE(ignores("/old/", "old/"));
  EXPECT_FALSE(ignores("/old/", "very/old/"));
}

TEST(GitIgnore, CommentsAreNoRules) {
  EXPECT_FALSE(ignores("#part.iso", "#part.iso"));
  EXPECT_TRUE(ignores("\\#part.iso", "#part.iso"));
  EXPECT_TRUE(ignores("part#1.iso", "part#1.iso"));
  EXPECT_TRUE(ignores(" #part.iso", " #part.iso"));
}

TEST(GitIgnore, BlanksAtTheEndDoNotCountUnlessEscaped) {
  EXPECT_TRUE(ignores("part.iso   ", "part.iso"));
  EXPECT_FALSE(ignores("part\\ ", "part"));
  EXPECT_TRUE(ignores("part\\ ", "part "));
  EXPECT_TRUE(ignores("part\\   ", "part "));
  EXPECT_TRUE(ignores("my part.iso", "my part.iso"));
  EXPECT_TRUE(ignores("part\t", "part\t"));
  EXPECT_FALSE(ignores("   ", "   "));
}

TEST(GitIgnore, LinesEndAsInWindowsToo) {
  EXPECT_TRUE(ignores("*.tap\r\npart.iso\r\n", "part.iso"));
  EXPECT_TRUE(ignores("*.tap\r\npart.iso\r\n", "part.tap"));
}

TEST(GitIgnore, ByteOrderMarkIsSkipped) { EXPECT_TRUE(ignores("\xEF\xBB\xBFpart.iso\n", "part.iso")); }

TEST(GitIgnore, LastRuleThatNamesThePathDecides) {
  EXPECT_FALSE(ignores("*.iso\n!part.iso\n", "part.iso"));
  EXPECT_TRUE(ignores("*.iso\n!part.iso\n", "other.iso"));
  EXPECT_TRUE(ignores("!part.iso\n*.iso\n", "part.iso"));
  EXPECT_TRUE(ignores("*.iso\n!part.iso\npart.*\n", "part.iso"));
  EXPECT_TRUE(ignores("\\!part.iso", "!part.iso"));
}

TEST(GitIgnore, RulesOfAnInnerDirectoryAreStronger) {
  const GitIgnore outer = GitIgnore{}.with("*.iso\n", "/shop");
  const GitIgnore inner = outer.with("!part.iso\n", "/shop/old");
  EXPECT_FALSE(ignores(inner, "old/part.iso"));
  EXPECT_TRUE(ignores(inner, "old/other.iso"));
  EXPECT_TRUE(ignores(inner, "part.iso"));
  EXPECT_TRUE(ignores(outer, "old/part.iso"));
}

TEST(GitIgnore, StarStopsAtASlash) {
  EXPECT_TRUE(ignores("*.iso", "part.iso"));
  EXPECT_TRUE(ignores("p*t*.iso", "part-2.iso"));
  EXPECT_TRUE(ignores("part*", "part"));
  EXPECT_TRUE(ignores("/old/*.iso", "old/part.iso"));
  EXPECT_FALSE(ignores("/old/*.iso", "old/2019/part.iso"));
  EXPECT_TRUE(ignores("/*/part.iso", "old/part.iso"));
  EXPECT_FALSE(ignores("/*/part.iso", "very/old/part.iso"));
  EXPECT_FALSE(ignores("/*/part.iso", "part.iso"));
}

TEST(GitIgnore, ManyStarsTakeNoLongerThanTheTextIsLong) {
  const std::string name(200, 'a');
  std::string rule;
  for (int i = 0; i < 50; ++i) rule += "a*";
  EXPECT_TRUE(ignores(rule, name));
  EXPECT_FALSE(ignores(rule + "b", name));
}

TEST(GitIgnore, QuestionMarkIsOneByteButASlash) {
  EXPECT_TRUE(ignores("part?.iso", "part1.iso"));
  EXPECT_FALSE(ignores("part?.iso", "part.iso"));
  EXPECT_FALSE(ignores("part?.iso", "part12.iso"));
  EXPECT_FALSE(ignores("/old?part.iso", "old/part.iso"));
}

TEST(GitIgnore, BracketsNameBytes) {
  EXPECT_TRUE(ignores("part[1-3].iso", "part2.iso"));
  EXPECT_FALSE(ignores("part[1-3].iso", "part4.iso"));
  EXPECT_TRUE(ignores("part[ab].iso", "partb.iso"));
  EXPECT_FALSE(ignores("part[!a].iso", "parta.iso"));
  EXPECT_TRUE(ignores("part[!a].iso", "partb.iso"));
  EXPECT_TRUE(ignores("part[^a].iso", "partb.iso"));
  EXPECT_TRUE(ignores("part[]a].iso", "part].iso"));
  EXPECT_TRUE(ignores("part[a-].iso", "part-.iso"));
  EXPECT_TRUE(ignores("part[\\]].iso", "part].iso"));
  EXPECT_TRUE(ignores("part[[:digit:]x].iso", "part7.iso"));
  EXPECT_FALSE(ignores("part[[:digit:]x].iso", "part:.iso"));
  EXPECT_FALSE(ignores("/old[!a]part.iso", "old/part.iso"));
}

TEST(GitIgnore, MalformedPatternNamesNothing) {
  EXPECT_FALSE(ignores("part[1", "part[1"));
  EXPECT_FALSE(ignores("part[[:nothing:]]", "partn"));
  EXPECT_FALSE(ignores("part\\", "part\\"));
  EXPECT_FALSE(ignores("/", "part"));
  EXPECT_FALSE(ignores("!", "part"));
}

TEST(GitIgnore, BackslashTakesTheNextByteAsItIs) {
  EXPECT_TRUE(ignores("\\*.iso", "*.iso"));
  EXPECT_FALSE(ignores("\\*.iso", "part.iso"));
  EXPECT_TRUE(ignores("\\[a]", "[a]"));
  EXPECT_TRUE(ignores("p\\art", "part"));
}

TEST(GitIgnore, TwoStarsAndASlashAreAnyDirectories) {
  EXPECT_TRUE(ignores("**/part.iso", "part.iso"));
  EXPECT_TRUE(ignores("**/part.iso", "very/old/part.iso"));
  EXPECT_FALSE(ignores("**/part.iso", "my-part.iso"));
  EXPECT_TRUE(ignores("**/old/part.iso", "very/old/part.iso"));
  EXPECT_FALSE(ignores("**/old/part.iso", "bold/part.iso"));
}

TEST(GitIgnore, SlashAndTwoStarsAreAllThatLiesInside) {
  EXPECT_TRUE(ignores("old/**", "old/part.iso"));
  EXPECT_TRUE(ignores("old/**", "old/2019/part.iso"));
  EXPECT_FALSE(ignores("old/**", "old/"));
  EXPECT_FALSE(ignores("old/**", "very/old/part.iso"));
}

TEST(GitIgnore, TwoStarsBetweenSlashesAreDirectoriesOrNone) {
  EXPECT_TRUE(ignores("old/**/part.iso", "old/part.iso"));
  EXPECT_TRUE(ignores("old/**/part.iso", "old/2019/part.iso"));
  EXPECT_TRUE(ignores("old/**/part.iso", "old/2019/may/part.iso"));
  EXPECT_FALSE(ignores("old/**/part.iso", "old/2019/my-part.iso"));
  EXPECT_TRUE(ignores("old/**/p*/**/*.iso", "old/a/b/parts/c/d/x.iso"));
  EXPECT_FALSE(ignores("old/**/p*/**/*.iso", "old/a/b/c/d/x.iso"));
}

TEST(GitIgnore, OtherTwoStarsAreOne) {
  EXPECT_TRUE(ignores("part**", "part.iso"));
  EXPECT_TRUE(ignores("/old/p**t.iso", "old/part.iso"));
  EXPECT_FALSE(ignores("/old/*p**t.iso", "old/parts/lot.iso"));
}

}  // namespace
}  // namespace isocnc::input
