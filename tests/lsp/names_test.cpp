#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "client_text.h"
#include "marked_program.h"
#include "session.h"

/// Labels and registers: their definitions, uses and renaming. In the programs `|` is the cursor and `[...]` an
/// expected range. The comments in them hold characters of several units.
namespace isocnc::lsp {
namespace {

using protocol::Encoding;

/// The answer to a request at the cursor.
Json ask(const MarkedProgram& program, const std::string& method, Encoding encoding, const Json& more = Json::object(),
         const Json& capabilities = Json::object()) {
  Session session;
  Json all = capabilities_with(encoding);
  all.update(capabilities, true);
  session.start(all);
  session.open(kUri, program.text);
  Json params = {{"textDocument", {{"uri", kUri}}}, {"position", program.cursor}};
  params.update(more);
  return session.respond(method, params);
}

/// The ranges in an answer, which is a list or null.
std::vector<Json> ranges_in(const Json& response) {
  std::vector<Json> ranges;
  for (const Json& each : response.at("result")) ranges.push_back(each.at("range"));
  return ranges;
}

void expect_marked(const std::string& method, const std::vector<const char*>& programs, const Json& more = {}) {
  for (const char* const marked : programs)
    for (const Encoding encoding : kEncodings) {
      const MarkedProgram program(marked, encoding);
      const Json response = ask(program, method, encoding, more.is_null() ? Json::object() : more);
      EXPECT_THAT(ranges_in(response), testing::ElementsAreArray(program.marked_ranges)) << marked;
    }
}

TEST(Definition, OfALabelIsTheLineThatTheJumpLeadsTo) {
  expect_marked(
      "textDocument/definition",
      {
          "(é 😀) IF VGPL = 1 GOTO N|30\nG00 X1\n[N30] M02\n",
          "IF VGPL = 1 GOTO |N30\n(€ 😀) [n 030] M02\n",
          "IF VGPL = 1 GOTO N30|\n[N30] X1\nN30 M02\n",
          "[N30] X1\nIF VGPL = 1 GOTO N|30\nM02\n",  // An invalid backward jump: its label is shown all the same.
          "IF VGPL = 1 GOTO N|30\nM02\n",
          "[N1|0] M02\n",
          "G00 X|10\nM02\n",
      });
}

TEST(Definition, OfARegisterIsEveryAssignmentThatMayReachIt) {
  expect_marked("textDocument/definition",
                {
                    "V1=1\n[V1]=2 (😀)\nIF V|1 = 2 GOTO N9\nV1=3\nN9 M02\n",
                    "V1=1\n(😀) [V1]=2\nIF VGPL = 1 GOTO N5\n[V1]=3\nN5 IF |V1 = 2 GOTO N9\nN9 M02\n",
                    "[V1]=1\nIF VGPL = 1 GOTO N5\nV1=3\nM02\nN5 IF V1| = 2 GOTO N9\nN9 M02\n",
                    "V2=1\nIF V|1 = 2 GOTO N9\n[V1]=3\nN9 M02\n",
                    "V1=1\n[V|1]=3\nM02\n",
                });
}

TEST(Definition, OfCoordinatesAloneIsTheMotionThatTheyGoOnWith) {
  expect_marked("textDocument/definition", {
                                               "G00 X1\n(😀) [G01] X2 F100\nY|3\nM02\n",
                                               "[G01] X2 F100\nM03 S100\n\nX1 Y3|\nM02\n",
                                               "[G00] X1\nIF VGPL = 1 GOTO N5\n[G01] X2 F100\nN5 X|3\nM02\n",
                                               "[G00] X1\nIF VGPL = 1 GOTO N5\nG01 X2 F100\nM02\nN5 |X3\nM02\n",
                                               "[G00] X1\nIF VGPL = 1 GOTO N5\nX2\nM02\n[G01] X5\nN5 X|3\nM02\n",
                                               "X|3\nM02\n",
                                           });
}

TEST(References, AreTheOtherPlaces) {
  expect_marked("textDocument/references",
                {
                    "IF VGPL = 1 GOTO [N30]\n(😀) IF V1 = 1 GOTO [N030]\nN3|0 M02\n",
                    "V1=2\nIF [|V1] = 1 GOTO N30\nIF [V1] = 2 GOTO N30\nIF V2 = 2 GOTO N30\nN30 M02\n",
                    "G00 |X1\n",
                });
  expect_marked("textDocument/references",
                {
                    "IF VGPL = 1 GOTO [N30]\n(😀) IF V1 = 1 GOTO [N030]\n[N3|0] M02\n",
                    "V2=3 [V1]=2\nIF [|V1] = 1 GOTO N30\nN30 M02\n",
                },
                {{"context", {{"includeDeclaration", true}}}});
}

TEST(Highlights, MarkEachPlaceAndShowTheDefinition) {
  expect_marked("textDocument/documentHighlight", {
                                                      "IF VGPL = 1 GOTO [N3|0]\n(😀) [N30] M02\n",
                                                      "[V1]=2 (😀) [V|1]=3\nIF [V1] = 1 GOTO N30\nN30 M02\n",
                                                  });
  const MarkedProgram program("V1=2\nIF V|1 = 1 GOTO N30\nN30 M02\n", Encoding::Utf16);
  const Json result = ask(program, "textDocument/documentHighlight", Encoding::Utf16)["result"];
  EXPECT_EQ(result[0]["kind"], 3);
  EXPECT_EQ(result[1]["kind"], 2);
}

struct Renaming {
  const char* before;
  const char* name;
  const char* after;
};

TEST(Rename, ChangesTheNumberInAllPlacesAndNothingElse) {
  const Renaming kCases[] = {
      {"(😀) IF V1 = 1 GOTO N|30\nn 030 M02\n", "N45", "(😀) IF V1 = 1 GOTO N45\nn 45 M02\n"},
      {"IF V1 = 1 GOTO N30\nN3|0 M02\n", " n045 ", "IF V1 = 1 GOTO N45\nN45 M02\n"},
      {"IF V1 = 1 GOTO N3(no)0\nN3|0 M02\n", "45", "IF V1 = 1 GOTO N45(no)\nN45 M02\n"},
      {"N10 G00 X1\nN1|0 M02\n", "20",
       "N10 G00 X1\nN20 M02\n"},  // A line number that no GOTO names changes on its line only.
      {"N1|0 M02\n", "10", "N10 M02\n"},
      {"V1=2 (😀) V|1=3 V11=4\nIF V1 = 1 GOTO N30\nN30 M02\n", "V5",
       "V5=2 (😀) V5=3 V11=4\nIF V5 = 1 GOTO N30\nN30 M02\n"},
  };
  for (const auto& [before, name, after] : kCases)
    for (const Encoding encoding : kEncodings) {
      const MarkedProgram program(before, encoding);
      const Json response = ask(program, "textDocument/rename", encoding, {{"newName", name}});
      ASSERT_TRUE(response.contains("result")) << response;
      EXPECT_EQ(ClientText(program.text, encoding).with(response["result"]["changes"][kUri]), after);
    }
}

TEST(Rename, RefusesWhatWouldMeanSomethingElse) {
  const std::tuple<const char*, const char*, const char*> kCases[] = {
      {"IF V1 = 1 GOTO N|30\nN40 X1\nN30 M02\n", "N40", "N40 is taken: it stands in line 2"},
      {"IF V1 = 1 GOTO N40\nN|30 M02\n", "40", "N40 is taken: it stands in line 1"},
      {"IF V1 = 1 GOTO N|30\nN30 M02\n", "V4", "a line number is N with 1 to 15 digits"},
      {"IF V1 = 1 GOTO N|30\nN30 M02\n", "", "a line number is N with 1 to 15 digits"},
      {"IF V1 = 1 GOTO N|30\nN30 M02\n", "1234567890123456", "a line number is N with 1 to 15 digits"},
      {"V1=1\nIF V|1 = 1 GOTO N30\nV2=4\nN30 M02\n", "V2", "V2 is taken: it stands in line 3"},
      {"|V1=1\nM02\n", "V31", "registers are V1 to V30"},
      {"|V1=1\nM02\n", "V0", "registers are V1 to V30"},
      {"G00 X|1\nM02\n", "X2", "only line numbers and registers can be renamed"},
  };
  for (const auto& [marked, name, message] : kCases) {
    const MarkedProgram program(marked, Encoding::Utf16);
    const Json response = ask(program, "textDocument/rename", Encoding::Utf16, {{"newName", name}});
    ASSERT_TRUE(response.contains("error")) << response;
    EXPECT_EQ(response["error"]["message"], message);
    EXPECT_EQ(response["error"]["code"], -32803);
  }
}

TEST(Rename, NamesTheVersionToClientsThatWantIt) {
  const MarkedProgram program("N1|0 M02\n", Encoding::Utf16);
  const Json capabilities = {{"workspace", {{"workspaceEdit", {{"documentChanges", true}}}}}};
  const Json result =
      ask(program, "textDocument/rename", Encoding::Utf16, {{"newName", "N20"}}, capabilities)["result"];
  EXPECT_EQ(result["documentChanges"][0]["textDocument"], Json({{"uri", kUri}, {"version", 1}}));
  EXPECT_EQ(ClientText(program.text).with(result["documentChanges"][0]["edits"]), "N20 M02\n");
}

TEST(Rename, IsPreparedWhereThereIsAName) {
  for (const Encoding encoding : kEncodings) {
    const MarkedProgram program("(😀) IF VGPL = 1 GOTO [N0|30]\nN30 M02\n", encoding);
    const Json result = ask(program, "textDocument/prepareRename", encoding)["result"];
    EXPECT_EQ(result["range"], program.marked_ranges[0]);
    EXPECT_EQ(result["placeholder"], "N30");
  }
  const MarkedProgram elsewhere("G00 X|1\n", Encoding::Utf16);
  EXPECT_EQ(ask(elsewhere, "textDocument/prepareRename", Encoding::Utf16)["result"], nullptr);
}

TEST(Rename, IsPreparedForClientsThatAskForIt) {
  Session session;
  EXPECT_EQ(
      session.start({{"textDocument", {{"rename", {{"prepareSupport", true}}}}}})["capabilities"]["renameProvider"],
      Json({{"prepareProvider", true}}));
  Session simple;
  EXPECT_EQ(simple.start()["capabilities"]["renameProvider"], true);
}

TEST(LinkedEditing, LinksNumbersThatAreWrittenAlike) {
  for (const Encoding encoding : kEncodings) {
    const MarkedProgram program("(😀) IF VGPL = 1 GOTO N[30]\nN [3|0] M02\n", encoding);
    const Json result = ask(program, "textDocument/linkedEditingRange", encoding)["result"];
    EXPECT_THAT(result["ranges"], testing::ElementsAreArray(program.marked_ranges));
  }
  for (const char* const unlinked : {"IF VGPL = 1 GOTO N030\nN3|0 M02\n", "N10 G00 X1\nN1|0 M02\n", "V|1=2\nM02\n"}) {
    const MarkedProgram program(unlinked, Encoding::Utf16);
    EXPECT_EQ(ask(program, "textDocument/linkedEditingRange", Encoding::Utf16)["result"], nullptr) << unlinked;
  }
}

}  // namespace
}  // namespace isocnc::lsp
