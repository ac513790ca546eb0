#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session.h"

/// Code lenses above each tool section.
namespace isocnc::lsp {
namespace {

const Json kParams = {{"textDocument", {{"uri", kUri}}}};

TEST(CodeLens, ShowsTheTimeAndPathOfEachToolSection) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG01 X1000 F1000\nM06 T101002\nG01 X0\nX1000\nM02\n");
  const Json lenses = session.request("textDocument/codeLens", kParams);
  ASSERT_EQ(lenses.size(), 2u) << lenses;
  EXPECT_EQ(lenses[1]["range"], Json::parse(R"({"start":{"line":2,"character":0},"end":{"line":2,"character":3}})"));
  const auto title = [&](const Json& lens) { return session.request("codeLens/resolve", lens)["command"]["title"]; };
  EXPECT_THAT(title(lenses[0]), testing::AnyOf(Json("0:01:08, path 1.0 m"), Json("0:01:09, path 1.0 m")));
  EXPECT_THAT(title(lenses[1]), testing::AnyOf(Json("0:02:08, path 2.0 m"), Json("0:02:09, path 2.0 m")));
  session.edit(kUri, 2, {change(4, 0, 4, 5, "X1.2.3")});
  EXPECT_EQ(session.respond("codeLens/resolve", lenses[0])["error"]["code"], -32801);
  const Json after = session.request("textDocument/codeLens", kParams);
  EXPECT_THAT(title(after[0]), testing::AnyOf(Json("0:01:08, path 1.0 m"), Json("0:01:09, path 1.0 m")));
  EXPECT_EQ(title(after[1]), "not run");
}

/// As in isorun, an exact stop takes 0.1 s, and a rapid that turns B swings the tip.
TEST(CodeLens, CountsExactStopsAndSwings) {
  Session session;
  session.start();
  std::string program = "M06 T101001\nG01 X0 F6000\nG91\n";
  for (int i = 0; i < 100; ++i) program += "X1 G09\n";
  program += "M06 T101002\nG00 B90\nB-180\nB180\nM02\n";
  session.open(kUri, program);
  const Json lenses = session.request("textDocument/codeLens", kParams);
  ASSERT_EQ(lenses.size(), 2u) << lenses;
  const auto title = [&](const Json& lens) -> std::string {
    return session.request("codeLens/resolve", lens)["command"]["title"];
  };
  // The tool takes 8 s, the stops 10 s, and a move of 1 mm from 0.036 to 0.06 s.
  EXPECT_THAT(title(lenses[0]), testing::AllOf(testing::Ge("0:00:21"), testing::Le("0:00:25, path 0.1 m")));
  EXPECT_THAT(title(lenses[1]), testing::Not(testing::EndsWith("path 0.0 m")));
}

TEST(CodeLens, OfADocumentThatHasBeenClosedIsNoMistakeOfTheClient) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nM02\n");
  const Json lenses = session.request("textDocument/codeLens", kParams);
  session.notify("textDocument/didClose", kParams);
  EXPECT_EQ(session.respond("codeLens/resolve", lenses[0])["error"]["code"], -32801);
  EXPECT_EQ(session.respond("textDocument/codeLens", kParams)["error"]["code"], -32602);
}

TEST(CodeLens, OffersWhatTheEditorCanDo) {
  Session session;
  session.start({{"experimental", {{"commands", {{"commands", {"isocnc.run", "isocnc.debug"}}}}}}});
  session.open(kUri, "M06 T101001\nM02\n");
  const Json lenses = session.request("textDocument/codeLens", kParams);
  ASSERT_EQ(lenses.size(), 3u) << lenses;
  EXPECT_EQ(lenses[2]["command"], Json({{"title", "debug from here"},
                                        {"command", "isocnc.debug"},
                                        {"arguments", Json::array({{{"uri", kUri}, {"line", 0}}})}}));
}

TEST(CodeLens, AProgramWithoutToolsHasNone) {
  Session session;
  session.start();
  session.open(kUri, "G00 X1\n");
  EXPECT_EQ(session.request("textDocument/codeLens", kParams), Json::array());
}

}  // namespace
}  // namespace isocnc::lsp
