#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "client_text.h"
#include "session.h"

/// Completion at the cursor.
namespace isocnc::lsp {
namespace {

const Json kSnippets = {{"textDocument", {{"completion", {{"completionItem", {{"snippetSupport", true}}}}}}}};

Json list(Session& session, const SelectedProgram& program, const Json& context = Json::object()) {
  session.open(kUri, program.text);
  return session.request("textDocument/completion", {{"textDocument", {{"uri", kUri}}},
                                                     {"position", ClientText(program.text).place(program.begin)},
                                                     {"context", context}});
}

std::set<std::string> labels(const Json& list) {
  std::set<std::string> labels;
  for (const Json& item : list["items"]) labels.insert(item["label"]);
  return labels;
}

struct Completed {
  const char* program;
  std::vector<const char*> offered;
  std::vector<const char*> not_offered;
};

const std::vector<Completed> kCompleted = {
    // Only codes that are legal in the line.
    {"[!!]", {"G00", "G01", "G02", "G90", "G91", "G92", "M02", "M06", "V1", "IF", "F", "S"}, {"X", "T101001"}},
    {"[!!]", {"G24", "G28", "G29"}, {"M07"}},
    {"G[!!]", {"G00", "G01", "G02", "G49"}, {"M02", "V1", "IF"}},
    {"g0[!!]", {"G00", "G01", "G02"}, {"M02"}},
    {"M[!!]", {"M02", "M03", "M06"}, {"G00"}},
    {"G01 X10 G[!!]", {"G09"}, {"G00", "G02", "G04", "G49", "G70", "G91", "G92"}},
    {"G17 G[!!]", {"G18", "G90"}, {"G17", "G04"}},
    {"G90\nG71\n[!!]", {"G70", "G91"}, {}},
    // Codes in force that must not be repeated are not offered.
    {"G18\n[!!]", {"G17", "G19"}, {"G18"}},
    {"G93\n[!!]", {"G94"}, {"G93"}},
    // Only the missing arguments are offered.
    {"G01 [!!]", {"X", "Y", "Z", "B", "C", "F", "S"}, {"I", "R", "A"}},
    {"G01 X10 Y1 [!!]", {"Z", "B", "F"}, {"X", "Y", "I"}},
    {"G02 X10 [!!]", {"Y", "I", "J", "R"}, {"X", "P"}},
    {"G01 F1000 [!!]", {"X", "S"}, {"F"}},
    {"G00 X1\nY1 [!!]", {"X", "Z"}, {"Y", "I"}},
    {"G04 [!!]", {"P"}, {"X", "Y"}},
    {"G0[!!] X10 I5", {"G00", "G01", "G02"}, {}},
    // Only labels below the line are offered.
    {"N10 G17\nIF V1 = 2 GOTO [!!]\nN20 G18\nG19\nN300 M02", {"N20", "N300"}, {"N10", "G00", "M02"}},
    {"IF V1 = 2 GOTO N3[!!]\nN20 G18\nN30 G19\nN300 M02", {"N30", "N300"}, {"N20"}},
    {"IF [!!]", {"VGPL", "V1", "V30"}, {"G00", "GOTO", "X"}},
    {"IF V1 [!!]", {"=", "<>", ">="}, {"G00", "V1"}},
    {"IF V1 = 2 [!!]", {"GOTO"}, {"G00", "V1"}},
    {"V[!!]", {"V1", "V30"}, {"G00", "VGPL"}},
    // Nothing is offered in comments.
    {"G01 X1 ; G[!!]", {}, {"G00", "X", "Y"}},
    {"G01 (G[!!])", {}, {"G00", "X", "Y"}},
    {"(è 😀) G[!!]", {"G00"}, {"M02"}},
    // No number is offered for a coordinate.
    {"G01 X1[!!]", {}, {"Y", "G00", "M02"}},
};

TEST(Completion, OffersWhatIsLegalAndMissing) {
  Session session;
  session.start(kSnippets);
  for (const Completed& each : kCompleted) {
    const std::set<std::string> found = labels(list(session, SelectedProgram(each.program)));
    for (const char* const label : each.offered) EXPECT_TRUE(found.contains(label)) << label << " in " << each.program;
    for (const char* const label : each.not_offered)
      EXPECT_FALSE(found.contains(label)) << label << " in " << each.program;
  }
}

std::string with_item(const SelectedProgram& program, const Json& item) {
  return ClientText(program.text).with(Json::array({item["textEdit"]}));
}

Json item_of(const Json& list, const std::string& label) {
  for (const Json& item : list["items"])
    if (item["label"] == label) return item;
  return {};
}

TEST(Completion, ReplacesWhatHasBeenTyped) {
  Session session;
  session.start();
  const SelectedProgram program("(è 😀) g0[!!] X1\n");
  EXPECT_EQ(with_item(program, item_of(list(session, program), "G01")), "(è 😀) G01 X1\n");
}

/// Each completion of a G, inserted unchanged, adds no finding to the program.
TEST(Completion, WritesArgumentsThatAreRight) {
  for (const char* const before :
       {"", "G91\n", "G18\n", "G19 G91\n", "G70\n", "G00 X3 Y4 Z5\n", "G18\nG00 X3 Y4 Z5\n"}) {
    Session session;
    session.start();
    const std::string head = std::string("M06 T101001\nM03 S1000\nF1000\n") + before;
    const SelectedProgram program(head + "[!!]\nM05\nM02\n");
    int version = 1;
    for (const Json& item : Json(list(session, program)["items"])) {
      const std::string label = item["label"];
      if (label.front() != 'G' || label == "G909" || label == "G41" || label == "G42") continue;
      const std::string text = with_item(program, item);
      session.open(kUri, text, ++version);
      for (const Json& finding : session.diagnostics(kUri, version))
        EXPECT_TRUE(finding["severity"] != 1 || finding["code"] == "ISO026") << text << finding.dump();
    }
  }
}

TEST(Completion, SpeaksInSnippetsWhereTheClientKnowsThem) {
  const SelectedProgram program("G0[!!]\n");
  Session plain;
  plain.start();
  EXPECT_EQ(item_of(list(plain, program), "G04")["textEdit"]["newText"], "G04 P1");
  Session rich;
  rich.start(kSnippets);
  const Json item = item_of(list(rich, program), "G04");
  EXPECT_EQ(item["textEdit"]["newText"], "G04 P${1:1}");
  EXPECT_EQ(item["insertTextFormat"], 2);
}

TEST(Completion, ABlankAsksForLabelsToolsAndConditionsOnly) {
  Session session;
  session.start();
  const Json blank = {{"triggerKind", 2}, {"triggerCharacter", " "}};
  EXPECT_TRUE(labels(list(session, SelectedProgram("G01 X1 [!!]\n"), blank)).empty());
  EXPECT_TRUE(labels(list(session, SelectedProgram("IF V1 = 1 GOTO [!!]\nN5 M02\n"), blank)).contains("N5"));
  EXPECT_TRUE(labels(list(session, SelectedProgram("IF [!!]\n"), blank)).contains("VGPL"));
}

TEST(Completion, KnowsTheMachinesToolsAndFunctions) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "isols-completion";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "isocnc.json") << R"({"machine": {
    "tools": [{"head": 1, "holder": 1, "tool": 1, "name": "end mill 12", "length": 80, "radius": 6},
              {"head": 1, "holder": 1, "tool": 2}],
    "functions": {"M100": {"name": "suction"}}}})";
  const std::string uri = "file://" + (folder / "part.iso").string();
  Session session;
  session.start();
  const auto at_end_of = [&](const std::string& text) {
    session.open(uri, text);
    return session.request("textDocument/completion",
                           {{"textDocument", {{"uri", uri}}}, {"position", {{"line", 0}, {"character", text.size()}}}});
  };
  const Json tools = at_end_of("M06 T");
  EXPECT_EQ(item_of(tools, "T101001")["detail"], "end mill 12, length 80 mm, radius 6 mm");
  EXPECT_TRUE(labels(tools).contains("T101002"));
  EXPECT_EQ(item_of(at_end_of("M"), "M100")["detail"], "suction");
  std::filesystem::remove_all(folder);
}

/// The nearest assignment above the cursor is preferred to all others.
TEST(Completion, ShowsWhereARegisterIsAssigned) {
  Session session;
  session.start(Json::object(), {{"locale", "en"}});
  const Json registers = list(session, SelectedProgram("V1=1\nV1=2\nIF V[!!]\nV1=3\nV2=4\nV2=5\nM02\n"));
  EXPECT_EQ(item_of(registers, "V1")["detail"], "assigned in line 2");
  EXPECT_EQ(item_of(registers, "V2")["detail"], "assigned in line 5");
}

TEST(Completion, OffersAThousandLabelsAndSaysThatThereAreMore) {
  Session session;
  session.start();
  std::string program = "IF VGPL = 1 GOTO N[!!]\n";
  for (int i = 1; i <= 1'500; ++i) program += "N" + std::to_string(i) + "\n";
  const Json offered = list(session, SelectedProgram(program + "M02\n"));
  EXPECT_EQ(offered["isIncomplete"], true);
  EXPECT_LT(offered["items"].size(), 1'500u);
}

TEST(Completion, ResolvesADocumentation) {
  Session session;
  session.start(Json::object(), {{"locale", "it"}});
  const Json item = item_of(list(session, SelectedProgram("G0[!!]\n")), "G02");
  const std::string text = session.request("completionItem/resolve", item)["documentation"]["value"];
  EXPECT_NE(text.find("interpolazione circolare"), std::string::npos) << text;
  EXPECT_NE(text.find("`R`"), std::string::npos) << text;
  const Json spindle = item_of(list(session, SelectedProgram("M0[!!]\n")), "M03");
  EXPECT_NE(session.request("completionItem/resolve", spindle)["documentation"]["value"].get<std::string>().find("M03"),
            std::string::npos);
}

}  // namespace
}  // namespace isocnc::lsp
