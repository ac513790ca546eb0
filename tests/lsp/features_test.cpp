#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// Answers of features about one document.
namespace isocnc::lsp {
namespace {

using testing::HasSubstr;

constexpr const char* kUntitled = "untitled:part";

Json at(int line, int column) {
  return {{"textDocument", {{"uri", kUntitled}}}, {"position", {{"line", line}, {"character", column}}}};
}

/// The text of a hover in English; empty if there is none.
std::string hover(const std::string& text, int line, int column) {
  Session session;
  session.start(Json::object(), {{"locale", "en"}});
  session.open(kUntitled, text);
  const Json result = session.request("textDocument/hover", at(line, column));
  return result.is_null() ? "" : result["contents"]["value"].get<std::string>();
}

constexpr const char* kProgram =
    "M06 T101001\n"
    "G92 X100\n"
    "G70 G00 X1 Y2 Z1\n"
    "G71 G01 X30 F1000\n"
    "G02 X50 Y50.8 I40 J50.8\n"
    "N5 V1=3\n"
    "IF V1=3 GOTO N9\n"
    "N9 M05 Z5\n"
    "G01 G40 X7\n"
    "M02\n";

TEST(Hover, ExplainsEachWordWhereItStands) {
  EXPECT_THAT(hover(kProgram, 0, 0), HasSubstr("tool change"));
  EXPECT_THAT(hover(kProgram, 0, 5), HasSubstr("head 1, holder 1, tool 1"));
  EXPECT_THAT(hover(kProgram, 1, 1), HasSubstr("I.3.2"));
  EXPECT_THAT(hover(kProgram, 2, 8), HasSubstr("workpiece frame (inches): X1 Y2 Z1 B0 C0"));
  EXPECT_THAT(hover(kProgram, 2, 8), HasSubstr("machine frame (inches): X4.937 Y2 Z1 B0 C0"));
  EXPECT_THAT(hover(kProgram, 3, 9), HasSubstr("length 4.6 mm"));
  EXPECT_THAT(hover(kProgram, 4, 1), HasSubstr("center X40 Y50.8 Z25.4, radius 10 mm, sweep -180°, length 31.4159 mm"));
  EXPECT_THAT(hover(kProgram, 5, 3), HasSubstr("compared: line 7"));
  EXPECT_THAT(hover(kProgram, 3, 9), HasSubstr("at the programmed feed 0.28 s"));
  EXPECT_THAT(hover(kProgram, 6, 4), HasSubstr("here it may be 3 (line 6)"));
  EXPECT_THAT(hover(kProgram, 6, 14), HasSubstr("jump to it: line 7"));
  EXPECT_THAT(hover(kProgram, 7, 0), HasSubstr("jump to it: line 7"));
  EXPECT_THAT(hover(kProgram, 8, 5), HasSubstr("ISO035"));
  EXPECT_EQ(hover(kProgram, 2, 3), "");   // No hover on a blank.
  EXPECT_EQ(hover(kProgram, 99, 3), "");  // No hover after the end.
}

/// The program has more findings than the whole report is made for.
TEST(Hover, ShowsTheFindingsOfALineAmongThousands) {
  std::string text = "M06 T101001\nG00 X1\n";
  for (int i = 0; i < 6'000; ++i) text += "X1 X2\n";
  EXPECT_THAT(hover(text, 4'000, 4), HasSubstr("ISO016"));
  EXPECT_THAT(hover(text, 1, 5), testing::Not(HasSubstr("ISO016")));
}

TEST(Hover, ExplainsJumpsAndWhatTheyCompare) {
  const char* const kJumps = "IF VGPL >= 2 GOTO N9\nIF V3 <> -1 GOTO N9\nV3=2.5\nN9 M02\n";
  EXPECT_THAT(hover(kJumps, 0, 0), HasSubstr("**IF** jumps down"));
  EXPECT_THAT(hover(kJumps, 0, 4), HasSubstr("**VGPL** variable that the machine's own program sets"));
  EXPECT_THAT(hover(kJumps, 0, 8), HasSubstr("**>=** is at least"));
  EXPECT_THAT(hover(kJumps, 0, 11), HasSubstr("**2** what it is compared with"));
  EXPECT_THAT(hover(kJumps, 0, 14), HasSubstr("**GOTO** jumps down"));
  EXPECT_THAT(hover(kJumps, 1, 6), HasSubstr("**\\<>** is not equal to"));
  EXPECT_THAT(hover(kJumps, 2, 3), HasSubstr("**=2.5** what it is set to"));
  EXPECT_THAT(hover(kJumps, 0, 19), HasSubstr("jumps to it: lines 1, 2"));
}

TEST(Hover, ShowsHowLongALineTakes) {
  const char* const kTimed = "M06 T101001\nM03 S1000\nG00 X3000 Y10\nG04 P1.5\nG93 G01 X0 F30\nG94 G01 F0 X5\nM02\n";
  EXPECT_THAT(hover(kTimed, 0, 0), HasSubstr("takes 8 s"));
  EXPECT_THAT(hover(kTimed, 1, 0), HasSubstr("takes 2 s where it changes"));
  EXPECT_THAT(hover(kTimed, 2, 4), HasSubstr("at full rapid speed 3 s"));  // The rapid speed is 60 m/min.
  EXPECT_THAT(hover(kTimed, 3, 0), HasSubstr("waits 1.5 s"));
  EXPECT_THAT(hover(kTimed, 4, 8), HasSubstr("at the programmed feed 2 s"));
}

/// The pivot of the default machine's head is 180 mm: B90 swings the tip through most of a quarter turn.
TEST(Hover, ShowsTheLengthThatTheTipIsSwung) {
  const char* const kSwings = "M06 T101001\nG00 X10 B90\nB0\nM02\n";
  EXPECT_THAT(hover(kSwings, 2, 0), testing::Not(HasSubstr("length 0 mm")));
  EXPECT_THAT(hover("M06 T101001\nG00 X10 B90\nX30\nM02\n", 2, 0), HasSubstr("length 20 mm"));
}

TEST(Hover, ShowsWhatAllPathsToALineAgreeOn) {
  const std::string program =
      "M06 T101001\nG00 X10 Y5 Z50\nIF VGPL = 1 GOTO N5\nX20\nN5 G00 Y8\nG00 X0 Z40\nG91 G00 X1\nM02\n";
  EXPECT_THAT(hover(program, 1, 5), testing::Not(HasSubstr("?")));
  EXPECT_THAT(hover(program, 4, 7), testing::AllOf(HasSubstr("workpiece frame: X? Y8 Z50 B0 C0"),
                                                   HasSubstr("length 3 mm"), HasSubstr("depends on the jumps")));
  EXPECT_THAT(hover(program, 5, 4), testing::AllOf(HasSubstr("workpiece frame: X0 Y8 Z40 B0 C0"),
                                                   HasSubstr("length ? mm"), HasSubstr("depends on the jumps")));
  EXPECT_THAT(hover(program, 6, 9), testing::AllOf(HasSubstr("X1 Y8 Z40"), testing::Not(HasSubstr("?"))));
}

TEST(Hover, IsPlainForEditorsThatShowPlainTextAlone) {
  const auto contents = [](const Json& formats) {
    Session session;
    session.start({{"textDocument", {{"hover", {{"contentFormat", formats}}}}}}, {{"locale", "en"}});
    session.open(kUntitled, "IF VGPL = 1 GOTO N5\nN5 M02\n");
    return session.request("textDocument/hover", at(0, 17))["contents"];
  };
  const std::string ending = " target of a jump\n\njump to it: line 1";
  EXPECT_EQ(contents({"plaintext"}), Json({{"kind", "plaintext"}, {"value", "N5" + ending}}));
  EXPECT_EQ(contents({"plaintext", "markdown"}), Json({{"kind", "markdown"}, {"value", "**N5**" + ending}}));
}

/// Unescaped, such text would make an editor fetch the images that it names.
TEST(Hover, ShowsTheWordsOfOthersAsTheyStand) {
  const support::TemporaryFolder folder;
  folder.write("isocnc.json", R"json({"machine": {
    "tools": [{"head": 1, "holder": 1, "tool": 1, "name": "![t](http://a.b/t.png)"}],
    "functions": {"M100": {"name": "<img src='http://a.b/f.png'> \\ *x*"}}}})json");
  const std::string uri = protocol::uri_of(std::filesystem::path(folder.path()) / "part.iso");
  const auto contents = [&](const char* format, int line, int column) {
    Session session;
    session.start({{"textDocument", {{"hover", {{"contentFormat", {format}}}}}}}, {{"locale", "en"}});
    session.open(uri, "G0(![x](http://a.b/c.png)0 X1\nM100\nM06 T101001\n");
    const Json params = {{"textDocument", {{"uri", uri}}}, {"position", {{"line", line}, {"character", column}}}};
    return session.request("textDocument/hover", params)["contents"]["value"].get<std::string>();
  };
  EXPECT_THAT(contents("markdown", 0, 0), HasSubstr("**G0(!\\[x\\](http://a.b/c.png)0** rapid"));
  EXPECT_THAT(contents("markdown", 1, 0), HasSubstr("\\<img src='http://a.b/f.png'> \\\\ \\*x\\*"));
  EXPECT_THAT(contents("markdown", 2, 5), HasSubstr("!\\[t\\](http://a.b/t.png)"));
  EXPECT_THAT(contents("plaintext", 0, 0), HasSubstr("G0(![x](http://a.b/c.png)0 rapid"));
  EXPECT_THAT(contents("plaintext", 1, 0), HasSubstr("<img src='http://a.b/f.png'> \\ *x*"));
}

TEST(Hover, SpeaksTheLanguageOfTheSettings) {
  Session session;
  session.start(Json::object(), {{"locale", "it-IT"}});
  session.open(kUntitled, kProgram);
  EXPECT_THAT(session.request("textDocument/hover", at(0, 0))["contents"]["value"].get<std::string>(),
              HasSubstr("cambio utensile"));
  session.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", {{"language", "en"}}}}}});
  EXPECT_THAT(session.request("textDocument/hover", at(0, 0))["contents"]["value"].get<std::string>(),
              HasSubstr("tool change"));
}

TEST(State, IsThatBeforeAndAfterALine) {
  Session session;
  session.start();
  session.open(kUntitled, kProgram);
  const Json result = session.request("isocnc/state", {{"textDocument", {{"uri", kUntitled}}}, {"line", 3}});
  EXPECT_EQ(result["before"]["inForce"]["units"], 70);
  EXPECT_EQ(result["before"]["feed"], nullptr);
  EXPECT_EQ(result["after"]["inForce"]["motion"], 1);
  EXPECT_EQ(result["after"]["position"]["x"], 30);
  EXPECT_EQ(result["after"]["machinePosition"]["x"], 130);
  EXPECT_EQ(result["after"]["feed"], 1000);
  EXPECT_EQ(result["after"]["tool"], "101001");
  const Json after_end = session.request("isocnc/state", {{"textDocument", {{"uri", kUntitled}}}, {"line", 99}});
  EXPECT_EQ(after_end["before"], nullptr);
}

TEST(State, OnTheMachineIsNotKnownInAFrameInError) {
  Session session;
  session.start();
  session.open(kUntitled, "M06 T101001\nG29 X5 C180\nG00 X1 Y2 Z3\nG27\nG29 X5 C181\nG00 X1 Y2 Z3\nG27\nM02\n");
  const auto after = [&](int line) {
    return session.request("isocnc/state", {{"textDocument", {{"uri", kUntitled}}}, {"line", line}})["after"];
  };
  EXPECT_EQ(after(2)["machinePosition"]["x"], 4);
  EXPECT_EQ(after(5)["position"]["x"], 1) << "in the frame";
  EXPECT_EQ(after(5)["machinePosition"], nullptr);
  EXPECT_EQ(after(6)["position"]["x"], nullptr);
}

TEST(State, AtALabelIsThatOfAllThatJumpsThere) {
  const auto x_at_label = [](const std::string& above) {
    Session session;
    session.start();
    session.open(kUntitled, "M06 T101001\nG00 X10\nIF VGPL = 1 GOTO N5\n" + above + "\nN5 G00 Y1\nM02\n");
    const Json before =
        session.request("isocnc/state", {{"textDocument", {{"uri", kUntitled}}}, {"line", 4}})["before"];
    return before.is_null() ? before : before["position"]["x"];
  };
  EXPECT_EQ(x_at_label("X20"), nullptr);
  EXPECT_EQ(x_at_label("G00 X10 F100"), 10);  // Both paths lead to the same position.
  EXPECT_EQ(x_at_label("M02"), 10);           // Only the jump leads to the label.
}

/// As in the text of the state: null, and named, where paths differ.
TEST(State, HasWhatAllPathsAgreeOn) {
  Session session;
  session.start();
  const auto after_branch = [&](const std::string& branch) {
    session.open(kUntitled,
                 "M06 T101001\nS1000 M03\nG01 X10 F1000\nIF VGPL = 1 GOTO N5\n" + branch + "\nN5 M100\nM02\n");
    Json state = session.request("isocnc/state", {{"textDocument", {{"uri", kUntitled}}}, {"line", 5}})["before"];
    session.close(kUntitled);
    return state;
  };
  const Json same = after_branch("S1000");
  EXPECT_EQ(same["unknown"], Json::array());
  EXPECT_EQ(same["spindle"], (Json{{"function", 3}, {"speed", 1000}}));
  EXPECT_EQ(same["feed"], 1000);
  const Json slower = after_branch("S500");
  EXPECT_EQ(slower["unknown"], Json::array({"spindle.speed"}));
  EXPECT_EQ(slower["spindle"], (Json{{"function", 3}, {"speed", nullptr}}));
  const Json fed = after_branch("G01 X10 F500");
  EXPECT_EQ(fed["unknown"], Json::array({"feed"}));
  EXPECT_EQ(fed["feed"], nullptr);
  const Json elsewhere = after_branch("G01 X20");
  EXPECT_EQ(elsewhere["unknown"], Json::array({"position.x", "machinePosition.x"}));
  EXPECT_EQ(elsewhere["machinePosition"], (Json{{"x", nullptr}, {"y", 0}, {"z", 0}}));
  EXPECT_EQ(elsewhere["feed"], 1000);
  const Json other_tool = after_branch("M06 T101002 M03");
  EXPECT_EQ(other_tool["unknown"], Json::array({"tool"}));
  EXPECT_EQ(other_tool["tool"], nullptr);
}

TEST(Hover, DoesNotTakeTheFeedOfOnePathForThatOfAll) {
  const auto time_of_move = [](const std::string& feed, const std::string& in_move) {
    Session session;
    session.start(Json::object(), {{"locale", "en"}});
    session.open(kUntitled, "M06 T101001\nG01 X10 F1000\nIF VGPL = 1 GOTO N5\nG01 X10 F" + feed + "\nN5 G01 X110" +
                                in_move + "\nM02\n");
    return session
        .request("textDocument/hover", {{"textDocument", {{"uri", kUntitled}}},
                                        {"position", {{"line", 4}, {"character", 4}}}})["contents"]["value"]
        .get<std::string>();
  };
  EXPECT_THAT(time_of_move("1000", ""), HasSubstr("at the programmed feed 6 s"));
  EXPECT_THAT(time_of_move("500", ""), HasSubstr("at the programmed feed ? s"));
  EXPECT_THAT(time_of_move("500", ""), HasSubstr("depends on the jumps before"));
  EXPECT_THAT(time_of_move("500", " F600"), HasSubstr("at the programmed feed 10 s"));
}

TEST(SyntaxTree, ShowsHowLinesAreRead) {
  Session session;
  session.start();
  session.open(kUntitled, "G01 X10 F5 (note)\nX1.2.3\n");
  const std::string tree = session.request("isocnc/syntaxTree", {{"textDocument", {{"uri", kUntitled}}}});
  EXPECT_THAT(tree,
              HasSubstr("Line 1\n  G\n    Word 0-3 G01\n    Word 4-7 X10\n  Word 8-10 F5\n  Comment 11-17 (note)\n"));
  EXPECT_THAT(tree, HasSubstr("Finding ISO006 "));
}

TEST(SyntaxTree, NamesEachKindOfInstruction) {
  Session session;
  session.start();
  session.open(kUntitled, "M06 T101001\nG00 X1\nX2\nM100 P1=2\nT101001\nV1=2\nIF V1=2 GOTO N9\nN9 M02\n");
  const auto line = [&](int number) {
    const Json range = {{"start", {{"line", number}, {"character", 0}}}, {"end", {{"line", number}, {"character", 1}}}};
    return session.request("isocnc/syntaxTree", {{"textDocument", {{"uri", kUntitled}}}, {"range", range}})
        .get<std::string>();
  };
  const char* const kKinds[] = {"ToolChange", "G", "Continuation", "Function", "StrayTool", "Assignment", "Jump"};
  for (int i = 0; i < 7; ++i) EXPECT_THAT(line(i), HasSubstr(std::string("\n  ") + kKinds[i] + "\n")) << i;
}

TEST(InlineValues, AreRegistersAndVgplUpToWhereTheProgramStands) {
  Session session;
  session.start();
  session.open(kUntitled,
               "V1=2\nM06 T101001\n(V9) IF V1 = 2 GOTO N9\nIF VGPL > 3 GOTO N9\nV2=1 V2=2 V3=4\nV4=1\nN9 M02\n");
  const auto range = [](int first, int last) {
    return Json{{"start", {{"line", first}, {"character", 0}}}, {"end", {{"line", last}, {"character", 0}}}};
  };
  const Json context = {{"frameId", 1}, {"stoppedLocation", range(4, 4)}};
  const Json values =
      session.request("textDocument/inlineValue",
                      {{"textDocument", {{"uri", kUntitled}}}, {"range", range(1, 6)}, {"context", context}});
  std::string shown;
  for (const Json& each : values)
    shown += fmt::format("{}:{}-{} {}\n", each["range"]["start"]["line"].get<int>(),
                         each["range"]["start"]["character"].get<int>(), each["range"]["end"]["character"].get<int>(),
                         each["variableName"].get<std::string>());
  EXPECT_EQ(shown, "2:8-10 V1\n3:3-7 VGPL\n4:0-2 V2\n4:10-12 V3\n");
}

/// A finding lists the jumps that lead to it.
TEST(Diagnostics, ReportThePathToWhatIsWrong) {
  Session session;
  session.start({{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}}, {{"locale", "en"}});
  session.open(kUntitled, "M06 T101001\nG00 X0\nIF VGPL > 1 GOTO N5\nG01 X2 F500\nN5 G01 X1\nM02\n");
  const Json found = session.diagnostics(kUntitled, 1);
  ASSERT_EQ(found.size(), 1u) << found;
  EXPECT_EQ(found[0]["code"], "ISO066");
  const Json& steps = found[0]["relatedInformation"];
  ASSERT_EQ(steps.size(), 1u) << found;
  EXPECT_EQ(steps[0]["location"]["uri"], kUntitled);
  EXPECT_EQ(steps[0]["location"]["range"], Json::parse(R"({"start": {"line": 2, "character": 0},
                                                           "end": {"line": 2, "character": 19}})"));
}

/// A repeated mistake is one finding with the lines that repeat it; these are hints that name it.
TEST(Diagnostics, FadeTheLinesThatRepeatAMistake) {
  Session session;
  session.start({{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}}, {{"locale", "en"}});
  session.open(kUntitled, "M06 T101001\nG01 X0 B5 F500\nX1\nX2 B6\nC90\nM02\n");
  const Json found = session.diagnostics(kUntitled, 1);
  ASSERT_EQ(found.size(), 3u) << found;
  EXPECT_EQ(found[0]["code"], "ISO032");
  EXPECT_EQ(found[0]["severity"], 1);
  const std::string message = found[0]["message"];
  EXPECT_THAT(message, testing::EndsWith(" (and 2 more lines, to line 5)"));
  ASSERT_EQ(found[0]["relatedInformation"].size(), 2u);
  EXPECT_EQ(found[0]["relatedInformation"][1]["location"]["range"],
            Json::parse(R"({"start": {"line": 4, "character": 0}, "end": {"line": 4, "character": 3}})"));
  EXPECT_EQ(found[1]["range"],
            Json::parse(R"({"start": {"line": 3, "character": 3}, "end": {"line": 3, "character": 5}})"));
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(found[i]["severity"], 4);
    EXPECT_EQ(found[i]["tags"], Json::array({1}));
    EXPECT_EQ(found[i]["message"], "as on line 2: " + message);
    EXPECT_EQ(found[i]["relatedInformation"][0]["location"]["range"]["start"]["line"], 1);
  }
  EXPECT_EQ(found[2]["code"], "ISO047");
  EXPECT_THAT(session.request("textDocument/hover", at(4, 1))["contents"]["value"].get<std::string>(),
              testing::HasSubstr("**ISO047**"));
}

/// However many lines repeat a mistake, it is one finding, and the others are reported.
TEST(Diagnostics, FoldThousandsOfLines) {
  Session session;
  session.start(Json::object(), {{"locale", "it"}});
  std::string text = "M06 T101001\nG01 X0 F500\n";
  for (int i = 1; i <= 6'000; ++i) text += fmt::format("X{} B{}\n", i, i);
  session.open(kUntitled, text + "G01 X1 X2\nM02\n");
  const Json found = session.diagnostics(kUntitled, 1);
  ASSERT_EQ(found.size(), 1'002u);
  EXPECT_THAT(found[0]["message"].get<std::string>(), testing::EndsWith(" (e altre 5999 linee, fino alla 6002)"));
  EXPECT_EQ(found[1]["code"], "ISO016");
  EXPECT_EQ(found[2]["severity"], 4);
}

/// An editor may send the mark as part of the text.
TEST(ByteOrderMark, CountsAsACharacterOfTheFirstLine) {
  Session session;
  session.start(Json::object(), {{"locale", "en"}});
  session.open(kUntitled,
               "\xEF\xBB\xBF"
               "G80 X1\nM02\n");
  const Json found = session.diagnostics(kUntitled, 1);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0]["range"]["start"]["character"], 1);
  EXPECT_THAT(session.request("textDocument/hover", at(0, 1))["contents"]["value"].get<std::string>(),
              HasSubstr("E001"));
  EXPECT_EQ(session.request("textDocument/hover", at(0, 1))["range"]["start"]["character"], 1);
}

TEST(Diagnostics, AHundredThousandFindingsAreCutShortAndCounted) {
  Session session;
  session.start(Json::object(), {{"locale", "en"}});
  std::string text = "M06 T101001\n";
  for (int i = 0; i < 20'000; ++i) text += "X1 X2\n";
  session.open(kUntitled, text);
  const Json found = session.diagnostics(kUntitled, 1);
  ASSERT_EQ(found.size(), 1'001u);
  EXPECT_THAT(found.back()["message"].get<std::string>(), HasSubstr("findings that are not shown: "));
  session.edit(kUntitled, 2, {change(1, 0, 20'001, 0, "")});
  EXPECT_LE(session.diagnostics(kUntitled, 2).size(), 2u);
}

TEST(Diagnostics, FollowCommentsThatSilenceThem) {
  Session session;
  session.start();
  session.open(kUntitled, "M06 T101001\nG01 X10\nM02\n");
  EXPECT_EQ(session.diagnostics(kUntitled, 1).size(), 1u);
  session.edit(kUntitled, 2, {change(1, 7, 1, 7, " (isolint: ignore ISO066)")});
  EXPECT_EQ(session.diagnostics(kUntitled, 2), Json::array());
}

/// A position after the last line becomes its end, which may be in the first line.
TEST(Diagnostics, AcceptAByteOrderMarkAfterTheLastLine) {
  Session session;
  session.start();
  session.open(kUntitled, "");
  session.diagnostics(kUntitled, 1);
  session.edit(kUntitled, 2, {change(29, 5, 31, 0, "\xEF\xBB\xBFM06 T101001\nM02\n")});
  EXPECT_EQ(session.diagnostics(kUntitled, 2), Json::array());
}

}  // namespace
}  // namespace isocnc::lsp
