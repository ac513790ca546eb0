#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "lsp/protocol/uri.h"
#include "session.h"
#include "tests/support/temporary_folder.h"
#include "watched_runs.h"

/// What the editor says of the material that a program removes: by the last verification of its present text.
namespace isocnc::lsp {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kTwoCutters = R"({"machine": {
  "kinematics": {"type": "three-axis"}, "home": {"z": 300},
  "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat"},
            {"head": 1, "holder": 1, "tool": 2, "length": 100, "radius": 5, "shape": "flat"}]}})";

/// The first tool cuts the full width of the blank, 20 x 100 x 10 mm; the second one does so at X100, 4 mm deep.
const std::string kTwoSlots =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X40 Y-20\nZ-10\n"
    "G01 Y120 F2000\n"
    "G00 Z50\n"
    "M06 T101002\n"
    "S12000 M03\n"
    "G00 X100 Y-20\nZ-4\n"
    "G01 Y120 F2000\n"
    "G00 Z50\n"
    "M05\n"
    "M02\n";

class Material : public testing::Test {
 protected:
  Material() {
    folder_.write("isocnc.json", kTwoCutters);
    folder_.write("part.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
  }

  void start(const std::string& language = "en") {
    session_.start({{"workspace", {{"codeLens", {{"refreshSupport", true}}}}},
                    {"textDocument", {{"publishDiagnostics", {{"relatedInformation", true}}}}}},
                   {{"locale", language}});
  }
  void open(const std::string& text) { session_.open(uri_, text, ++version_); }
  std::string hover(int line) {
    const Json place = {{"textDocument", {{"uri", uri_}}}, {"position", {{"line", line}, {"character", 1}}}};
    return session_.request("textDocument/hover", place)["contents"]["value"].get<std::string>();
  }
  std::vector<std::string> lenses() {
    std::vector<std::string> titles;
    for (const Json& each : session_.request("textDocument/codeLens", document_params(uri_.c_str())))
      titles.push_back(session_.request("codeLens/resolve", each)["command"]["title"]);
    return titles;
  }

  const support::TemporaryFolder folder_;
  const std::string uri_ = protocol::uri_of(std::filesystem::canonical(folder_.path()) / "part.iso");
  int version_ = 0;
  WatchedRuns runs_;
  Session session_{runs_.options()};
};

TEST_F(Material, IsToldOfEachToolOnceItIsKnown) {
  start();
  runs_.hold();
  open(kTwoSlots);
  EXPECT_THAT(lenses(), ElementsAre(Not(HasSubstr("removes")), Not(HasSubstr("removes"))));
  EXPECT_THAT(hover(4), Not(HasSubstr("removes")));
  runs_.release();
  session_.wait_for("workspace/codeLens/refresh");
  EXPECT_THAT(lenses(), ElementsAre(EndsWith(", removes 20.0 cm3"), EndsWith(", removes 4.0 cm3")));
  EXPECT_THAT(hover(4), HasSubstr("removes 20 cm3, 10 mm deep, width 14.3 mm"));
  EXPECT_THAT(hover(10), HasSubstr("removes 4 cm3, 4 mm deep, width 7.1 mm"));
}

TEST_F(Material, IsToldInItalian) {
  start("it");
  open(kTwoSlots);
  session_.wait_for("workspace/codeLens/refresh");
  EXPECT_THAT(lenses(), ElementsAre(EndsWith(", asporta 20.0 cm3"), EndsWith(", asporta 4.0 cm3")));
  EXPECT_THAT(hover(4), HasSubstr("asporta 20 cm3, profondità 10 mm, larghezza 14.3 mm"));
}

TEST_F(Material, IsNotToldOfAnEditedText) {
  start();
  open(kTwoSlots);
  session_.wait_for("workspace/codeLens/refresh");
  runs_.hold();
  session_.edit(uri_, ++version_, {change(3, 0, 3, 0, " ")});
  EXPECT_THAT(hover(10), Not(HasSubstr("removes")));
  EXPECT_THAT(lenses(), ElementsAre(Not(HasSubstr("removes")), Not(HasSubstr("removes"))));
  runs_.release();
}

/// A rapid goes into what the line above has left. The relation goes along with its line, and away with it.
TEST_F(Material, LeadsToTheLineThatShapedIt) {
  start();
  open("M06 T101001\nS12000 M03\nG00 X40 Y-20\nZ-4\nG01 Y120 F2000\nG00 Z5\nY50\nZ-6\nZ50\nM05\nM02\n");
  session_.wait_for("workspace/codeLens/refresh");
  runs_.hold();
  const auto shaped_by = [&]() -> int {
    for (const Json& each : session_.diagnostics(uri_, version_)) {
      if (each.value("code", "") != "E150" || !each.contains("relatedInformation")) continue;
      for (const Json& related : each["relatedInformation"])
        if (related["message"] == "what is met was last cut here") return related["location"]["range"]["start"]["line"];
    }
    return -1;
  };
  const auto edit = [&](const Json& step) { session_.edit(uri_, ++version_, {step}); };
  edit(change(0, 0, 0, 0, "; a comment\n"));
  EXPECT_EQ(shaped_by(), 5);
  edit(change(5, 5, 5, 8, "119"));
  EXPECT_EQ(shaped_by(), -1);
  runs_.release();
}

}  // namespace
}  // namespace isocnc::lsp
