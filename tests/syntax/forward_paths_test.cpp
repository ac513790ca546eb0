#include "interpreter/syntax/forward_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/syntax/each_tree.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::syntax {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// The comments on each path, one text for each path.
struct Trails {
  std::set<std::string> all;

  bool empty() const { return all.empty(); }
  void join(Trails&& other) { all.merge(other.all); }
  void pass(const LineTree& line) {
    std::set<std::string> longer;
    for (const std::string& trail : all) {
      std::string text = trail;
      for (const Span& comment : line.comments) text += line.text_of({comment.begin + 1, comment.end - 1});
      longer.insert(text);
    }
    all = longer;
  }

  friend bool operator==(const Trails&, const Trails&) = default;
};

/// The trails that come to each line.
std::vector<std::set<std::string>> trails_to_lines(std::string_view text) {
  ForwardPaths<Trails> paths(Trails{{""}});
  std::vector<std::set<std::string>> found;
  each_tree(text, [&](const LineTree& line, std::string_view) {
    const Trails seen = paths.live_at(line);
    paths.arrive(line);
    EXPECT_EQ(paths.live, seen);
    found.push_back(paths.live.all);
    paths.pass(line, [&](Trails& trails) { trails.pass(line); });
  });
  return found;
}

std::set<std::string> trails_to_last_line(std::string_view text) { return trails_to_lines(text).back(); }

TEST(ForwardPaths, GoThroughLinesInOrder) { EXPECT_THAT(trails_to_last_line("(a)\n(b)\n(c)\n\n"), ElementsAre("abc")); }

TEST(ForwardPaths, SplitAtAJumpAndJoinAtItsLabel) {
  const auto trails = trails_to_lines("(a)\nIF VGPL=1 GOTO N9\n(b)\nN9 (c)\n(d)\n");
  EXPECT_THAT(trails[2], ElementsAre("a"));
  EXPECT_THAT(trails[3], ElementsAre("a", "ab"));
  EXPECT_THAT(trails[4], ElementsAre("abc", "ac"));
}

TEST(ForwardPaths, JoinAllThatHasJumpedToALabel) {
  EXPECT_THAT(trails_to_last_line("IF VGPL=1 GOTO N9\n(a)\nIF VGPL=1 GOTO N9\n(b)\nIF VGPL=2 GOTO N9\n(c)\nN9\n"),
              ElementsAre("", "a", "ab", "abc"));
}

TEST(ForwardPaths, EndAtAnM02AndGoOnAtALabel) {
  const auto trails = trails_to_lines("IF VGPL=1 GOTO N9\n(a)\nM02\n(b)\nN9 (c)\n\n");
  EXPECT_THAT(trails[3], IsEmpty());
  EXPECT_THAT(trails[4], ElementsAre(""));
  EXPECT_THAT(trails[5], ElementsAre("c"));
}

/// A jump goes to the first line below that has its label (D50).
TEST(ForwardPaths, AreDoneWithALabelOnceTheyHaveArrived) {
  const auto trails = trails_to_lines("IF VGPL=1 GOTO N9\nN9\nM02\nN9 (a)\n\n");
  EXPECT_THAT(trails[1], ElementsAre(""));
  EXPECT_THAT(trails[4], IsEmpty());
}

TEST(ForwardPaths, OpenNoPathFromLinesThatNoneReaches) {
  EXPECT_THAT(trails_to_last_line("M02\nIF VGPL=1 GOTO N9\nN9\n"), IsEmpty());
  ForwardPaths<Trails> paths;
  paths.pass(ParsedLine("IF VGPL=1 GOTO N9").tree(), [](Trails&) { ADD_FAILURE() << "There is no value to change."; });
  EXPECT_TRUE(paths.finished());
}

TEST(ForwardPaths, IgnoreJumpsWithoutATargetAndLabelsThatNoneNames) {
  EXPECT_THAT(trails_to_last_line("N1\nIF VGPL=1 GOTO\n(a)\nN2\nN3\n"), ElementsAre("a"));
}

TEST(ForwardPaths, AreFinishedWhenNoneGoesOn) {
  ForwardPaths<Trails> paths;
  EXPECT_TRUE(paths.finished());
  EXPECT_EQ(paths.jump(7, {{"a"}}).all, std::set<std::string>{"a"});
  EXPECT_EQ(paths.jump(7, {{"b"}}).all.size(), 2u);
  paths.jump(9, {{"c"}});
  EXPECT_FALSE(paths.finished());
  EXPECT_EQ(paths.waiting().size(), 2u);
  paths.drop_highest_label();
  EXPECT_TRUE(paths.waiting().contains(7));
  EXPECT_TRUE(paths.arrive(ParsedLine("N7").tree()));
  EXPECT_FALSE(paths.arrive(ParsedLine("N7").tree()));
  EXPECT_FALSE(paths.finished());
  paths.end();
  EXPECT_TRUE(paths.finished());
}

TEST(ForwardPaths, ChangeEachReachesThoseThatWait) {
  ForwardPaths<Trails> paths(Trails{{"a"}});
  paths.jump(7, {{"b"}});
  ForwardPaths<Trails> same = paths;
  EXPECT_EQ(paths, same);
  paths.change_each([](Trails& trails) { trails.all.insert("c"); });
  EXPECT_NE(paths, same);
  EXPECT_THAT(paths.live.all, ElementsAre("a", "c"));
  EXPECT_THAT(paths.waiting().at(7).all, ElementsAre("b", "c"));
}

}  // namespace
}  // namespace isocnc::syntax
