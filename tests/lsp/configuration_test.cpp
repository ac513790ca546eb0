#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "client_text.h"
#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// Diagnostics of isocnc.json, open or not, and the effects of its settings.
namespace isocnc::lsp {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class ConfigurationFile : public testing::Test {
 protected:
  std::string uri(const std::string& name) const { return protocol::uri_of(folder_ / name); }
  void write(const std::string& name, std::string_view text) const { temporary_.write(name, text); }
  void start() { session_.start(Json::object(), {{"locale", "en"}}); }

  /// Waits for the next diagnostics of this document: `LINE:COLUMN-COLUMN MESSAGE`, counted from 0.
  std::vector<std::string> reported_for(const std::string& name) {
    const Json published = session_.wait_for([&](const Json& message) {
      return message.value("method", "") == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri(name);
    });
    std::vector<std::string> reported;
    for (const Json& each : published["params"]["diagnostics"]) {
      const Json& range = each["range"];
      EXPECT_EQ(range["start"]["line"], range["end"]["line"]);
      reported.push_back(fmt::format("{}:{}-{} {}", range["start"]["line"].get<int>(),
                                     range["start"]["character"].get<int>(), range["end"]["character"].get<int>(),
                                     each["message"].get<std::string>()));
    }
    return reported;
  }

  const support::TemporaryFolder temporary_;
  const fs::path folder_ = fs::canonical(temporary_.path());
  Session session_;
};

/// The range of a diagnostic is exactly the wrong value, key or sign.
TEST_F(ConfigurationFile, MistakesAreMarkedWhileItIsTyped) {
  struct Case {
    std::string_view text;
    std::string_view reported;
  };
  constexpr Case kCases[] = {
      {R"({"language": "de"})", "0:13-17 language: de is not one of en, it"},
      {"{\r\n  \"language\": \"d\\\"e\" }", "1:14-20 language: d\"e is not one of en, it"},
      {"{\"machine\":\n{\"maxFeed\": 0}}", "1:12-13 machine.maxFeed: 0 is too small: at least 1 mm/min"},
      {R"({"machine": {"maxFeed": -12.5, "clearance": 1}})",
       "0:24-29 machine.maxFeed: -12.5 is too small: at least 1 mm/min"},
      {R"({"machine": [1]})", "0:12-13 machine: this is a list [ ], and an object { } is needed"},
      {R"({"è😀": 1})", "0:1-6 è😀: unknown key"},
      {"{\"language\": \"it", "0:13-16 a text without its closing quote"},
      {"{\"language\": ", "0:13-13 the file ends here, but a bracket is still open or a value missing"},
  };
  start();
  int version = 1;
  for (const Case& each : kCases) {
    session_.open(uri("isocnc.json"), std::string(each.text), version++);
    EXPECT_THAT(reported_for("isocnc.json"), ElementsAre(each.reported)) << each.text;
    session_.close(uri("isocnc.json"));
    reported_for("isocnc.json");
  }
}

/// An editor that has the file open asks for all that the server can, and shows its user each refusal.
TEST_F(ConfigurationFile, IsNoProgramButRefusesNothing) {
  start();
  session_.open(uri("isocnc.json"), "{}\n");
  const Json place = {{"textDocument", {{"uri", uri("isocnc.json")}}},
                      {"position", {{"line", 0}, {"character", 0}}},
                      {"range", lines(0, 1)},
                      {"context", {{"diagnostics", Json::array()}}}};
  for (const char* const what :
       {"hover", "completion", "definition", "documentSymbol", "documentHighlight", "codeLens", "codeAction",
        "foldingRange", "inlayHint", "semanticTokens/full", "semanticTokens/range", "formatting", "linkedEditingRange"})
    EXPECT_EQ(session_.request(std::string("textDocument/") + what, place), nullptr) << what;
  EXPECT_TRUE(session_.respond("isocnc/toolpath", place).contains("error"));
}

TEST_F(ConfigurationFile, MistakesAreReportedOnceForAllItsPrograms) {
  write("isocnc.json", "{\n\"language\": 7}");
  start();
  session_.open(uri("a.iso"), "M02\n");
  EXPECT_THAT(reported_for("isocnc.json"), ElementsAre("1:12-13 language: this is a number, and text is needed"));
  session_.open(uri("b.iso"), "M02\n");
  session_.diagnostics(uri("b.iso"), 1);
  EXPECT_FALSE(session_.has([&](const Json& message) {
    return message.value("method", "") == "textDocument/publishDiagnostics" &&
           message["params"]["uri"] == uri("isocnc.json");
  }));

  write("isocnc.json", R"({"language": "it"})");
  session_.notify("textDocument/didSave", {{"textDocument", {{"uri", uri("isocnc.json")}}}});
  EXPECT_THAT(reported_for("isocnc.json"), testing::IsEmpty());
}

TEST_F(ConfigurationFile, MistakesFollowTheLanguageOfTheEditor) {
  write("isocnc.json", "{\n\"language\": 7}");
  start();
  session_.open(uri("a.iso"), "M02\n");
  EXPECT_THAT(reported_for("isocnc.json"), ElementsAre("1:12-13 language: this is a number, and text is needed"));
  session_.notify("workspace/didChangeConfiguration", {{"settings", {{"isocnc", {{"language", "it"}}}}}});
  reported_for("isocnc.json");  // The first notification clears the old diagnostics.
  EXPECT_THAT(reported_for("isocnc.json"), ElementsAre(HasSubstr("numero")));
}

TEST_F(ConfigurationFile, ThatIsNoTextIsReported) {
  write("isocnc.json", std::string_view("\xEF\xBB\xBF{}"));
  start();
  session_.open(uri("a.iso"), "M02\n");
  EXPECT_THAT(reported_for("isocnc.json"), ElementsAre(HasSubstr("byte-order mark")));
  write("isocnc.json", std::string(2000, '\0'));
  session_.notify("textDocument/didSave", {{"textDocument", {{"uri", uri("isocnc.json")}}}});
  reported_for("isocnc.json");  // The first notification clears the old diagnostics.
  EXPECT_THAT(reported_for("isocnc.json"), ElementsAre(HasSubstr("binary")));
}

TEST_F(ConfigurationFile, SetupsOfProgramsAreMarkedWhileTheyAreTyped) {
  start();
  session_.open(uri("a.setup.json"), "// of a CAM system\n{\"clearanc\": 3, \"spoilboard\": {\"top\": \"low\"}}", 1);
  EXPECT_THAT(reported_for("a.setup.json"),
              ElementsAre("1:1-11 clearanc: unknown key; did you mean clearance?",
                          "1:38-43 spoilboard.top: this is text, and a number is needed"));
  session_.edit(uri("a.setup.json"), 2, {{{"text", "{\"clearance\": 3}"}}});
  EXPECT_THAT(reported_for("a.setup.json"), testing::IsEmpty());
}

TEST_F(ConfigurationFile, SetupsAreReportedWithTheirProgramsUntilTheyAreMended) {
  write("a.setup.json", R"({"clearance": -1})");
  start();
  session_.open(uri("a.iso"), "M02\n");
  EXPECT_THAT(reported_for("a.setup.json"), ElementsAre(HasSubstr("0:14-16 clearance: -1 is too small")));
  write("a.setup.json", R"({"clearance": 1})");
  session_.notify("workspace/didChangeWatchedFiles", {{"changes", {{{"uri", uri("a.setup.json")}, {"type", 2}}}}});
  EXPECT_THAT(reported_for("a.setup.json"), testing::IsEmpty());
}

constexpr const char* kMachine = R"({"machine": {
  "tools": [{"head": 1, "holder": 1, "tool": 1, "name": "ball nose", "length": 80, "radius": 6},
            {"head": 1, "holder": 1, "tool": 2}],
  "functions": {"M100": {"name": "vacuum", "time": 1.5}, "M101": {"name": "blower"}}}})";

TEST_F(ConfigurationFile, NamesToolsAndFunctions) {
  write("isocnc.json", kMachine);
  session_.start({{"textDocument", {{"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}}}}},
                 {{"locale", "en"}});
  session_.open(uri("part.iso"), "M06 T101001\nM100\nM06 T101002\nM101\nM102\nG00 X1\nM02\n");
  const Json document = {{"textDocument", {{"uri", uri("part.iso")}}}};
  const auto hover = [&](int line, int column) {
    Json params = document;
    params["position"] = {{"line", line}, {"character", column}};
    return session_.request("textDocument/hover", params)["contents"]["value"].get<std::string>();
  };
  EXPECT_THAT(hover(0, 4), HasSubstr("ball nose, length 80 mm, radius 6 mm"));
  EXPECT_THAT(hover(1, 1), HasSubstr("vacuum"));
  EXPECT_THAT(hover(1, 1), HasSubstr("takes 1.5 s"));
  EXPECT_THAT(hover(3, 1), HasSubstr("blower"));
  EXPECT_THAT(hover(4, 1), HasSubstr("user function"));
  const Json symbols = session_.request("textDocument/documentSymbol", document);
  EXPECT_EQ(symbols[0]["detail"], "ball nose");
}

/// If a program cannot be renumbered, all else is formatted.
TEST_F(ConfigurationFile, SetsHowProgramsAreFormatted) {
  write("isocnc.json", R"({"format": {"renumber": {"start": 100, "step": 10}}})");
  start();
  const auto formatted = [&](const std::string& name, const std::string& text) {
    session_.open(uri(name), text);
    const Json edits = session_.request(
        "textDocument/formatting",
        {{"textDocument", {{"uri", uri(name)}}}, {"options", {{"tabSize", 2}, {"insertSpaces", true}}}});
    return ClientText(text).with(edits);
  };
  EXPECT_EQ(formatted("a.iso", "IF VGPL=1 GOTO N7\nN3 g00X1\nN7 M02\n"),
            "IF VGPL = 1 GOTO N110\nN100 G00 X1\nN110 M02\n");
  EXPECT_EQ(formatted("b.iso", "IF VGPL=1 GOTO N9\nN3 g00X1\nN7 M02\n"), "IF VGPL = 1 GOTO N9\nN3 G00 X1\nN7 M02\n");
}

/// Findings of rules that are off by default appear when the configuration selects them.
TEST_F(ConfigurationFile, SelectsOpinionsOnStyle) {
  write("isocnc.json", R"({"lint": {"select": ["W1"]}})");
  start();
  session_.open(uri("part.iso"), "M06\tT101001\r\nG00 X1\nm05\r\nM02\n");
  std::vector<std::string> codes;
  for (const Json& each : session_.diagnostics(uri("part.iso"), 1))
    codes.push_back(fmt::format("{} {}", each["code"].get<std::string>(), each["range"]["start"]["line"].get<int>()));
  EXPECT_THAT(codes, testing::IsSupersetOf({"W126 0", "W125 2"})) << testing::PrintToString(codes);
}

}  // namespace
}  // namespace isocnc::lsp
