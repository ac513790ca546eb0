#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/solids/stl.h"
#include "lsp/documents/kept_run.h"
#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"
#include "watched_runs.h"

/// What a run on the simulated machine shows, beside the findings of the text.
namespace isocnc::lsp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view kMachine = R"({"machine": {
  "axes": {"X": {"min": 0, "max": 100}, "Z": {"min": -50, "max": 120}},
  "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 10, "length": 40}]}})";

/// X leaves its travel on the third line, and the line below is still outside.
const std::string kProgram =
    "M06 T101001\n"
    "G00 X30 Y20\n"
    "X130\n"
    "Y30\n"
    "M02\n";

const Json kProgressCapability = {{"window", {{"workDoneProgress", true}}}};
const Json kPullCapabilities = {{"textDocument", {{"diagnostic", Json::object()}}},
                                {"workspace", {{"diagnostics", {{"refreshSupport", true}}}}}};

/// `E160@2`: code and line of each diagnostic of the machine, from 0; in brackets if it is faded.
std::vector<std::string> of_machine(const Json& diagnostics) {
  std::vector<std::string> places;
  for (const Json& each : diagnostics) {
    if (each["source"] != "isocnc verify" || each["severity"] == 4 || !each.contains("code")) continue;
    const bool is_faded = each.contains("tags") && each["tags"] == Json::array({1});
    places.push_back(fmt::format(fmt::runtime(is_faded ? "({}@{})" : "{}@{}"), each["code"].get<std::string>(),
                                 each["range"]["start"]["line"].get<int>()));
  }
  return places;
}

class VerificationTest : public testing::Test {
 protected:
  VerificationTest() {
    folder_.write("isocnc.json", kMachine);
    uri_ = protocol::uri_of(std::filesystem::canonical(folder_.path()) / "part.iso");
  }

  void start(const Json& capabilities = Json::object(), const Json& settings = Json::object()) {
    session_.start(capabilities, {{"locale", "en"}, {"initializationOptions", settings}});
  }
  void open(const std::string& text = kProgram) { session_.open(uri_, text, ++version_); }
  void edit(const Json& step) { session_.edit(uri_, ++version_, {step}); }
  void save() { session_.notify("textDocument/didSave", {{"textDocument", {{"uri", uri_}}}}); }
  void set(const Json& settings) {
    session_.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", settings}}}});
  }
  /// The next diagnostics that are pushed for the present text.
  std::vector<std::string> pushed() { return of_machine(session_.diagnostics(uri_, version_)); }
  Json pull() { return session_.request("textDocument/diagnostic", document_params(uri_.c_str())); }
  /// What was sent before has been handled when this returns, timers without a length included.
  void settle() {
    for (int i = 0; i < 3; ++i) session_.request("textDocument/foldingRange", document_params(uri_.c_str()));
  }

  const support::TemporaryFolder folder_;
  std::string uri_;
  int version_ = 0;
  WatchedRuns runs_;
  background::VerificationOptions options_ = runs_.options();
  Session session_{options_};
};

TEST_F(VerificationTest, ShowsWhatTheMachineShowsBesideTheText) {
  start();
  open("M06 T101001\nG00 X30 Y20\nX130\nY30\nG80\nM02\n");
  EXPECT_THAT(pushed(), IsEmpty());
  const Json diagnostics = session_.diagnostics(uri_, version_);
  EXPECT_THAT(of_machine(diagnostics), ElementsAre("E160@2"));
  const Json& of_text = diagnostics[0];
  EXPECT_EQ(of_text["source"], "isolint");
  EXPECT_EQ(of_text["code"], "E001");
  const Json& travel = diagnostics[1];
  EXPECT_EQ(travel["message"],
            "the machine's X leaves its travel: it goes to 130, and the travel ends at 100 (and 1 more line, line 4)");
  EXPECT_EQ(travel["severity"], 1);
  EXPECT_EQ(travel["range"],
            (Json{{"start", {{"line", 2}, {"character", 0}}}, {"end", {{"line", 2}, {"character", 4}}}}));
  EXPECT_EQ(travel["data"]["name"], "joint-travel");
}

/// A line on which the run has compared the joints has no finding about the tip (W130).
TEST_F(VerificationTest, ReplacesWhatTheTextConcludesFromTheTip) {
  start();
  open();
  EXPECT_THAT(session_.diagnostics(uri_, version_)[0]["code"], "W130");
  const Json verified = session_.diagnostics(uri_, version_);
  EXPECT_EQ(verified[0]["code"], "E160");
  edit(change(2, 4, 2, 4, "0"));  // X1300: nothing is known of the machine on the new line.
  const Json edited = session_.diagnostics(uri_, version_);
  EXPECT_EQ(edited[0]["code"], "W130");
  EXPECT_EQ(edited[0]["range"]["start"]["line"], 2);
}

TEST_F(VerificationTest, KnowsTheSetupBesideTheProgram) {
  folder_.write("isocnc.json", R"({"machine": {"kinematics": {"type": "three-axis"}, "home": {"z": 300}, "tools": [
    {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat"}]}})");
  start({}, {{"verify", "onSave"}});
  open("M06 T101001\nG00 X0 Y0 Z10\nX200\nZ50\nM02\n");
  EXPECT_THAT(pushed(), IsEmpty());
  runs_.wait_for_starts(1);
  folder_.write("part.setup.json", R"({"fixtures": [{"name": "clamp 1", "box": [[100, -20, 0], [140, 20, 30]]}]})");
  const std::string setup = uri_.substr(0, uri_.size() - 4) + ".setup.json";
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", Json::array({{{"uri", setup}, {"type", 1}}})}});
  std::vector<std::string> found;
  for (int i = 0; i < 4 && found.empty(); ++i) found = pushed();
  EXPECT_THAT(found, ElementsAre("E152@2"));
}

/// With a mistake in its setup, a program is not shown as if it had been compared with it.
TEST_F(VerificationTest, SaysWhereTheSetupHasAMistake) {
  start({}, {{"verify", "onSave"}});
  open();
  EXPECT_THAT(pushed(), IsEmpty());
  runs_.wait_for_starts(1);
  folder_.write("part.setup.json", R"({"fixtures": [{"name": "clamp", "box": [[0, 0, 0], [1, 1]]}]})");
  const std::string setup = uri_.substr(0, uri_.size() - 4) + ".setup.json";
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", Json::array({{{"uri", setup}, {"type", 1}}})}});
  std::vector<std::string> found;
  for (int i = 0; i < 4 && found.size() < 2; ++i) found = pushed();
  EXPECT_THAT(found, ElementsAre("W162@0", "E160@2"));
}

/// What is wrong with a mesh is known once a run has read it. It is reported in the file that names it, open or not.
TEST_F(VerificationTest, ReportsMeshesThatCannotBeHad) {
  folder_.write("isocnc.json", R"({"setups": [{"paths": ["other.iso"]}]})");
  folder_.write("part.setup.json", R"({"clearance": 3, "target": {"mesh": "door.stl"}})");
  const std::string setup = uri_.substr(0, uri_.size() - 4) + ".setup.json";
  const auto mistakes = [&] {
    const Json published = session_.wait_for([&](const Json& message) {
      return message.value("method", "") == "textDocument/publishDiagnostics" && message["params"]["uri"] == setup;
    });
    return published["params"]["diagnostics"];
  };
  start({}, {{"verify", "onSave"}});
  open("M06 T101001\nG00 X5\nM02\n");
  EXPECT_THAT(mistakes(), IsEmpty());
  const Json found = mistakes();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0]["message"].get<std::string>(), HasSubstr("target.mesh: door.stl: cannot read"));
  EXPECT_EQ(found[0]["range"]["start"], (Json{{"line", 0}, {"character", 36}}));
  // Open, it is marked where it stands in the editor.
  session_.open(setup, "\n{\"target\": {\"mesh\": \"door.stl\"}}", 1);
  EXPECT_EQ(mistakes()[0]["range"]["start"], (Json{{"line", 1}, {"character", 20}}));
  session_.edit(setup, 2, {change(1, 21, 1, 25, "gate")});
  EXPECT_THAT(mistakes(), IsEmpty());
  // The mesh arrives.
  session_.edit(setup, 3, {change(1, 21, 1, 25, "door")});
  EXPECT_EQ(mistakes().size(), 1u);
  const geometry::Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<solids::Triangle> triangles;
  for (const auto& [a, b, c] : std::array<std::array<int, 3>, 4>{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})
    triangles.push_back({{corners[a], corners[b], corners[c]}});
  folder_.write("door.stl", solids::write_stl(triangles));
  const std::string mesh = uri_.substr(0, uri_.rfind('/')) + "/door.STL";
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", Json::array({{{"uri", mesh}, {"type", 1}}})}});
  EXPECT_THAT(mistakes(), IsEmpty());
}

/// A contact leads to the line on which it ends, and to the place that describes what is hit.
TEST_F(VerificationTest, RelatesAContactToItsEndAndToWhatIsHit) {
  folder_.write("isocnc.json", R"({"machine": {"kinematics": {"type": "three-axis"}, "home": {"z": 300}, "tools": [
    {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat"}]}})");
  folder_.write("part.setup.json",
                "{\"fixtures\": [\n  {\"name\": \"clamp 1\", \"box\": [[100, -20, 0], [140, 20, 30]]}]}");
  start({{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}}, {{"verify", "onSave"}});
  open("M06 T101001\nG00 X0 Y0 Z10\nX110\nX120\n  X200 ; out\nZ50\nM02\n");
  EXPECT_THAT(pushed(), IsEmpty());
  const Json found = session_.diagnostics(uri_, version_);
  ASSERT_THAT(of_machine(found), ElementsAre("E152@2"));
  const std::string setup = uri_.substr(0, uri_.size() - 4) + ".setup.json";
  const auto place = [](int line, int begin, int end) {
    return Json{{"start", {{"line", line}, {"character", begin}}}, {"end", {{"line", line}, {"character", end}}}};
  };
  const Json described = {{"location", {{"uri", setup}, {"range", place(1, 2, 2)}}},
                          {"message", "clamp 1 is described here"}};
  const auto until = [&](int line) {
    return Json{{"location", {{"uri", uri_}, {"range", place(line, 2, 6)}}}, {"message", "it lasts until here"}};
  };
  EXPECT_EQ(found[0]["relatedInformation"], Json::array({until(4), described}));
  edit(change(3, 0, 3, 0, "; a comment\n"));
  EXPECT_EQ(session_.diagnostics(uri_, version_)[0]["relatedInformation"], Json::array({until(5), described}));
  edit(change(5, 3, 5, 6, "201"));
  EXPECT_EQ(session_.diagnostics(uri_, version_)[0]["relatedInformation"], Json::array({described}));
}

/// Another value of VGPL than 0 leads there.
TEST_F(VerificationTest, ShowsWhatOtherValuesOfVgplLeadTo) {
  start({{"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}}, {{"verify", "onSave"}});
  open("M06 T101001\nIF VGPL >= 1 GOTO N30\nM02\nN30 G00 X130\nIF V2 = 1 GOTO N40\nN40 M02\n");
  pushed();
  const Json diagnostics = session_.diagnostics(uri_, version_);
  EXPECT_THAT(of_machine(diagnostics), ElementsAre("E160@3", "W162@4"));
  const Json& jumps = diagnostics[0]["relatedInformation"];
  ASSERT_EQ(jumps.size(), 1u) << diagnostics;
  EXPECT_EQ(jumps[0]["message"], "IF VGPL >= 1 GOTO N30: jumps");
  EXPECT_EQ(jumps[0]["location"]["range"]["start"]["line"], 1);
  edit(change(1, 13, 1, 14, "2"));
  EXPECT_THAT(pushed(), ElementsAre("(W162@4)"));
}

TEST_F(VerificationTest, FadesWhileTheTextHasChangedSince) {
  start({}, {{"verify", "onSave"}});
  open();
  pushed();
  EXPECT_THAT(pushed(), ElementsAre("E160@2"));
  edit(change(0, 0, 0, 0, "; a comment\n; and one more\n"));
  EXPECT_THAT(pushed(), ElementsAre("(E160@4)"));
  edit(change(4, 4, 4, 4, "\n"));
  EXPECT_THAT(pushed(), ElementsAre("(E160@4)"));
  edit(change(0, 0, 1, 0, ""));
  EXPECT_THAT(pushed(), ElementsAre("(E160@3)"));
  save();
  EXPECT_THAT(pushed(), ElementsAre("E160@3"));
}

TEST_F(VerificationTest, DropsWhatIsAboutALineThatIsEditedAway) {
  start({}, {{"verify", "onSave"}});
  open();
  pushed();
  EXPECT_THAT(pushed(), ElementsAre("E160@2"));
  edit(change(2, 0, 3, 0, ""));
  // The line below was still outside, and is now the first that says so.
  EXPECT_THAT(pushed(), ElementsAre("(E160@2)"));
  edit(change(2, 1, 2, 1, "4"));
  EXPECT_THAT(pushed(), IsEmpty());
}

TEST_F(VerificationTest, StaysWithItsLinesWhereTheWholeTextIsSent) {
  start({}, {{"verify", "onSave"}});
  open();
  pushed();
  EXPECT_THAT(pushed(), ElementsAre("E160@2"));
  edit({{"text", "; a comment\n" + kProgram}});
  EXPECT_THAT(pushed(), ElementsAre("(E160@3)"));
  edit({{"text", "M02\n"}});
  EXPECT_THAT(pushed(), IsEmpty());
}

TEST_F(VerificationTest, VerifiesAfterAPauseInTyping) {
  start();
  open("M06 T101001\nM02\n");
  runs_.wait_for_starts(1);
  edit(change(1, 0, 1, 0, "G00 X130 Y1\n"));
  EXPECT_THAT(runs_.wait_for_starts(2).back(), HasSubstr("X130"));
}

TEST_F(VerificationTest, WaitsForSavingWhereTheUserWantsItSo) {
  start({}, {{"verify", "onSave"}});
  open("M02\n");
  EXPECT_THAT(runs_.wait_for_starts(1), ElementsAre("M02\n"));
  edit(change(0, 0, 0, 0, ";1\n"));
  settle();
  edit(change(0, 0, 0, 0, ";2\n"));
  settle();
  save();
  EXPECT_THAT(runs_.wait_for_starts(2), ElementsAre("M02\n", ";2\n;1\nM02\n"));
  save();  // Nothing has changed.
  settle();
  edit(change(0, 0, 0, 0, ";3\n"));
  save();
  EXPECT_EQ(runs_.wait_for_starts(3).back(), ";3\n;2\n;1\nM02\n");
}

TEST_F(VerificationTest, IsOffWhereTheUserWantsItSo) {
  start({}, {{"verify", "off"}});
  open();
  pushed();
  save();
  settle();
  EXPECT_THAT(runs_.texts(), IsEmpty());
  set({{"verify", "onSave"}});
  runs_.wait_for_starts(1);
  for (std::vector<std::string> shown; shown.empty();) shown = pushed();
  set({{"verify", "off"}});
  for (std::vector<std::string> shown = {""}; !shown.empty();) shown = pushed();
}

TEST_F(VerificationTest, VerifiesAgainForAnotherMachine) {
  start();
  open();
  pushed();
  EXPECT_THAT(pushed(), ElementsAre("E160@2"));
  folder_.write("isocnc.json", R"({"machine": {"axes": {"X": {"min": 0, "max": 125}}}})");
  const std::string configuration = protocol::uri_of(std::filesystem::canonical(folder_.path()) / "isocnc.json");
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", configuration}, {"type", 2}}}}});
  EXPECT_THAT(pushed(), ElementsAre("(E160@2)"));
  const Json diagnostics = session_.diagnostics(uri_, version_);
  EXPECT_THAT(of_machine(diagnostics), ElementsAre("E160@2"));
  EXPECT_THAT(diagnostics[0]["message"].get<std::string>(), HasSubstr("the travel ends at 125"));
}

/// Requests are answered, and fast findings shown, while a run goes on.
TEST_F(VerificationTest, DelaysNothingElse) {
  start();
  runs_.hold();
  open("M06 T101001\nG00 X30 Y20\nX130\nG80\nM02\n");
  EXPECT_EQ(session_.diagnostics(uri_, version_).back()["code"], "E001");
  runs_.wait_for_starts(1);
  settle();
  session_.open("untitled:a", "G80\n", 1);
  EXPECT_EQ(session_.diagnostics("untitled:a", 1)[0]["code"], "E001");
  runs_.release();
  EXPECT_THAT(pushed(), ElementsAre("E160@2"));
}

TEST_F(VerificationTest, StopsWhenTheTextChanges) {
  start({}, {{"verify", "onSave"}});
  runs_.hold();
  open();
  runs_.wait_for_starts(1);
  edit(change(0, 0, 0, 0, ";\n"));
  EXPECT_TRUE(runs_.wait_for_stops(1));
  runs_.release();
  settle();
  EXPECT_THAT(pushed(), IsEmpty()) << "what the stopped run has found is not shown";
  save();
  EXPECT_THAT(pushed(), ElementsAre("E160@3"));
}

TEST_F(VerificationTest, StopsWhenTheDocumentIsClosed) {
  start();
  runs_.hold();
  open();
  runs_.wait_for_starts(1);
  session_.close(uri_);
  EXPECT_TRUE(runs_.wait_for_stops(1));
}

TEST_F(VerificationTest, StopsWhenTheServerEnds) {
  start();
  runs_.hold();
  open();
  runs_.wait_for_starts(1);
  session_.end();
  EXPECT_TRUE(runs_.wait_for_stops(1));
}

TEST_F(VerificationTest, RunsOneProgramAtATime) {
  start();
  runs_.hold();
  open();
  session_.open("untitled:a", "M02\n", 1);
  EXPECT_EQ(runs_.wait_for_starts(1).size(), 1u);
  session_.request("textDocument/foldingRange", document_params("untitled:a"));
  EXPECT_EQ(runs_.texts().size(), 1u);
  runs_.release();
  EXPECT_EQ(runs_.wait_for_starts(2).size(), 2u);
}

TEST_F(VerificationTest, RepeatsAPullWhereItHasShownSomething) {
  start(kPullCapabilities);
  runs_.hold();
  open();
  const Json before = pull();
  EXPECT_THAT(of_machine(before["items"]), IsEmpty());
  runs_.release();
  session_.wait_for("workspace/diagnostic/refresh");
  const Json after = pull();
  EXPECT_THAT(of_machine(after["items"]), ElementsAre("E160@2"));
  EXPECT_NE(before["resultId"], after["resultId"]);
  Json again = document_params(uri_.c_str());
  again["previousResultId"] = after["resultId"];
  EXPECT_EQ(session_.request("textDocument/diagnostic", again)["kind"], "unchanged");
  runs_.hold();
  edit(change(0, 0, 0, 0, ";\n"));
  EXPECT_THAT(of_machine(pull()["items"]), ElementsAre("(E160@3)"));
  runs_.release();
  session_.wait_for("workspace/diagnostic/refresh");
  EXPECT_THAT(of_machine(pull()["items"]), ElementsAre("E160@3"));
  EXPECT_FALSE(session_.has([&](const Json& message) {
    return message.value("method", "") == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri_;
  }));
}

TEST_F(VerificationTest, VerifiesLongProgramsOnlyOnSaving) {
  options_.max_size = 20;
  Session session(options_);
  session.start({}, {{"locale", "en"}});
  session.open(uri_, kProgram, 1);
  session.diagnostics(uri_, 1);
  session.edit(uri_, 2, {change(0, 0, 0, 0, ";\n")});
  session.diagnostics(uri_, 2);
  for (int i = 0; i < 3; ++i) session.request("textDocument/foldingRange", document_params(uri_.c_str()));
  EXPECT_THAT(runs_.texts(), IsEmpty());
  session.notify("textDocument/didSave", {{"textDocument", {{"uri", uri_}}}});
  EXPECT_THAT(of_machine(session.diagnostics(uri_, 2)), ElementsAre("E160@3"));
}

TEST_F(VerificationTest, VerifiesSlowProgramsOnlyOnSaving) {
  options_.slow = std::chrono::milliseconds(0);
  Session session(options_);
  session.start({}, {{"locale", "en"}});
  session.open(uri_, kProgram, 1);
  session.diagnostics(uri_, 1);
  EXPECT_THAT(of_machine(session.diagnostics(uri_, 1)), ElementsAre("E160@2"));
  session.edit(uri_, 2, {change(0, 0, 0, 0, ";\n")});
  for (int i = 0; i < 3; ++i) session.request("textDocument/foldingRange", document_params(uri_.c_str()));
  session.edit(uri_, 3, {change(0, 0, 0, 0, ";\n")});
  session.notify("textDocument/didSave", {{"textDocument", {{"uri", uri_}}}});
  EXPECT_THAT(runs_.wait_for_starts(2), ElementsAre(kProgram, ";\n;\n" + kProgram));
}

class VerificationProgress : public VerificationTest {
 protected:
  /// The kind of the next progress, and the token.
  std::pair<std::string, std::string> progress(Session& session) {
    const Json params = session.wait_for("$/progress")["params"];
    return {params["value"]["kind"], params["token"]};
  }
  static bool is_progress(const Json& message) {
    return message.value("method", "") == "$/progress" ||
           message.value("method", "") == "window/workDoneProgress/create";
  }
};

TEST_F(VerificationProgress, IsShownWhereARunTakesLong) {
  options_.shown_after = std::chrono::milliseconds(0);
  Session session(options_);
  session.start(kProgressCapability, {{"locale", "en"}});
  runs_.hold();
  session.open(uri_, kProgram, 1);
  const Json token = session.wait_for("window/workDoneProgress/create")["params"]["token"];
  const Json begin = session.wait_for("$/progress")["params"];
  EXPECT_EQ(begin["token"], token);
  EXPECT_EQ(begin["value"], (Json{{"kind", "begin"}, {"title", "verifying part.iso"}, {"cancellable", true}}));
  runs_.release();
  EXPECT_EQ(progress(session).first, "end");
}

TEST_F(VerificationProgress, EndsTheRunWhenTheUserCancelsIt) {
  options_.shown_after = std::chrono::milliseconds(0);
  Session session(options_);
  session.start(kProgressCapability, {{"locale", "en"}});
  runs_.hold();
  session.open(uri_, kProgram, 1);
  const auto [kind, token] = progress(session);
  EXPECT_EQ(kind, "begin");
  session.notify("window/workDoneProgress/cancel", {{"token", 7}});
  session.notify("window/workDoneProgress/cancel", {{"token", "opening of 1"}});
  session.notify("window/workDoneProgress/cancel", {{"token", token}});
  EXPECT_EQ(progress(session).first, "end");
  EXPECT_TRUE(runs_.wait_for_stops(1));
  session.notify("window/workDoneProgress/cancel", {{"token", token}});
  runs_.release();
  session.notify("textDocument/didSave", {{"textDocument", {{"uri", uri_}}}});
  session.diagnostics(uri_, 1);
  EXPECT_THAT(of_machine(session.diagnostics(uri_, 1)), ElementsAre("E160@2"));
}

TEST_F(VerificationProgress, EndsWithTheDocument) {
  options_.shown_after = std::chrono::milliseconds(0);
  Session session(options_);
  session.start(kProgressCapability, {{"locale", "en"}});
  runs_.hold();
  session.open(uri_, kProgram, 1);
  EXPECT_EQ(progress(session).first, "begin");
  session.close(uri_);
  EXPECT_EQ(progress(session).first, "end");
}

TEST_F(VerificationProgress, IsNotShownOfShortRunsOrToOtherClients) {
  options_.shown_after = std::chrono::hours(1);
  Session session(options_);
  session.start(kProgressCapability);
  session.open(uri_, kProgram, 1);
  session.diagnostics(uri_, 1);
  session.diagnostics(uri_, 1);
  EXPECT_FALSE(session.has(is_progress));

  options_.shown_after = std::chrono::milliseconds(0);
  Session other(options_);
  other.start();
  runs_.hold();
  other.open(uri_, kProgram, 1);
  runs_.wait_for_starts(2);
  for (int i = 0; i < 3; ++i) other.request("textDocument/foldingRange", document_params(uri_.c_str()));
  EXPECT_FALSE(other.has(is_progress));
}

TEST_F(VerificationTest, FollowsCommentsAndSeverities) {
  folder_.write("isocnc.json",
                R"({"machine": {"axes": {"X": {"min": 0, "max": 100}}}, "lint": {"severity": {"E160": "info"}}})");
  start({}, {{"verify", "onSave"}});
  open("M06 T101001\nG00 X130 Y20 ;isolint: ignore E160\nX30\nX131\nM02\n");
  pushed();
  const Json diagnostics = session_.diagnostics(uri_, version_);
  EXPECT_THAT(of_machine(diagnostics), ElementsAre("E160@3"));
  EXPECT_EQ(diagnostics[0]["severity"], 3);
  EXPECT_EQ(diagnostics.size(), 1u) << diagnostics;
}

/// A run with more findings than are shown.
TEST_F(VerificationTest, IsBoundedWhereARunShowsVeryMuch) {
  constexpr std::size_t kMistakes = 5000;
  std::string text = "M06 T101001\nG00 X30 Y20\n";
  for (std::size_t i = 0; i < kMistakes; ++i) text += "X130\nX30\nX20\n";
  start({}, {{"verify", "onSave"}});
  open(text + "M02\n");
  session_.diagnostics(uri_, version_);
  const Json diagnostics = session_.diagnostics(uri_, version_);
  EXPECT_EQ(diagnostics.size(), 1001u);
  EXPECT_EQ(of_machine(diagnostics).size(), 1000u);
  EXPECT_EQ(diagnostics.back()["message"], "findings that are not shown: 4000; isolint reports them all");
}

simulation::RunFinding finding(std::size_t line, std::int32_t mistake = -1) {
  return {.line = line, .finding = {}, .mistake = mistake};
}

using Stretches = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(KeptRun, MovesWithItsLines) {
  documents::KeptRun run({.findings = {finding(1), finding(5), finding(9)}, .runs = {{.executed = {{0, 3}, {5, 9}}}}});
  run.replace_lines(5, 2, 3);
  EXPECT_EQ(run.outcome().findings, (std::vector{finding(1), finding(10)}));
  EXPECT_EQ(run.outcome().runs[0].executed, (Stretches{{0, 3}, {8, 10}}));
  run.replace_lines(9, 0, 1);
  EXPECT_EQ(run.outcome().findings, (std::vector{finding(1), finding(11)}));
  EXPECT_EQ(run.outcome().runs[0].executed, (Stretches{{0, 3}, {8, 8}, {10, 11}}));
  run.replace_lines(0, 2, 0);
  EXPECT_EQ(run.outcome().findings, std::vector{finding(9)});
  EXPECT_EQ(run.outcome().runs[0].executed, (Stretches{{0, 1}, {6, 6}, {8, 9}}));
  run.replace_lines(0, 20, 1);
  EXPECT_TRUE(run.outcome().findings.empty());
  EXPECT_TRUE(run.outcome().runs[0].executed.empty());
}

/// What an edited jump leads to may not be reached any more.
TEST(KeptRun, MovesTheJumpsThatLeadToFindings) {
  simulation::RunOutcome outcome{.findings = {finding(7), finding(8), finding(9)},
                                 .runs = {{.decisions = {{2, false}, {4, false}}}},
                                 .paths = {{{2, true}}, {{4, true}}}};
  outcome.findings[1].path = 0;
  outcome.findings[2].path = 1;
  documents::KeptRun run(outcome);
  run.replace_lines(3, 0, 10);
  EXPECT_EQ(run.outcome().findings.size(), 3u);
  EXPECT_EQ(run.outcome().paths[0], (std::vector<simulation::RunDecision>{{2, true}}));
  EXPECT_EQ(run.outcome().paths[1], (std::vector<simulation::RunDecision>{{14, true}}));
  run.replace_lines(14, 1, 1);
  EXPECT_EQ(run.outcome().findings.size(), 2u);
  EXPECT_EQ(run.outcome().runs[0].decisions, (std::vector<simulation::RunDecision>{{2, false}}));
}

TEST(KeptRun, DropsRepetitionsFirst) {
  constexpr std::size_t kMax = documents::KeptRun::kMaxFindings;
  simulation::RunOutcome outcome;
  for (std::size_t line = 0; line < kMax; ++line) outcome.findings.push_back(finding(line, 3));
  outcome.findings.push_back(finding(kMax, 4));
  const documents::KeptRun repeated(outcome);
  EXPECT_EQ(repeated.outcome().findings.size(), kMax);
  EXPECT_EQ(repeated.outcome().findings.front(), finding(0, 3));
  EXPECT_EQ(repeated.outcome().findings.back(), finding(kMax, 4));
  EXPECT_EQ(repeated.left_out(), 0u);
  for (std::size_t line = 0; line < kMax; ++line) outcome.findings.push_back(finding(2 * kMax + line));
  const documents::KeptRun alone(outcome);
  EXPECT_EQ(alone.outcome().findings.size(), kMax);
  EXPECT_EQ(alone.outcome().findings[1], finding(kMax, 4));
  EXPECT_EQ(alone.left_out(), 2u);
}

}  // namespace
}  // namespace isocnc::lsp
