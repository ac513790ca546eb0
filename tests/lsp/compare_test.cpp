#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// isocnc/compare: what a program does otherwise than another text.
namespace isocnc::lsp {
namespace {

using testing::HasSubstr;

const std::string kOld =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X10 Y20 Z40\n"
    "G01 Z-5 F2000\n"
    "X100\n"
    "Y80\n"
    "M100\n"
    "G00 Z40\n"
    "M02\n";

Json compare_params(const std::string& old) { return {{"textDocument", {{"uri", kUri}}}, {"with", {{"text", old}}}}; }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(Compare, NamesEachChangeWithItsLinesInBothTexts) {
  Session session;
  const Json capabilities = session.start();
  EXPECT_EQ(capabilities.at("capabilities").at("experimental").at("compare"), true);
  session.open(kUri, "; new\n" + replaced(replaced(kOld, "Z-5", "Z-6"), "M100\n", ""), 7);
  const Json result = session.request("isocnc/compare", compare_params(kOld));
  EXPECT_EQ(result.at("same"), false);
  EXPECT_EQ(result.at("version"), 7);
  EXPECT_EQ(result.at("old").at("error"), nullptr);
  const Json& changes = result.at("changes");
  ASSERT_EQ(changes.size(), 2u) << changes;
  EXPECT_EQ(changes[0].at("kind"), "moved");
  EXPECT_EQ(changes[0].at("text"), "moved by Z-1");
  EXPECT_EQ(changes[0].at("tool"), "T101001");
  EXPECT_EQ(changes[0].at("old"), (Json{4, 6}));
  EXPECT_EQ(changes[0].at("oldRange"), lines(3, 6));
  EXPECT_EQ(changes[0].at("newRange"), lines(4, 7));
  EXPECT_EQ(changes[1].at("text"), "removed: M100");
  EXPECT_EQ(changes[1].at("new"), nullptr);
  EXPECT_EQ(changes[1].at("oldRange"), lines(6, 7));
  EXPECT_EQ(changes[1].at("newRange"), lines(7, 7)) << "before the line that follows";
}

TEST(Compare, IsAboutTheTextAsEdited) {
  Session session;
  session.start();
  session.open(kUri, kOld);
  EXPECT_EQ(session.request("isocnc/compare", compare_params("; before\n" + kOld)).at("same"), true);
  session.edit(kUri, 2, {change(4, 1, 4, 4, "90")});
  const Json result = session.request("isocnc/compare", compare_params(kOld));
  EXPECT_EQ(result.at("same"), false);
  EXPECT_EQ(result.at("version"), 2);
}

TEST(Compare, TakesProgramsOfAnyLength) {
  std::string text = "M06 T101001\nG01 X0 F1000\n";
  for (int i = 0; i < 5000; ++i) text += "X" + std::to_string(i % 100) + " Y" + std::to_string(i % 97) + "\n";
  text += "M02\n";
  Session session;
  session.start();
  session.open(kUri, text);
  EXPECT_EQ(session.request("isocnc/compare", compare_params(text)).at("same"), true);
  const Json result = session.request("isocnc/compare", compare_params(replaced(text, "X77 Y77", "X78 Y77")));
  ASSERT_EQ(result.at("changes").size(), 1u) << result;
  EXPECT_EQ(result.at("changes")[0].at("newRange"), lines(79, 80));
}

TEST(Compare, SaysWhereAProgramStops) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG02 X20\nM02\n");
  const Json result = session.request("isocnc/compare", compare_params("\nM06 T101001\nG02 X20\nM02\n"));
  EXPECT_EQ(result.at("same"), true);
  EXPECT_EQ(result.at("new").at("error"), (Json{{"code", "ISO066"}, {"line", 1}}));
  EXPECT_EQ(result.at("old").at("error"), (Json{{"code", "ISO066"}, {"line", 2}}));
}

TEST(Compare, EachProgramHasTheMachineAboveIt) {
  const support::TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    return protocol::uri_of(folder.write(name, text));
  };
  write("isocnc.json", R"({"machine": {"home": {"x": 0, "y": 0, "z": 100}}})");
  write("other/isocnc.json", R"({"machine": {"home": {"x": 0, "y": 0, "z": 200}}})");
  const std::string text = "M06 T101001\nG00 X10\nM02\n";
  const std::string uri = write("new.iso", text);
  const std::string beside = write("old.iso", text);
  const std::string other = write("other/old.iso", text);
  Session session;
  session.start();
  session.open(uri, text);
  Json params = {{"textDocument", {{"uri", uri}}}, {"with", {{"text", text}}}};
  EXPECT_EQ(session.request("isocnc/compare", params).at("same"), true);
  params["with"]["uri"] = beside;
  EXPECT_EQ(session.request("isocnc/compare", params).at("same"), true);
  params["with"]["uri"] = other;
  EXPECT_EQ(session.request("isocnc/compare", params).at("same"), false);
}

TEST(Compare, OtherRequestsGoOnMeanwhileAndItCanBeCancelled) {
  std::string text = "M06 T101001\nG01 X0 F1000\n";
  for (int i = 0; i < 300000; ++i) text += "X" + std::to_string(i % 100) + " Y" + std::to_string(i % 97) + "\n";
  text += "M02\n";
  Session session;
  session.start();
  session.open(kUri, text);
  const std::int64_t asked = session.ask("isocnc/compare", compare_params(text));
  session.request("isocnc/state", {{"textDocument", {{"uri", kUri}}}, {"line", 1}});
  session.notify("$/cancelRequest", {{"id", asked}});
  EXPECT_EQ(session.response_to(asked).at("error").at("code"), -32800);
}

TEST(Compare, GivesAViewBothPathsWhereItWantsThem) {
  Session session;
  session.start();
  session.open("file:///nowhere/old.iso", kOld);
  session.open(kUri, "; new\n" + replaced(kOld, "Z-5", "Z-6"));
  Json params = compare_params(kOld);
  EXPECT_FALSE(session.request("isocnc/compare", params).contains("overlay"));
  params["overlay"] = true;
  const Json overlay = session.request("isocnc/compare", params).at("overlay");
  EXPECT_EQ(overlay.at("facts").at("changes")[0].at("text").at("it"), "spostato di Z-1");
  // One line that only the new program has, then nine beside nine.
  EXPECT_EQ(overlay.at("alignment"), "AAEBAQEJ");
  const Json path = session.request("isocnc/toolpath", {{"textDocument", {{"uri", "file:///nowhere/old.iso"}}}});
  for (const char* const stream : {"steps", "points", "turns"})
    EXPECT_EQ(overlay.at("old").at(stream), path.at(stream));
}

TEST(Compare, RefusesWhatHasNoText) {
  Session session;
  session.start();
  session.open(kUri, kOld);
  const Json response = session.respond("isocnc/compare", {{"textDocument", {{"uri", kUri}}}});
  EXPECT_EQ(response.at("error").at("code"), -32602);
}

}  // namespace
}  // namespace isocnc::lsp
