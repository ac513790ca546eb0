#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session.h"

/// What stands over each tool section.
namespace isocnc::lsp {
namespace {

constexpr const char* kUri = "file:///nowhere/part.iso";
const Json kParams = {{"textDocument", {{"uri", kUri}}}};

TEST(CodeLens, TellsTheTimeAndPathOfEachToolSection) {
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
