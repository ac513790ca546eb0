#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "client_text.h"
#include "interpreter/restart/restart.h"
#include "session.h"

/// Code actions for a line or a selection, and the program after them.
namespace isocnc::lsp {
namespace {

const Json kResolves = {
    {"textDocument", {{"codeAction", {{"resolveSupport", {{"properties", Json::array({"edit"})}}}}}}},
    {"workspace", {{"workspaceEdit", {{"documentChanges", true}, {"resourceOperations", Json::array({"create"})}}}}}};

Json params_of(const SelectedProgram& program, const Json& only = nullptr, const Json& diagnostics = Json::array()) {
  Json context = {{"diagnostics", diagnostics}};
  if (!only.is_null()) context["only"] = only;
  return {{"textDocument", {{"uri", kUri}}},
          {"range", ClientText(program.text).range(program.begin, program.end)},
          {"context", context}};
}

class CodeActions : public testing::Test {
 protected:
  CodeActions() { session_.start(); }

  /// The program after the action whose title starts with `title`; nothing if no such action is offered.
  std::optional<std::string> after(const char* marked, const std::string& title, const char* only) {
    const SelectedProgram program(marked);
    session_.open(kUri, program.text);
    for (const Json& action : session_.request("textDocument/codeAction", params_of(program, Json::array({only}))))
      if (action["title"].get<std::string>().starts_with(title))
        return ClientText(program.text).with(action["edit"]["changes"][kUri]);
    return std::nullopt;
  }

  Session session_;
};

struct OfferedFixes {
  const char* title;
  const char* before;
  const char* after;  // The program after the action; null if it is not offered.
};

constexpr OfferedFixes kFixes[] = {
    {"remove G71", "M06 T101001\nG71\n[!!]G71 G00 X1\nM02\n", "M06 T101001\nG71\nG00 X1\nM02\n"},
    {"silence ISO066 on this line", "M06 T101001\nG01[!!] X10\nM02\n",
     "M06 T101001\nG01 X10 ;isolint: ignore ISO066\nM02\n"},
    {"silence ISO066 on this line", "M06 T101001\nG01[!!] X10 ; più\nM02\n",
     "M06 T101001\nG01 X10 ; più isolint: ignore ISO066\nM02\n"},
    {"silence ISO066 in the whole program", "M06 T101001\r\nG01[!!] X10\r\nM02\r\n",
     ";isolint: ignore-file ISO066\r\nM06 T101001\r\nG01 X10\r\nM02\r\n"},
    // A fix from one finding changes all centers of the program; the next case, the inches of other controls.
    {"write I105 J110", "M06 T101001\nG00 X110 Y110\n[!!]G02 X110 Y110 I-5 J0 F1000\nG02 X120 Y120 I10 J0\nM02\n",
     "M06 T101001\nG00 X110 Y110\nG02 X110 Y110 I105 J110 F1000\nG02 X120 Y120 I120 J110\nM02\n"},
    {"write I120 J110", "M06 T101001\nG00 X110 Y110\nG02 X110 Y110 I-5 J0 F1000\n[!!]G02 X120 Y120 I10 J0\nM02\n",
     "M06 T101001\nG00 X110 Y110\nG02 X110 Y110 I105 J110 F1000\nG02 X120 Y120 I120 J110\nM02\n"},
    {"write I",
     "M06 T101001\nG00 X110 Y110\nG02 X110 Y110 I-5 J0 F1000\n[!!]G02 X120 Y120 I10 J0\nG02 X126 Y118 I120 J110\nM02\n",
     nullptr},
    {"write G70", "M06 T101001\n[!!]G20\nG00 X1\nG21\nM02\n", "M06 T101001\nG70\nG00 X1\nG71\nM02\n"},
    // The new number is unused in the whole program.
    {"number the line N80", "M06 T101001\nIF VGPL = 1 GOTO N5\nN5 G00 X1\n[!!]N5 G00 X2\nN73 X4\nM02\n",
     "M06 T101001\nIF VGPL = 1 GOTO N5\nN5 G00 X1\nN80 G00 X2\nN73 X4\nM02\n"},
    {"silence", "M06 T101001\n[!!]G00 X10\nM02\n", nullptr},
    // One G49 mends all lines that lack it, and is offered on each; what is ignored on each line is removed there.
    {"insert G49 above", "M06 T101001\n[!!]G01 X0 B5 F500\nX2 B6\nM02\n",
     "M06 T101001\nG49\nG01 X0 B5 F500\nX2 B6\nM02\n"},
    {"insert G49 above", "M06 T101001\nG01 X0 B5 F500\n[!!]X2 B6\nM02\n",
     "M06 T101001\nG49\nG01 X0 B5 F500\nX2 B6\nM02\n"},
    {"remove F4, which is ignored, and on 2 more lines", "M06 T101001\nG93\n[!!]F4\nG00 X0 F5\nF6\nM02\n",
     "M06 T101001\nG93\nG00 X0\nM02\n"},
};

TEST_F(CodeActions, FindingsAreFixedOrSilenced) {
  for (const OfferedFixes& each : kFixes) {
    const auto fixed = after(each.before, each.title, "quickfix");
    EXPECT_EQ(fixed, each.after ? std::optional<std::string>(each.after) : std::nullopt) << each.before;
    if (!fixed) continue;
    session_.open(kUri, *fixed, 2);
    EXPECT_EQ(session_.diagnostics(kUri, 2), Json::array()) << *fixed;
  }
}

TEST_F(CodeActions, SafeFixesArePreferredAndNameWhatTheyMend) {
  const SelectedProgram program("M06 T101001\nG71\n[!!](è 😀) G71 G00 X1\nM02\n");
  session_.open(kUri, program.text);
  const Json diagnostics = session_.diagnostics(kUri, 1);
  ASSERT_EQ(diagnostics.size(), 1u);
  const Json actions =
      session_.request("textDocument/codeAction", params_of(program, Json::array({"quickfix"}), diagnostics));
  ASSERT_EQ(actions.size(), 3u) << actions;
  EXPECT_EQ(actions[0]["isPreferred"], true);
  EXPECT_EQ(actions[0]["diagnostics"], diagnostics);
  EXPECT_FALSE(actions[1].contains("isPreferred"));
  EXPECT_EQ(ClientText(program.text).with(actions[0]["edit"]["changes"][kUri]),
            "M06 T101001\nG71\n(è 😀) G00 X1\nM02\n");
}

TEST_F(CodeActions, AllThatIsSafeIsFixedAtOnce) {
  const char* const kBefore =
      "[!!]M06 T101001\r\nG71\r\nG71 G00 X1\r\nG01 X5 F100 G40\r\n(è) G71\r\nG00 Z50\r\nM02\r\n";
  const SelectedProgram program(kBefore);
  session_.open(kUri, program.text);
  const Json actions = session_.request("textDocument/codeAction", params_of(program, Json::array({"source.fixAll"})));
  ASSERT_EQ(actions.size(), 1u) << actions;
  EXPECT_EQ(actions[0]["kind"], "source.fixAll.isocnc");
  const Json edits = actions[0]["edit"]["changes"][kUri];
  const std::string fixed = ClientText(program.text).with(edits);
  EXPECT_EQ(fixed, "M06 T101001\r\nG71\r\nG00 X1\r\nG01 X5 F100 G40\r\n(è)\r\nG00 Z50\r\nM02\r\n");
  EXPECT_EQ(edits.size(), 2u) << edits;
  session_.ask("workspace/executeCommand", {{"command", "isocnc.fixAll"}, {"arguments", {{{"uri", kUri}}}}});
  EXPECT_EQ(session_.wait_for("workspace/applyEdit")["params"]["edit"]["changes"][kUri], edits);
}

constexpr OfferedFixes kRewrites[] = {
    {"give the arc's radius", "M06 T101001\nG00 X0 Y0\nG02[!!] X10 Y10 I10 J0 F500\nM02\n",
     "M06 T101001\nG00 X0 Y0\nG02 X10 Y10 R10 F500\nM02\n"},
    {"give the arc's radius", "M06 T101001\nG00 X0 Y0\nG02[!!] X10 Y10 I0 J10 F500\nM02\n",
     nullptr},  // An arc of 270 degrees, which a radius cannot give.
    {"give the arc's center", "M06 T101001\nG00 X0 Y0\n(è 😀) G02[!!] X10 Y10 R10 F500 ; arco\nM02\n",
     "M06 T101001\nG00 X0 Y0\n(è 😀) G02 X10 Y10 I10 J0 F500 ; arco\nM02\n"},
    {"give the arc's center", "M06 T101001\nG91 G70 G18\nG03[!!] X1 Z1 R1 F50\nM02\n",
     "M06 T101001\nG91 G70 G18\nG03 X1 Z1 I1 K0 F50\nM02\n"},
    // A jump leads to the arc from a different position; then from the same position.
    {"give the arc's center", "M06 T101001\nG00 X0 Y0\nIF VGPL = 1 GOTO N5\nX5\nN5 G02[!!] X10 Y10 R10 F500\nM02\n",
     nullptr},
    {"give the arc's center", "M06 T101001\nG00 X0 Y0\nIF VGPL = 1 GOTO N5\nX0\nN5 G02[!!] X10 Y10 R10 F500\nM02\n",
     "M06 T101001\nG00 X0 Y0\nIF VGPL = 1 GOTO N5\nX0\nN5 G02 X10 Y10 I10 J0 F500\nM02\n"},
    {"write the selection in incremental",
     "M06 T101001\nG00 X10 Y20\n[!G01 X15 Y20.5 F500\nG02 X25 Y20.5 I20 J20.5\n!]M02\n",
     "M06 T101001\nG00 X10 Y20\nG91\nG01 X5 Y0.5 F500\nG02 X10 Y0 I5 J0\nG90\nM02\n"},
    // The selection ends a text without a last line end; then a G09 has to follow its motion.
    {"write the selection in incremental", "M06 T101001\nG00 X10\n[!G01 X15 F500\nX20!]",
     "M06 T101001\nG00 X10\nG91\nG01 X5 F500\nX5\nG90"},
    {"write the selection in incremental", "M06 T101001\nG00 X10\n[!G01 X15 F500\nX20\n!]\n(stop)\nG09\nM02\n",
     nullptr},
    {"write the selection in absolute", "M06 T101001\nG91\n[!N10 G00 X10\nN20 X0.1\nN30 X0.2\nM02!]\n",
     "M06 T101001\nG91\nG90\nN10 G00 X10\nN20 X10.1\nN30 X10.3\nM02\n"},
    {"write the selection in absolute", "M06 T101001\n[!G91 G00 X10\nX5\nM02\n!]", "M06 T101001\nG00 X10\nX15\nM02\n"},
    {"write the selection in absolute", "M06 T101001\nG91\n[!G00 X10\nIF VGPL = 1 GOTO N10\nX5\n!]N10 G90\nM02\n",
     nullptr},
    {"write the selection in incremental", "M06 T101001\nG00 X10\nG01[!!] X15 F500\nM02\n", nullptr},
    {"write the selection in millimeters", "M06 T101001\nG70\n[!G00 X1 Y0.5\nG01 X2 F40\nG02 X3 Y0.5 R0.5\nM02\n!]",
     "M06 T101001\nG70\nG71\nG00 X25.4 Y12.7\nG01 X50.8 F1016\nG02 X76.2 Y12.7 R12.7\nM02\n"},
    {"write the selection in millimeters",
     "M06 T101001\n[!G70\nG92 X1 Y0 Z0\nG29 X1 Y0 Z0 B0 C90\nG00 X1\nG27\nM02\n!]",
     "M06 T101001\nG92 X25.4 Y0 Z0\nG29 X25.4 Y0 Z0 B0 C90\nG00 X25.4\nG27\nM02\n"},
    {"write the selection in inches", "M06 T101001\n[!G00 X25.4\nG01 X10 F508\n!]X1\nM02\n",
     "M06 T101001\nG70\nG00 X1\nG01 X0.3937008 F20\nG71\nX1\nM02\n"},
    {"write the motion G on each line", "M06 T101001\ng00 x1\n[!!]x2\nX3\nM02\n",
     "M06 T101001\ng00 x1\nG00 X2\nG00 X3\nM02\n"},
    {"write the motion G only", "M06 T101001\nG00 X1\n[!G00 X2\n!]G00 X3\nM02\n",
     "M06 T101001\nG00 X1\nX2\nG00 X3\nM02\n"},
    {"renumber", "M06 T101001\nIF VGPL = 1 GOTO N7\nN3 G00 X1\nN7[!!] X2\nM02\n",
     "M06 T101001\nIF VGPL = 1 GOTO N20\nN10 G00 X1\nN20 X2\nM02\n"},
    {"renumber", "M06 T101001\nIF VGPL = 1 GOTO N9\nN3 G00 X1\nM02[!!]\n", nullptr},
};

TEST_F(CodeActions, RewritesReadSo) {
  for (const OfferedFixes& each : kRewrites)
    EXPECT_EQ(after(each.before, each.title, "refactor.rewrite"),
              each.after ? std::optional<std::string>(each.after) : std::nullopt)
        << each.title << '\n'
        << each.before;
}

TEST(CodeActionsResolved, AreMadeWhenTheyAreChosen) {
  Session session;
  session.start(kResolves);
  const SelectedProgram program("M06 T101001\nG00 X1\n[!!]G00 X2\nM02\n");
  session.open(kUri, program.text);
  const Json actions =
      session.request("textDocument/codeAction", params_of(program, Json::array({"refactor.rewrite.isocnc.modal"})));
  ASSERT_EQ(actions.size(), 2u) << actions;
  EXPECT_FALSE(actions[1].contains("edit"));
  const Json resolved = session.request("codeAction/resolve", actions[1]);
  const Json change = resolved["edit"]["documentChanges"][0];
  EXPECT_EQ(change["textDocument"], Json({{"uri", kUri}, {"version", 1}}));
  EXPECT_EQ(ClientText(program.text).with(change["edits"]), "M06 T101001\nG00 X1\nX2\nM02\n");
  session.edit(kUri, 2, {lsp::change(0, 0, 0, 0, " ")});
  EXPECT_EQ(session.respond("codeAction/resolve", actions[1])["error"]["code"], -32801);
  Json wrong = actions[1];
  wrong["data"]["version"] = 2;
  wrong["data"]["source"] = 99;
  EXPECT_TRUE(session.respond("codeAction/resolve", wrong).contains("error"));
}

/// The fix of a habit may change much of the program, so its edits are made on request.
TEST(CodeActionsResolved, HabitsAreRewrittenWhenTheyAreChosen) {
  Session session;
  session.start(kResolves, {{"locale", "en"}});
  std::string turns;
  std::string mended;
  for (int i = 0; i < 1'500; ++i) {
    turns += "G02 X110 Y110 I-5 J0 F1000\n";
    mended += "G02 X110 Y110 I105 J110 F1000\n";
  }
  const SelectedProgram program("M06 T101001\nG00 X110 Y110\n" + turns + "[!!]G02 X120 Y120 I10 J0\nM02\n");
  session.open(kUri, program.text);
  const Json actions = session.request("textDocument/codeAction", params_of(program, Json::array({"quickfix"})));
  const auto fix = std::find_if(actions.begin(), actions.end(), [](const Json& action) {
    return action["title"].get<std::string>().starts_with("write I120 J110");
  });
  ASSERT_NE(fix, actions.end()) << actions;
  EXPECT_FALSE(fix->contains("edit"));
  const Json resolved = session.request("codeAction/resolve", *fix);
  EXPECT_EQ(ClientText(program.text).with(resolved["edit"]["documentChanges"][0]["edits"]),
            "M06 T101001\nG00 X110 Y110\n" + mended + "G02 X120 Y120 I120 J110\nM02\n");
  Json wrong = *fix;
  wrong["data"]["action"]["habit"] = 99;
  EXPECT_TRUE(session.respond("codeAction/resolve", wrong).contains("error"));
}

/// A long rewrite is tried only after the user has chosen it, and may then be impossible.
TEST(CodeActionsResolved, OfManyLinesAreTriedWhenTheyAreChosen) {
  Session session;
  session.start(kResolves, {{"locale", "en"}});
  std::string many;
  for (int i = 1; i <= 600; ++i) many += "G01 X" + std::to_string(i) + " F500\n";
  const auto incremental = [&](const std::string& marked) {
    const SelectedProgram program(marked);
    session.close(kUri);
    session.open(kUri, program.text);
    for (const Json& action : session.request("textDocument/codeAction", params_of(program)))
      if (action["title"].get<std::string>().find("in incremental") != std::string::npos) {
        EXPECT_FALSE(action.contains("edit"));
        const Json resolved = session.respond("codeAction/resolve", action);
        if (resolved.contains("error")) return resolved["error"]["message"].get<std::string>();
        return ClientText(program.text).with(resolved["result"]["edit"]["documentChanges"][0]["edits"]);
      }
    return std::string("not offered");
  };
  const std::string changed = incremental("M06 T101001\n[!" + many + "!]M02\n");
  EXPECT_THAT(changed, testing::StartsWith("M06 T101001\nG91\nG01 X1 F500\nG01 X1 F500\n"));
  EXPECT_THAT(changed, testing::EndsWith("G01 X1 F500\nG90\nM02\n"));
  EXPECT_THAT(incremental("M06 T101001\n[!" + many + "IF VGPL = 1 GOTO N9\n" + many + "!]N9 X5\nM02\n"),
              testing::Not(testing::HasSubstr("G91")));
}

TEST_F(CodeActions, AllThatIsSafeMayTakeMoreLines) {
  const std::string program = "M06 T101001\nG49 G01 X10 C45 F1000\nG27\nG00 X1\nM02\n";
  session_.open(kUri, program);
  session_.ask("workspace/executeCommand", {{"command", "isocnc.fixAll"}, {"arguments", {{{"uri", kUri}}}}});
  const Json edits = session_.wait_for("workspace/applyEdit")["params"]["edit"]["changes"][kUri];
  EXPECT_EQ(ClientText(program).with(edits), "M06 T101001\nG49\nG01 X10 C45 F1000\nG00 X1\nM02\n");
}

TEST_F(CodeActions, RenumberingIsACommandToo) {
  const std::string program = "M06 T101001\nIF VGPL = 1 GOTO N7\nN3 G00 X1\nN7 X2\nM02\n";
  session_.open(kUri, program);
  session_.ask("workspace/executeCommand", {{"command", "isocnc.renumber"}, {"arguments", {{{"uri", kUri}}}}});
  const Json edits = session_.wait_for("workspace/applyEdit")["params"]["edit"]["changes"][kUri];
  EXPECT_EQ(ClientText(program).with(edits), "M06 T101001\nIF VGPL = 1 GOTO N20\nN10 G00 X1\nN20 X2\nM02\n");
}

/// A line that repeats a finding is silenced by itself.
TEST_F(CodeActions, SilenceALineThatRepeatsAFinding) {
  EXPECT_EQ(after("M06 T101001\nG01 X0 B5 F500\n[!!]X2 B6\nM02\n", "silence ISO032 on this line", "quickfix"),
            "M06 T101001\nG01 X0 B5 F500\nX2 B6 ;isolint: ignore ISO032\nM02\n");
}

/// With more findings than the whole report is made for, those of the line are still found.
TEST_F(CodeActions, AreThereAmongThousandsOfFindings) {
  std::string text = "M06 T101001\nG71\n";
  for (int i = 0; i < 5'000; ++i) text += "G71 G00 X1\n";
  EXPECT_EQ(after((text + "[!!]G71 G00 X2\nM02\n").c_str(), "remove G71", "quickfix"), text + "G00 X2\nM02\n");
}

TEST(Restart, IsANewDocumentBesideTheProgram) {
  Session session;
  session.start(kResolves);
  const SelectedProgram program(
      "M06 T101001 M03 S9000\nG00 X1 Z50\nG01 Z-1 F500\nG00 Z50\n[!!]X20\nG01 Z-1\nG00 Z50\nM02\n");
  session.open(kUri, program.text);
  const Json actions =
      session.request("textDocument/codeAction", params_of(program, Json::array({"refactor.rewrite.isocnc.restart"})));
  ASSERT_EQ(actions.size(), 1u) << actions;
  const Json changes = session.request("codeAction/resolve", actions[0])["edit"]["documentChanges"];
  EXPECT_EQ(changes[0], Json({{"kind", "create"}, {"uri", "file:///nowhere/part-from-5.iso"}}));
  restart::RestartOptions options{.line = 4};
  options.name = "part.iso";
  const auto made = restart::restart_program(program.text, options);
  ASSERT_TRUE(std::holds_alternative<std::string>(made));
  EXPECT_EQ(changes[1]["edits"][0]["newText"], std::get<std::string>(made));
}

TEST(Restart, IsMadeByTheEditorWhereItMakesDocuments) {
  Session session;
  session.start(kResolves);
  session.open(kUri, "M06 T101001\nG00 X1 Z50\nX20\nM02\n");
  session.ask("workspace/executeCommand",
              {{"command", "isocnc.restart"}, {"arguments", {{{"uri", kUri}, {"line", 2}}}}});
  const Json changes = session.wait_for("workspace/applyEdit")["params"]["edit"]["documentChanges"];
  EXPECT_EQ(changes[0]["uri"], "file:///nowhere/part-from-3.iso");
  EXPECT_THAT(changes[1]["edits"][0]["newText"].get<std::string>(), testing::EndsWith("X20\nM02\n"));
}

/// From home around a post to its work; a restart would go through it.
TEST(Restart, IsNotMadeWhereItsWayHitsSomething) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "isols-restart-post";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "isocnc.json") << R"({"machine": {"home": {"z": 400},
      "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 5, "length": 100, "shape": "flat"}]},
    "setups": [{"paths": ["*.iso"], "frame": "machine",
                "fixtures": [{"name": "post", "box": [[90, -20, 0], [110, 20, 500]]}]}]})";
  const std::string uri = "file://" + (folder / "part.iso").string();
  Session session;
  session.start();
  session.open(uri,
               "M06 T101001\nS12000 M03\nG00 Y100\nX200\nY0\nZ-2\nG01 X190 F1000\nX180\nG00 Z300\nY100\nM05\nM02\n");
  const auto restart = [&](int line) {
    return session.respond("workspace/executeCommand",
                           {{"command", "isocnc.restart"}, {"arguments", {{{"uri", uri}, {"line", line}}}}});
  };
  EXPECT_THAT(restart(7)["error"]["message"].get<std::string>(),
              testing::HasSubstr("no safe restart before line 8: on the way, the cutter of T101001 hits post"));
  EXPECT_THAT(restart(3)["result"]["text"].get<std::string>(), testing::HasSubstr("\nX200\n"));
  std::filesystem::remove_all(folder);
}

/// The tool stands 8 mm beside the contour, and can be raised by at most 40 mm.
TEST(Restart, IsMadeForTheConfiguredMachine) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "isols-restart";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "isocnc.json") << R"({"machine": {
    "axes": {"Z": {"max": 130}},
    "tools": [{"head": 1, "holder": 1, "tool": 2, "length": 90, "radius": 8}]}})";
  const std::string uri = "file://" + (folder / "part.iso").string();
  Session session;
  session.start();
  session.open(uri,
               "M06 T101002\nG00 X-30 Y-30 Z30\nG01 Z-5 F1000\nG41 X0 Y-15\nY100\nX60\nG40\nG00 Z30\nX90 Y100\nG00 "
               "Z70\nX0 Y0\nM02\n");
  const auto restart = [&](int line) {
    return session.respond("workspace/executeCommand",
                           {{"command", "isocnc.restart"}, {"arguments", {{{"uri", uri}, {"line", line}}}}});
  };
  EXPECT_THAT(restart(8)["result"]["text"].get<std::string>(), testing::HasSubstr("\nX60 Y108\n"));
  EXPECT_THAT(restart(10)["error"]["message"].get<std::string>(), testing::HasSubstr("Z would go to 160"));
  std::filesystem::remove_all(folder);
}

TEST(Restart, IsTheCommandsResultForEditorsThatMakeNoDocuments) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG00 X1 Z50\nX20\nM02\n");
  const auto restart = [&](const Json& line) {
    return session.respond("workspace/executeCommand",
                           {{"command", "isocnc.restart"}, {"arguments", {{{"uri", kUri}, {"line", line}}}}});
  };
  EXPECT_THAT(restart(2)["result"]["text"].get<std::string>(), testing::EndsWith("X20\nM02\n"));
  EXPECT_EQ(restart(99)["error"]["code"], -32803);
  session.edit(kUri, 2, {lsp::change(1, 0, 1, 0, "G02 ")});
  EXPECT_THAT(restart(2)["error"]["message"].get<std::string>(), testing::HasSubstr("2"));
  session.edit(kUri, 3, {lsp::change(1, 0, 1, 4, "")});
  EXPECT_EQ(restart(-1)["error"]["code"], -32602);
  EXPECT_EQ(restart("2")["error"]["code"], -32602);
}

}  // namespace
}  // namespace isocnc::lsp
