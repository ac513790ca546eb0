#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"

/// isocnc/toolpath: the path of the tool tip, and its changes after an edit.
namespace isocnc::lsp {
namespace {

constexpr const char* kStreams[] = {"steps", "points", "turns"};

std::string decoded(const std::string& base64) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  unsigned value = 0;
  for (const char c : base64.substr(0, base64.find('='))) {
    value = value << 6 | static_cast<unsigned>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(value >> bits & 0xFF);
  }
  return bytes;
}

/// A client's copy of a path, updated by the answers.
struct Known {
  std::string id;
  Json facts;
  std::string streams[3];

  std::size_t take(const Json& answer) {
    std::size_t received = 0;
    id = answer["resultId"];
    facts = answer["facts"];
    for (std::size_t i = 0; i < 3; ++i) {
      const Json& stream = answer[kStreams[i]];
      const std::string data = decoded(stream["data"]);
      received += data.size();
      if (stream.contains("start")) {
        streams[i].replace(stream["start"], stream["removed"], data);
      } else {
        streams[i] = data;
      }
    }
    return received;
  }
};

Json ask(Session& session, const std::string& previous = "") {
  Json params = {{"textDocument", {{"uri", kUri}}}};
  if (!previous.empty()) params["previousResultId"] = previous;
  return session.request("isocnc/toolpath", params);
}

std::string program(std::mt19937& random, int lines) {
  std::string text = "M06 T101001\nM03 S1000\nF1000\nG01 X0\n";
  for (int i = 0; i < lines; ++i) text += "X" + std::to_string(random() % 100) + " Y" + std::to_string(i) + "\n";
  return text + "M05\nM02\n";
}

TEST(Toolpath, SendsWhatAnEditHasChanged) {
  std::mt19937 random(1);
  Session session;
  session.start();
  session.open(kUri, program(random, 400));
  Known known;
  const std::size_t whole = known.take(ask(session));
  for (int version = 2; version < 30; ++version) {
    const int line = 4 + static_cast<int>(random() % 400);
    const std::string text = random() % 3 == 0 ? "" : "X" + std::to_string(random() % 100) + " Z1\n";
    session.edit(kUri, version, {change(line, 0, line + static_cast<int>(random() % 2), 0, text)});
    const Json answer = ask(session, known.id);
    EXPECT_EQ(answer["version"], version);
    EXPECT_LT(known.take(answer), whole / 4) << "an edit sends little";
    Known fresh;
    fresh.take(ask(session));
    EXPECT_EQ(known.facts, fresh.facts);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(known.streams[i], fresh.streams[i]) << kStreams[i];
    known.id = fresh.id;
  }
}

TEST(Toolpath, EndsWhereTheControlStops) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG00 X10\nG77\nX30\nM02\n");
  const Json facts = ask(session)["facts"];
  EXPECT_EQ(facts["ending"], "error");
  EXPECT_EQ(facts["endLine"], 2);
}

TEST(Toolpath, AnUnknownPreviousGetsTheWhole) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nG00 X10\nM02\n");
  EXPECT_FALSE(ask(session, "no such")["steps"].contains("start"));
}

TEST(Toolpath, HasWhatSurroundsTheProgram) {
  const support::TemporaryFolder folder;
  folder.write("isocnc.json", R"({"machine": {"kinematics": {"type": "three-axis"}, "home": {"z": 300}, "tools": [
    {"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat"}]}})");
  folder.write("part.setup.json", R"({"fixtures": [{"name": "clamp 1", "box": [[100, -20, 0], [140, 20, 30]]}]})");
  const std::string uri = protocol::uri_of(std::filesystem::canonical(folder.path()) / "part.iso");
  Session session;
  session.start();
  session.open(uri, "M06 T101001\nG92 X50 Y0 Z0\nG00 X0 Y0 Z10\nX200\nM02\n");
  const Json facts = session.request("isocnc/toolpath", {{"textDocument", {{"uri", uri}}}})["facts"];
  EXPECT_EQ(facts["scene"]["bodies"][0]["name"], "clamp 1");
  EXPECT_EQ(facts["scene"]["bodies"][0]["at"], Json::array({50, 0, 0}));
  EXPECT_EQ(facts["contacts"][0]["code"], "E152");
  EXPECT_EQ(facts["contacts"][0]["line"], 4);
  EXPECT_EQ(facts["certificate"]["en"].get<std::string>().substr(0, 28), "verified: 2 motions, 1 conta");
}

TEST(Toolpath, TheProgramsParameterDecides) {
  Session session;
  session.start();
  session.open(kUri, "M06 T101001\nIF VGPL = 1 GOTO N10\nG00 X10\nX20\nN10 M02\n");
  Known known[2];
  for (int vgpl : {0, 1})
    known[vgpl].take(session.request("isocnc/toolpath", {{"textDocument", {{"uri", kUri}}}, {"vgpl", vgpl}}));
  EXPECT_GT(known[0].streams[0].size(), known[1].streams[0].size());
}

}  // namespace
}  // namespace isocnc::lsp
