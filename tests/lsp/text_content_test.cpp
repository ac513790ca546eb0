#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "session.h"

/// Texts about a program that the server writes: `workspace/textDocumentContent`, and the command that shows one.
namespace isocnc::lsp {
namespace {

using testing::HasSubstr;

constexpr const char* kStateOfMove = "isocnc://state/part.iso.state?line=3&program=file%3A///nowhere/part.iso";
constexpr const char* kSyntaxOfMove = "isocnc://syntax/part.iso.syntax?line=3&program=file%3A///nowhere/part.iso";
constexpr const char* kSyntax = "isocnc://syntax/part.iso.syntax?program=file%3A///nowhere/part.iso";

constexpr const char* kFiveLines =
    "M06 T101001\n"
    "G92 X100\n"
    "G00 X0 Y2 Z1\n"
    "G01 X30 B5 F1000\n"
    "M02\n";

/// A client that can show texts of the server, unless it is told not to.
class TextContent : public testing::Test {
 protected:
  void start(const Json& capabilities, const char* locale = "en") {
    session.start(capabilities, {{"locale", locale}});
    session.open(kUri, kFiveLines);
  }
  void start_showing() {
    start({{"workspace", {{"textDocumentContent", Json::object()}}},
           {"window", {{"showDocument", {{"support", true}}}}}});
  }

  Json content(const std::string& uri) {
    return session.request("workspace/textDocumentContent", {{"uri", uri}})["text"];
  }
  Json refusal(const std::string& uri) {
    return session.respond("workspace/textDocumentContent", {{"uri", uri}})["error"]["message"];
  }
  Json run_command(const Json& argument) {
    return session.request("workspace/executeCommand",
                           {{"command", "isocnc.showText"}, {"arguments", Json::array({argument})}});
  }
  bool has_refresh() {
    return session.has([](const Json& message) {
      return message.contains("method") && message["method"] == "workspace/textDocumentContent/refresh";
    });
  }

  Session session;
};

TEST_F(TextContent, IsAnnounced) {
  const Json capabilities = session.start()["capabilities"];
  EXPECT_EQ(capabilities["workspace"]["textDocumentContent"]["schemes"], Json::array({"isocnc"}));
  EXPECT_THAT(capabilities["executeCommandProvider"]["commands"].get<std::vector<std::string>>(),
              testing::Contains("isocnc.showText"));
}

TEST_F(TextContent, OfTheStateIsATableInWhichChangesAreMarked) {
  start(Json::object());
  EXPECT_EQ(content(kStateOfMove),
            "part.iso:4  G01 X30 B5 F1000\n"
            "\n"
            "                           before          after\n"
            "* position                 X0 Y2 Z1 B0 C0  X30 Y2 Z1 B5 C0\n"
            "* machine position         X100 Y2 Z1      X130 Y2 Z1\n"
            "  workpiece zero           X100 Y0 Z0      X100 Y0 Z0\n"
            "  tool                     T101001         T101001\n"
            "  spindle                  ?               ?\n"
            "* feed                     -               F1000\n"
            "* motion                   G00             G01\n"
            "  arc plane                G17             G17\n"
            "  face frame               G27             G27\n"
            "  profile reduction        G38             G38\n"
            "  cutter compensation      G40             G40\n"
            "  interpolation            G48             G48\n"
            "  units                    G71             G71\n"
            "  absolute or incremental  G90             G90\n"
            "  workpiece frame          G92             G92\n"
            "  feed mode                G94             G94\n");
}

TEST_F(TextContent, SpeaksTheReadersLanguage) {
  start(Json::object(), "it");
  const std::string text = content(kStateOfMove);
  EXPECT_THAT(text, HasSubstr("part.iso:4  G01 X30 B5 F1000\n"));
  EXPECT_THAT(text, HasSubstr("prima"));
  EXPECT_THAT(text, HasSubstr("\n  unità di misura                     G71"));
}

TEST_F(TextContent, SaysWhereNothingIsKnown) {
  start(Json::object());
  EXPECT_EQ(content("isocnc://state/?line=70&program=file%3A///nowhere/part.iso"),
            "part.iso:71\n\nThere is no such line.\n");
  session.edit(kUri, 2, {change(2, 0, 2, 12, "G00 X1 X2 Y2 Z1")});
  EXPECT_THAT(content(kStateOfMove).get<std::string>(), HasSubstr("position                 X? Y2 Z1 B0 C0"));
}

TEST_F(TextContent, OfTheSyntaxIsOfALineOrOfAll) {
  start(Json::object());
  EXPECT_THAT(content(kSyntaxOfMove).get<std::string>(), testing::StartsWith("Line 4\n  G\n    Word 0-3 G01\n"));
  const std::string all = content(kSyntax);
  EXPECT_THAT(all, testing::StartsWith("Line 1\n"));
  EXPECT_THAT(all, HasSubstr("\nLine 5\n"));
}

TEST_F(TextContent, IsFoundByUrisAsEditorsEscapeThem) {
  start(Json::object());
  const Json text = content(kSyntaxOfMove);
  EXPECT_EQ(content("isocnc://syntax/?line%3D3%26program%3Dfile%3A///nowhere/part.iso"), text);
  EXPECT_EQ(content("isocnc://syntax/any%20title?line=3&program=file:///nowhere/part.iso"), text);
  // A program whose URI has escapes itself: these are escaped once more.
  session.open("file:///nowhere/p%26q%201.iso", "M02\n");
  EXPECT_EQ(content("isocnc://syntax/?program=file%3A///nowhere/p%2526q%25201.iso"),
            "Line 1\n  Function\n    Word 0-3 M02\nLine 2\n");
}

TEST_F(TextContent, IsRefusedWithAReason) {
  start(Json::object());
  EXPECT_EQ(refusal("isocnc://weather/?line=3&program=file%3A///nowhere/part.iso"), "there is no text weather");
  EXPECT_EQ(refusal("isocnc://state/?line=3&program=file%3A///nowhere/other.iso"), "this document is not open");
  for (const char* const uri : {"file:///nowhere/part.iso", "isocnc://state/", "isocnc://state/?line=3",
                                "isocnc://state/?line=x&program=file%3A///nowhere/part.iso",
                                "isocnc://state/?line=99999999999&program=file%3A///nowhere/part.iso"})
    EXPECT_EQ(refusal(uri), "the URI names no text about a program");
  EXPECT_EQ(refusal("isocnc://state/?program=file%3A///nowhere/part.iso"),
            "a state is that at a line, which is missing");
}

TEST_F(TextContent, IsRefreshedOnceAfterEachChange) {
  start_showing();
  content(kStateOfMove);
  content(kStateOfMove);
  session.edit(kUri, 2, {change(3, 4, 3, 7, "X40")});
  EXPECT_EQ(session.wait_for("workspace/textDocumentContent/refresh")["params"]["uri"], kStateOfMove);
  session.edit(kUri, 3, {change(3, 4, 3, 7, "X50")});
  session.request("textDocument/hover",
                  {{"textDocument", {{"uri", kUri}}}, {"position", {{"line", 0}, {"character", 0}}}});
  EXPECT_FALSE(has_refresh()) << "the client has not asked for the text again";
  EXPECT_THAT(content(kStateOfMove).get<std::string>(), HasSubstr("X50 Y2 Z1 B5 C0"));
  session.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", {{"language", "it"}}}}}});
  session.wait_for("workspace/textDocumentContent/refresh");
  EXPECT_THAT(content(kStateOfMove).get<std::string>(), HasSubstr("posizione macchina"));
}

TEST_F(TextContent, IsRefreshedWhenItsProgramIsOpenedAgain) {
  start_showing();
  content(kStateOfMove);
  session.close(kUri);
  session.open(kUri, "M02\n");
  EXPECT_EQ(session.wait_for("workspace/textDocumentContent/refresh")["params"]["uri"], kStateOfMove);
}

/// Values on which all paths agree, as in a hover.
TEST_F(TextContent, OfAStateHasWhatIsTheSameOnAllPaths) {
  session.start(Json::object(), {{"locale", "en"}});
  session.open(kUri, "M06 T101001\nG00 X1\nIF VGPL = 1 GOTO N10\nS1000\nM03\nM06 T101002\nN10 X2\nM02\nX3\n");
  const std::string text = content("isocnc://state/?line=6&program=file%3A///nowhere/part.iso");
  EXPECT_THAT(text, HasSubstr("\n* position                 X1 Y0 Z0 B0 C0  X2 Y0 Z0 B0 C0\n"));
  EXPECT_THAT(text, HasSubstr("\n  tool                     ?               ?\n"));
  EXPECT_THAT(text, HasSubstr("\n  spindle                  ?               ?\n"));
  EXPECT_EQ(content("isocnc://state/?line=8&program=file%3A///nowhere/part.iso"),
            "part.iso:9  X3\n\nNo path leads here.\n");
}

/// A branch of a program, and rows of the table at the label after it.
struct BranchedState {
  std::string branch;
  std::vector<std::string> rows;
};

TEST_F(TextContent, OfAStateDoesNotTakeOnePathForAll) {
  const BranchedState cases[] = {
      {"F2000", {"feed                     ? ", "spindle                  M03 S1000"}},
      {"G01 X1 F2000",
       {"position                 X1 Y0 Z0 B0 C0", "feed                     ? ",
        "spindle                  M03 S1000"}},
      {"G01 X1 F1000", {"feed                     F1000"}},
      {"S2000",
       {"spindle                  M03 S? ", "feed                     F1000", "tool                     T101001"}},
      {"S1000", {"spindle                  M03 S1000"}},
      {"M04", {"spindle                  ? S1000", "feed                     F1000"}},
      {"G00 X5",
       {"position                 X? Y0 Z0 B0 C0", "machine position         X? Y0 Z0",
        "feed                     F1000", "spindle                  M03 S1000", "tool                     T101001"}},
      {"G00 X5 Y1 Z1 B2 C3", {"position                 ? ", "motion                   ? "}},
      {"G91", {"absolute or incremental  ? ", "position                 X1 Y0 Z0 B0 C0"}},
      {"G92 X5", {"workpiece zero           X? Y0 Z0", "machine position         X1 Y0 Z0"}},
      {"M06 T101002\nM03", {"tool                     ? ", "spindle                  M03 S1000"}},
      {"M06 T000000\nM03", {"tool                     ? ", "spindle                  M03 S1000"}},
  };
  session.start(Json::object(), {{"locale", "en"}});
  session.open(kUri, "M02\n");
  for (const BranchedState& each : cases) {
    session.close(kUri);
    session.open(kUri,
                 "M06 T101001\nS1000 M03\nG01 X1 F1000\nIF VGPL = 1 GOTO N10\n" + each.branch + "\nN10 M100\nM02\n");
    const std::size_t label = 5 + static_cast<std::size_t>(std::count(each.branch.begin(), each.branch.end(), '\n'));
    const std::string text = content(fmt::format("isocnc://state/?line={}&program=file%3A///nowhere/part.iso", label));
    for (const std::string& row : each.rows) EXPECT_THAT(text, HasSubstr("\n  " + row)) << each.branch;
  }
}

TEST_F(TextContent, ThatCannotBeWrittenIsNotShown) {
  start_showing();
  const Json good = {{"uri", kUri}, {"line", 3}, {"text", "state"}};
  for (const Json& wrong : {Json{{"text", "weather"}}, Json{{"uri", "file:///nowhere/other.iso"}}, Json{{"line", -1}},
                            Json{{"line", nullptr}}}) {
    Json argument = good;
    argument.update(wrong);
    EXPECT_TRUE(session
                    .respond("workspace/executeCommand",
                             {{"command", "isocnc.showText"}, {"arguments", Json::array({argument})}})
                    .contains("error"))
        << wrong;
  }
  run_command(good);
  session.wait_for("window/showDocument");
  EXPECT_FALSE(session.has([](const Json& message) { return message.value("method", "") == "window/showDocument"; }));
}

TEST_F(TextContent, IsShownByACommand) {
  start_showing();
  EXPECT_EQ(run_command({{"uri", kUri}, {"line", 3}, {"text", "state"}}), nullptr);
  const Json shown = session.wait_for("window/showDocument")["params"];
  EXPECT_EQ(shown["uri"], kStateOfMove);
  EXPECT_THAT(content(shown["uri"]).get<std::string>(), HasSubstr("part.iso:4"));
  run_command({{"uri", kUri}, {"text", "syntax"}});
  EXPECT_EQ(session.wait_for("window/showDocument")["params"]["uri"], kSyntax);
}

TEST_F(TextContent, IsTheCommandsResultWhereTheEditorCannotShowIt) {
  start(Json::object());
  EXPECT_EQ(run_command({{"uri", kUri}, {"line", 3}, {"text", "syntax"}})["text"], content(kSyntaxOfMove));
}

}  // namespace
}  // namespace isocnc::lsp
