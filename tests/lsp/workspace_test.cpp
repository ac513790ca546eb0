#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include <fmt/format.h>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// Diagnostics and symbols of the programs in the workspace's folders, open or not.
namespace isocnc::lsp {
namespace {

namespace fs = std::filesystem;

const Json kPulls = {{"textDocument", {{"diagnostic", Json::object()}}}};

class Workspace : public testing::Test {
 protected:
  Workspace() { write("good.iso", "M02\n"), write("sub/bad.iso", "G00 X10mm\nM02\n"), write("notes.txt", "G00\n"); }

  void write(const std::string& name, const std::string& text) const { temporary_.write(name, text); }
  std::string uri(const std::string& name) const { return protocol::uri_of(folder_ / name); }
  Json start(const Json& more = Json::object()) { return start_with(kPulls, more); }
  Json start_with(const Json& capabilities, const Json& more = Json::object()) {
    Json params = {{"workspaceFolders", Json::array({{{"uri", protocol::uri_of(folder_)}, {"name", "parts"}}})}};
    params.update(more);
    return session_.start(capabilities, params);
  }

  /// The reports by program name: `full 2` or `unchanged`. The next call sends their ids as known.
  std::map<std::string, std::string> pull() {
    Json previous = Json::array();
    for (const auto& [uri, id] : ids_) previous.push_back({{"uri", uri}, {"value", id}});
    std::map<std::string, std::string> reported;
    const Json result = session_.request("workspace/diagnostic", {{"previousResultIds", previous}});
    for (const Json& report : result["items"]) {
      const std::string uri = report["uri"];
      ids_[uri] = report["resultId"];
      reported[uri.substr(this->uri("").size())] =
          report["kind"] == "full" ? fmt::format("full {}", report["items"].size()) : report["kind"].get<std::string>();
    }
    return reported;
  }

  using Reported = std::map<std::string, std::string>;
  const support::TemporaryFolder temporary_;
  const fs::path folder_ = fs::canonical(temporary_.path());
  std::map<std::string, std::string> ids_;
  Session session_;
};

TEST_F(Workspace, ReportsProgramsThatAreNotOpen) {
  EXPECT_EQ(start()["capabilities"]["diagnosticProvider"]["workspaceDiagnostics"], true);
  EXPECT_EQ(pull(), (Reported{{"good.iso", "full 0"}, {"sub/bad.iso", "full 2"}}));
  EXPECT_EQ(pull(), (Reported{{"good.iso", "unchanged"}, {"sub/bad.iso", "unchanged"}}));
}

TEST_F(Workspace, SaysOfClosedProgramsWhatItSaysOfOpenOnes) {
  start();
  const Json closed = session_.request("workspace/diagnostic", {{"previousResultIds", Json::array()}})["items"][1];
  EXPECT_EQ(closed["version"], nullptr);
  session_.open(closed["uri"], "G00 X10mm\nM02\n", 7);
  const Json open = session_.request("textDocument/diagnostic", {{"textDocument", {{"uri", closed["uri"]}}}});
  EXPECT_EQ(open["items"], closed["items"]);
  EXPECT_EQ(open["resultId"], closed["resultId"]);
}

TEST_F(Workspace, AnswersForAFileThatIsNotOpen) {
  start();
  const auto pull_of = [&](const std::string& uri) {
    return session_.respond("textDocument/diagnostic", {{"textDocument", {{"uri", uri}}}});
  };
  EXPECT_EQ(pull_of(uri("sub/bad.iso"))["result"]["items"].size(), 2u);
  EXPECT_EQ(pull_of(uri("gone.iso"))["error"]["code"], -32801);
  EXPECT_EQ(pull_of(uri("isocnc.json"))["result"]["items"].size(), 0u);
  session_.open(uri("isocnc.json"), "{");
  EXPECT_EQ(pull_of(uri("isocnc.json"))["result"]["items"].size(), 0u);
  EXPECT_EQ(pull_of("file:///etc/hostname")["error"]["code"], -32801);
  EXPECT_EQ(pull_of(uri("../other/part.iso"))["error"]["code"], -32801);
  EXPECT_EQ(pull_of("untitled:a")["error"]["code"], -32801);
}

/// The configurations that a search uses stay valid until it ends.
TEST_F(Workspace, IsSearchedWhileItsConfigurationsChange) {
  constexpr int kFolders = 60;
  for (int i = 0; i < kFolders; ++i) {
    write(fmt::format("part{}/isocnc.json", i), R"({"lint": {"exclude": ["old/", "*.bak.iso", "draft-*"]}})");
    write(fmt::format("part{}/a.iso", i), "M02\n");
  }
  start();
  const Json changed = {{"changes", {{{"uri", uri("isocnc.json")}, {"type", 2}}}}};
  for (int round = 0; round < 20; ++round) {
    const auto id = session_.ask("workspace/diagnostic", {{"previousResultIds", Json::array()}});
    for (int i = 0; i < 50; ++i) session_.notify("workspace/didChangeWatchedFiles", changed);
    EXPECT_EQ(session_.response_to(id)["result"]["items"].size(), kFolders + 2u);
  }
}

TEST_F(Workspace, DoesNotWaitForAPipe) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.iso").c_str(), 0600), 0);
  start();
  const Json document = {{"textDocument", {{"uri", uri("pipe.iso")}}}};
  EXPECT_EQ(session_.respond("textDocument/diagnostic", document)["error"]["code"], -32801);
}

/// A file may have an older time than before, such as after a clock is set back.
TEST_F(Workspace, SeesAChangeThatIsOlderThanWhatItKnows) {
  start();
  pull();
  const auto before = fs::last_write_time(folder_ / "sub/bad.iso");
  write("sub/bad.iso", "G00 X10  \nM02\n");  // A text of the same length as before.
  fs::last_write_time(folder_ / "sub/bad.iso", before - std::chrono::hours(24));
  EXPECT_EQ(pull(), (Reported{{"good.iso", "unchanged"}, {"sub/bad.iso", "full 1"}}));
}

/// The author of the folder may have put symbolic links into it.
TEST_F(Workspace, IsNotLeftThroughSymlinks) {
  const support::TemporaryFolder outside;
  outside.write("part.iso", "G00 X10mm\nM02\n");
  fs::create_directory_symlink(outside.path(), folder_ / "away");
  fs::create_symlink(fs::path(outside.path()) / "part.iso", folder_ / "link.iso");
  start();
  EXPECT_EQ(pull(), (Reported{{"good.iso", "full 0"}, {"sub/bad.iso", "full 2"}}));
  for (const std::string name : {"away/part.iso", "link.iso", "away/../good.iso", "sub/bad.iso"}) {
    const Json document = {{"textDocument", {{"uri", uri(name)}}}};
    const Json response = session_.respond("textDocument/diagnostic", document);
    EXPECT_EQ(response.contains("error"),
              name.find("bad") == std::string::npos && name.find("good") == std::string::npos)
        << name << response;
  }
  // The folder itself may be a symbolic link, since the user named it.
  fs::create_directory_symlink(folder_, fs::path(outside.path()) / "here");
  const std::string here = protocol::uri_of(fs::path(outside.path()) / "here");
  const Json added = Json::array({{{"uri", here}, {"name", "here"}}});
  session_.notify("workspace/didChangeWorkspaceFolders", {{"event", {{"added", added}, {"removed", Json::array()}}}});
  const Json document = {{"textDocument", {{"uri", here + "/sub/bad.iso"}}}};
  EXPECT_EQ(session_.request("textDocument/diagnostic", document)["items"].size(), 2u);
}

TEST_F(Workspace, SeesWhatTheEditorAndOthersChange) {
  start();
  pull();
  session_.open(uri("good.iso"), "G00 X10 Q\nM02\n");
  write("sub/bad.iso", "M02\n");
  write("new.nc", "M02\n");
  EXPECT_EQ(pull(), (Reported{{"good.iso", "full 2"}, {"sub/bad.iso", "full 0"}, {"new.nc", "full 0"}}));
  session_.close(uri("good.iso"));
  EXPECT_EQ(pull(), (Reported{{"good.iso", "full 0"}, {"sub/bad.iso", "unchanged"}, {"new.nc", "unchanged"}}));
}

TEST_F(Workspace, RemovesTheFindingsOfRemovedPrograms) {
  start();
  pull();
  fs::remove_all(folder_ / "sub");
  EXPECT_EQ(pull(), (Reported{{"good.iso", "unchanged"}, {"sub/bad.iso", "full 0"}}));
  EXPECT_EQ(pull(), (Reported{{"good.iso", "unchanged"}}));
}

TEST_F(Workspace, KeepsToTheConfiguration) {
  write("isocnc.json", R"({"lint": {"exclude": ["sub/"]}})");
  start();
  EXPECT_EQ(pull(), (Reported{{"good.iso", "full 0"}}));
}

TEST_F(Workspace, ComesAndGoesByFolder) {
  start({{"workspaceFolders", nullptr}});
  EXPECT_EQ(pull(), Reported{});
  const Json folders = Json::array({{{"uri", protocol::uri_of(folder_ / "sub")}, {"name", "sub"}}});
  session_.notify("workspace/didChangeWorkspaceFolders", {{"event", {{"added", folders}, {"removed", Json::array()}}}});
  EXPECT_EQ(pull(), (Reported{{"sub/bad.iso", "full 2"}}));
  session_.notify("workspace/didChangeWorkspaceFolders", {{"event", {{"added", Json::array()}, {"removed", folders}}}});
  EXPECT_EQ(pull(), (Reported{{"sub/bad.iso", "full 0"}}));
}

TEST_F(Workspace, OfOlderEditorsIsOneFolder) {
  session_.start(kPulls, {{"rootUri", protocol::uri_of(folder_ / "sub")}});
  EXPECT_EQ(pull(), (Reported{{"sub/bad.iso", "full 2"}}));
}

TEST_F(Workspace, AsksTheEditorToWatchTheConfigurationFiles) {
  session_.start({{"workspace", {{"didChangeWatchedFiles", {{"dynamicRegistration", true}}}}}});
  const Json registrations = session_.wait_for("client/registerCapability")["params"]["registrations"];
  ASSERT_EQ(registrations.size(), 1u);
  EXPECT_EQ(registrations[0]["method"], "workspace/didChangeWatchedFiles");
  EXPECT_EQ(
      registrations[0]["registerOptions"]["watchers"],
      Json::parse(
          R"([{"globPattern": "**/isocnc.json"}, {"globPattern": "**/*.setup.json"}, {"globPattern": "**/*.[sS][tT][lL]"},
              {"globPattern": "**/*.[sS][tT][oO][cC][kK]"}])"));
}

const Json kRefreshed = {{"textDocument", {{"diagnostic", Json::object()}}},
                         {"workspace",
                          {{"diagnostics", {{"refreshSupport", true}}},
                           {"inlayHint", {{"refreshSupport", true}}},
                           {"codeLens", {{"refreshSupport", false}}}}}};

TEST_F(Workspace, AsksTheEditorToAskAgainWhenAnswersMayHaveChanged) {
  session_.start(kRefreshed);
  session_.open(uri("sub/bad.iso"), "G00 X10 Q\nM02\n");
  const Json document = {{"textDocument", {{"uri", uri("sub/bad.iso")}}}};
  EXPECT_EQ(session_.request("textDocument/diagnostic", document)["items"].size(), 2u);
  write("isocnc.json", R"({"lint": {"ignore": ["ISO044"]}})");
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", uri("isocnc.json")}, {"type", 1}}}}});
  EXPECT_FALSE(session_.wait_for("workspace/diagnostic/refresh").contains("params"));
  EXPECT_EQ(session_.request("textDocument/diagnostic", document)["items"].size(), 1u);
  session_.wait_for("workspace/inlayHint/refresh");
  session_.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", {{"language", "it"}}}}}});
  session_.wait_for("workspace/diagnostic/refresh");
  session_.wait_for("workspace/inlayHint/refresh");
  session_.request("textDocument/diagnostic", document);
  EXPECT_FALSE(
      session_.has([](const Json& message) { return message.value("method", "") == "workspace/codeLens/refresh"; }));
}

const Json kWatched = {
    {"textDocument", {{"diagnostic", Json::object()}}},
    {"workspace",
     {{"didChangeWatchedFiles", {{"dynamicRegistration", true}}}, {"diagnostics", {{"refreshSupport", true}}}}}};

/// The patterns of the watchers that the editor is asked for.
Json patterns_in(const Json& registration) {
  Json patterns = Json::array();
  for (const Json& watcher : registration["params"]["registrations"][0]["registerOptions"]["watchers"])
    patterns.push_back(watcher["globPattern"]);
  return patterns;
}

TEST_F(Workspace, AsksTheEditorToWatchThePrograms) {
  start_with(kWatched);
  EXPECT_EQ(
      patterns_in(session_.wait_for("client/registerCapability")),
      (Json{"**/isocnc.json", "**/*.setup.json", "**/*.[sS][tT][lL]", "**/*.[sS][tT][oO][cC][kK]", "**/*.[cC][nN][cC]",
            "**/*.[iI][sS][oO]", "**/*.[nN][cC]", "**/*.[nN][gG][cC]", "**/*.[tT][aA][pP]"}));
  write("isocnc.json", R"({"lint": {"extensions": [".H", ".mpf2"]}})");
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", uri("isocnc.json")}, {"type", 1}}}}});
  EXPECT_EQ(session_.wait_for("client/unregisterCapability")["params"]["unregisterations"][0]["id"], "files");
  EXPECT_EQ(patterns_in(session_.wait_for("client/registerCapability")),
            (Json{"**/isocnc.json", "**/*.setup.json", "**/*.[sS][tT][lL]", "**/*.[sS][tT][oO][cC][kK]", "**/*.[hH]",
                  "**/*.[mM][pP][fF]2"}));
}

TEST_F(Workspace, WatchesNoProgramsThatTheUserDoesNotWantChecked) {
  start_with(kWatched, {{"initializationOptions", {{"workspaceDiagnostics", false}}}});
  EXPECT_EQ(patterns_in(session_.wait_for("client/registerCapability")),
            (Json{"**/isocnc.json", "**/*.setup.json", "**/*.[sS][tT][lL]", "**/*.[sS][tT][oO][cC][kK]"}));
  // Whether they are checked is decided at the start.
  session_.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", {{"language", "it"}}}}}});
  session_.wait_for("workspace/diagnostic/refresh");
  session_.open(uri("good.iso"), "M02\n");
  session_.request("textDocument/diagnostic", {{"textDocument", {{"uri", uri("good.iso")}}}});
  EXPECT_FALSE(
      session_.has([](const Json& message) { return message.value("method", "") == "client/registerCapability"; }));
}

/// A CAM system writes into an open folder, and the editor has not opened the program.
TEST_F(Workspace, ReportsAProgramOnceItIsPosted) {
  start_with(kWatched);
  pull();
  const auto note = [&](const std::string& name, int type) {
    session_.notify("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", uri(name)}, {"type", type}}}}});
  };
  write("posted.iso", "M06 T101001\n");
  note("posted.iso", 1);
  write("posted.iso", "M06 T101001\nG00 X10mm\nM02\n");
  note("posted.iso", 2);
  EXPECT_FALSE(session_.wait_for("workspace/diagnostic/refresh").contains("params"));
  EXPECT_EQ(pull()["posted.iso"], "full 1");
  fs::remove(folder_ / "posted.iso");
  note("posted.iso", 3);
  session_.wait_for("workspace/diagnostic/refresh");
  EXPECT_EQ(pull()["posted.iso"], "full 0");
}

/// Until the file has been still for a moment, the editor keeps what it knows. If the moment has passed before the
/// pull, as on a busy computer, nothing is seen, and another program is written.
TEST_F(Workspace, ReportsNothingOfAProgramThatIsBeingWritten) {
  start_with(kWatched);
  pull();
  const auto is_refresh = [](const Json& message) {
    return message.value("method", "") == "workspace/diagnostic/refresh";
  };
  for (bool is_seen = false; !is_seen;) {
    write("posted.iso", "G00 X");
    write("sub/bad.iso", "M02\n");
    session_.notify(
        "workspace/didChangeWatchedFiles",
        {{"changes", {{{"uri", uri("posted.iso")}, {"type", 1}}, {{"uri", uri("sub/bad.iso")}, {"type", 2}}}}});
    const Reported reported = pull();
    is_seen = !session_.has(is_refresh);
    const Reported as_before = {{"good.iso", "unchanged"}, {"sub/bad.iso", "unchanged"}};
    EXPECT_TRUE(!is_seen || reported == as_before);
    session_.wait_for("workspace/diagnostic/refresh");
    EXPECT_EQ(pull().size(), 3u);
    write("sub/bad.iso", "G00 X10mm\nM02\n");
    fs::remove(folder_ / "posted.iso");
    pull();
    ids_.erase(uri("posted.iso"));
  }
}

TEST_F(Workspace, FindsSymbolsInAllPrograms) {
  write("sub/panel.iso", "; Fianco sinistro\nM06 T101001\nG00 X1\nM06 T102002\nM02\n");
  start();
  const auto found = [&](const std::string& query) {
    std::string names;
    for (const Json& symbol : session_.request("workspace/symbol", {{"query", query}}))
      names += fmt::format("{} in {}\n", symbol["name"].get<std::string>(),
                           symbol["location"]["uri"].get<std::string>().substr(uri("").size()));
    return names;
  };
  EXPECT_EQ(found("102002"), "T102002 in sub/panel.iso\n");
  EXPECT_EQ(found("fsinistro"), "T101001 Fianco sinistro in sub/panel.iso\n");
  EXPECT_EQ(found("T103003"), "");
  write("sub/panel.iso", "M06 T103003\nM02\n");
  EXPECT_EQ(found("T"), "T103003 in sub/panel.iso\n");
  session_.open(uri("sub/panel.iso"), "M06 T104004\nM02\n");  // The text in the editor counts, not that of the file.
  EXPECT_EQ(found("T"), "T104004 in sub/panel.iso\n");
  EXPECT_TRUE(session_.respond("workspace/symbol", {{"query", 7}}).contains("error"));
}

TEST_F(Workspace, ReportsInPartsWhereTheEditorAsksForIt) {
  start();
  pull();
  write("new.iso", "M02\n");
  fs::remove(folder_ / "good.iso");
  const Json previous = Json::array({{{"uri", uri("good.iso")}, {"value", "other"}},
                                     {{"uri", uri("sub/bad.iso")}, {"value", ids_.at(uri("sub/bad.iso"))}}});
  session_.open("untitled:a", "G00 X10 Q\nM02\n");
  const std::int64_t id =
      session_.ask("workspace/diagnostic", {{"previousResultIds", previous}, {"partialResultToken", "part"}});
  Reported reported;
  for (int i = 0; i < 3; ++i) {
    const Json progress = session_.wait_for("$/progress")["params"];
    EXPECT_EQ(progress["token"], "part");
    ASSERT_EQ(progress["value"]["items"].size(), 1u);
    const Json& report = progress["value"]["items"][0];
    reported[report["uri"]] = report["kind"];
  }
  EXPECT_EQ(reported, (Reported{{"untitled:a", "full"}, {uri("new.iso"), "full"}, {uri("sub/bad.iso"), "unchanged"}}));
  const Json rest = session_.response_to(id)["result"]["items"];
  ASSERT_EQ(rest.size(), 1u) << rest;
  EXPECT_EQ(rest[0]["uri"], uri("good.iso"));
  EXPECT_EQ(rest[0]["items"], Json::array());

  session_.open("untitled:b", "M06 T101001\nM02\n");
  const std::int64_t symbols = session_.ask("workspace/symbol", {{"query", "T1"}, {"partialResultToken", 7}});
  const Json progress = session_.wait_for("$/progress")["params"];
  EXPECT_EQ(progress["token"], 7);
  EXPECT_EQ(progress["value"][0]["location"]["uri"], "untitled:b");
  EXPECT_EQ(session_.response_to(symbols)["result"], Json::array());
}

TEST_F(Workspace, IsLeftAloneWhereTheUserWantsItSo) {
  const Json initialized = start({{"initializationOptions", {{"workspaceDiagnostics", false}}}});
  EXPECT_EQ(initialized["capabilities"]["diagnosticProvider"]["workspaceDiagnostics"], false);
}

}  // namespace
}  // namespace isocnc::lsp
