// What isorun leaves of a blank: in a file, for the next setup, and in a window.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kSmallShop = R"({"machine": {
    "kinematics": {"type": "three-axis"},
    "home": {"z": 300},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 5, "shape": "flat", "cutLength": 40}]}})";

/// A slot 100 mm long and 8 mm deep, at Y50.
constexpr std::string_view kFirstSide =
    "M06 T101001\nS12000 M03\nG00 X50 Y50 Z5\nG01 Z-8 F1000\nX150\nG00 Z50\nM05\nM02\n";
constexpr double kFirstSlot = (std::numbers::pi * 25 + 10 * 100) * 8;
/// A slot 60 mm long and 15 mm deep, at X100.
constexpr std::string_view kSecondSide =
    "M06 T101001\nS12000 M03\nG00 X100 Y20 Z5\nG01 Z-15 F1000\nY80\nG00 Z50\nM05\nM02\n";
constexpr double kSecondSlot = (std::numbers::pi * 25 + 10 * 60) * 15;

class StockOfRuns : public testing::Test {
 protected:
  StockOfRuns() {
    folder_.write("isocnc.json", kSmallShop);
    folder_.write("first.iso", kFirstSide);
    folder_.write("first.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
    folder_.write("second.iso", kSecondSide);
  }

  CommandResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "isorun");
    return run_command(std::move(arguments), {.folder = folder_.path()});
  }

  json verification(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--verify", "--json"});
    const CommandResult result = run(std::move(arguments));
    EXPECT_EQ(result.err, "");
    return json::parse(result.out).at("verification");
  }

  support::TemporaryFolder folder_;
};

TEST_F(StockOfRuns, IsTheBlankOfTheNextSetup) {
  const json first = verification({"--stock-out", "left.stock", "first.iso"});
  EXPECT_NEAR(first.at("removedVolume"), kFirstSlot, 0.003 * kFirstSlot);
  // Turned over about X, the slot is open below, up to Z-12.
  folder_.write("second.setup.json", R"({"stock": {"from": "left.stock", "turnedOver": true, "at": [0, 100, -20]}})");
  const json turned = verification({"second.iso"});
  const double left = first.at("remainingVolume");
  EXPECT_NEAR(turned.at("removedVolume").get<double>() + turned.at("remainingVolume").get<double>(), left, 1e-3);
  EXPECT_NEAR(turned.at("removedVolume"), kSecondSlot - 10 * 10 * 3, 0.003 * kSecondSlot);
  // As it was, the slot is open above.
  folder_.write("second.setup.json", R"({"stock": {"from": "left.stock"}})");
  EXPECT_NEAR(verification({"second.iso"}).at("removedVolume"), kSecondSlot - 10 * 10 * 8, 0.003 * kSecondSlot);
  // A quarter of a turn lays it beneath the second slot: both are at X100 now.
  folder_.write("second.setup.json", R"({"stock": {"from": "left.stock", "quarterTurns": 1, "at": [150, -50, 0]}})");
  EXPECT_NEAR(verification({"second.iso"}).at("removedVolume"), kSecondSlot - (std::numbers::pi * 25 + 10 * 60) * 8,
              0.003 * kSecondSlot);
}

TEST_F(StockOfRuns, ComesWithItsResolution) {
  ASSERT_EQ(run({"--verify", "--resolution", "0.37", "--stock-out", "left.stock", "first.iso"}).status, 0);
  folder_.write("second.setup.json", R"({"stock": {"from": "left.stock"}})");
  const json second = verification({"second.iso"});
  EXPECT_LE(second.at("resolution"), 0.37);
  EXPECT_GE(second.at("resolution"), 0.36);
}

TEST_F(StockOfRuns, IsRefusedWithItsPlaceWhereItIsNone) {
  ASSERT_EQ(run({"--stock-out", "left.stock", "first.iso"}).status, 0);
  const std::string good = text_of_file(folder_.path("left.stock"));
  folder_.write("cut.stock", good.substr(0, good.size() - 3));
  folder_.write("long.stock", good + "\n");
  std::string other = good;
  other[8] = 7;  // The version follows the first eight bytes.
  folder_.write("other.stock", other);
  std::string damaged = good;
  const std::size_t height = good.rfind(std::string("\0\0\0\xC1", 4));  // -8 mm; now a hair lower.
  ASSERT_NE(height, std::string::npos);
  damaged[height] = 1;
  folder_.write("damaged.stock", damaged);
  const auto said_of = [&](const std::string& stock) {
    folder_.write("second.setup.json", R"({"stock": )" + stock + "}");
    const CommandResult result = run({"--verify", "second.iso"});
    EXPECT_EQ(result.status, 2) << stock;
    EXPECT_THAT(result.err, StartsWith("second.setup.json:1:")) << stock;
    return result.err;
  };
  EXPECT_THAT(said_of(R"({"from": "gone.stock"})"),
              AllOf(HasSubstr("stock.from: gone.stock: cannot read"), HasSubstr("isorun --stock-out writes it")));
  EXPECT_THAT(said_of(R"({"from": "first.iso"})"), HasSubstr("first.iso is no file that isorun --stock-out"));
  EXPECT_THAT(said_of(R"({"from": "cut.stock"})"), HasSubstr("cut.stock is damaged, at byte "));
  EXPECT_THAT(said_of(R"({"from": "long.stock"})"), HasSubstr("long.stock is damaged, at byte "));
  EXPECT_THAT(said_of(R"({"from": "damaged.stock"})"), HasSubstr("damaged.stock is damaged: its check sum is wrong"));
  EXPECT_THAT(said_of(R"({"from": "other.stock"})"), HasSubstr("other.stock was written by another version"));
  EXPECT_THAT(said_of(R"({"from": "../left.stock"})"), HasSubstr("must be in the folder of this file, or below"));
  EXPECT_THAT(said_of(R"({"from": "left.stock", "mesh": "a.stl"})"), HasSubstr("there is mesh already"));
  EXPECT_THAT(said_of(R"({"box": [[0, 0, 0], [1, 1, 1]], "turnedOver": true})"), HasSubstr("it needs from"));
  EXPECT_THAT(said_of(R"({"at": [0, 0, 0]})"), HasSubstr("one of box, cylinder, mesh and from is needed"));
}

TEST_F(StockOfRuns, IsWrittenAsAClosedMesh) {
  ASSERT_EQ(run({"--stock-out", "left.stl", "first.iso"}).status, 0);
  // What isorun reads as a target has to be closed.
  folder_.write("second.setup.json", R"({"target": {"mesh": "left.stl"}})");
  EXPECT_THAT(run({"--verify", "second.iso"}).out, HasSubstr("error[E155]"));
}

TEST_F(StockOfRuns, IsSeenThroughAWindow) {
  // The middle of the slot: 40 mm of it, 10 mm wide.
  const json window = verification({"--window", "80,20,120,80", "first.iso"});
  EXPECT_NEAR(window.at("removedVolume"), 40 * 10 * 8, 1e-6);
  EXPECT_NEAR(window.at("removedVolume").get<double>() + window.at("remainingVolume").get<double>(), 40 * 60 * 20,
              1e-6);
  EXPECT_EQ(
      window.at("certificate").at("notVerified"),
      json::parse(
          R"(["the material outside X80 to X120, Y20 to Y80", "T101001 has no holder", "the spindle nose is not described"])"));
  // What is outside of the blank does not count.
  const json corner = verification({"--window", "-100,-100,20,30", "first.iso"});
  EXPECT_EQ(corner.at("removedVolume"), 0);
  EXPECT_NEAR(corner.at("remainingVolume"), 20 * 30 * 20, 1e-6);
}

/// A finding within the window is the one that the whole blank has; ways outside are no ways in the air.
TEST_F(StockOfRuns, HasTheSameFindingsInAWindow) {
  folder_.write("rapid.iso",
                "M06 T101001\nS12000 M03\nG00 X50 Y50 Z5\nG01 Z-8 F1000\nX150\nG00 X170\nG00 Z50\nM05\nM02\n");
  folder_.write("rapid.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
  const json whole = verification({"rapid.iso"}).at("contacts");
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].at("code"), "E150");
  json window = verification({"--window", "140,20,200,80", "rapid.iso"}).at("contacts");
  ASSERT_EQ(window.size(), 1U);
  EXPECT_EQ(window[0].at("line"), whole[0].at("line"));
  EXPECT_NEAR(window[0].at("time"), whole[0].at("time"), 1e-3);
  EXPECT_EQ(verification({"--window", "0,0,40,40", "rapid.iso"}).at("contacts"), json::array());
}

/// The piece in the frame comes free; seen through a window across its edge, nobody knows what holds it.
TEST_F(StockOfRuns, DoesNotCallAPieceLooseThatGoesOnOutsideTheWindow) {
  folder_.write("free.iso",
                "M06 T101001\nS12000 M03\nG00 X50 Y20 Z5\nG01 Z-20.5 F1000\nX150\nY80\nX50\nY20\nG00 Z50\nM05\nM02\n");
  folder_.write("free.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]},
      "fixtures": [{"name": "stop", "box": [[-20, 0, -20], [0, 100, 0]]}]})");
  const auto codes = [&](std::vector<std::string> options) {
    options.emplace_back("free.iso");
    std::vector<std::string> found;
    options.insert(options.begin(), {"--verify", "--json"});
    const json summary = json::parse(run(std::move(options)).out);
    for (const json& each : summary.at("findings")) found.push_back(each.at("code"));
    return found;
  };
  EXPECT_THAT(codes({}), testing::ElementsAre("W161"));
  EXPECT_THAT(codes({"--window", "-1,-1,100,101"}), testing::IsEmpty());
  EXPECT_THAT(codes({"--window", "-1,-1,180,101"}), testing::ElementsAre("W161"));
}

/// A finding leads to the line that left what is met, or that stopped the spindle.
TEST_F(StockOfRuns, IsRelatedToTheLineThatShapedIt) {
  folder_.write("rapid.iso",
                "M06 T101001\nS12000 M03\nG00 X50 Y50 Z5\nG01 Z-4 F1000\nX150\nG00 Z5\nX100\nZ-8\nZ50\nM05\n"
                "G00 X20\nG01 Z-2 F1000\nG00 Z50\nM02\n");
  folder_.write("rapid.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
  const CommandResult text = run_command({"isolint", "--verify", "rapid.iso"}, {.folder = folder_.path()});
  EXPECT_EQ(text.status, 1);
  EXPECT_THAT(text.out, AllOf(HasSubstr("error[E150]"), HasSubstr("= rapid.iso:5:1: what is met was last cut here")));
  EXPECT_THAT(text.out, AllOf(HasSubstr("error[E158]"), HasSubstr("= rapid.iso:10:1: the spindle was stopped here")));
  const CommandResult italian =
      run_command({"isolint", "--lang", "it", "--verify", "rapid.iso"}, {.folder = folder_.path()});
  EXPECT_THAT(italian.out, HasSubstr("= rapid.iso:5:1: ciò che si incontra è stato tagliato per ultimo qui"));
  EXPECT_THAT(italian.out, HasSubstr("= rapid.iso:10:1: il mandrino è stato fermato qui"));
}

/// isolint takes the resolution and the window that isorun takes, of all programs.
TEST_F(StockOfRuns, IsCutByIsolintAsByIsorun) {
  const auto isolint = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isolint");
    return run_command(std::move(options), {.folder = folder_.path()});
  };
  folder_.write("rapid.iso", "M06 T101001\nS12000 M03\nG00 X50 Y50 Z5\nZ-8\nX150\nZ50\nM05\nM02\n");
  folder_.write("rapid.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
  EXPECT_THAT(isolint({"--verify", "rapid.iso"}).out, HasSubstr("E150"));
  EXPECT_THAT(isolint({"--verify", "rapid.iso"}).err, HasSubstr("nor wider than 0.88 mm"));
  EXPECT_THAT(isolint({"--verify", "--resolution", "0.2", "rapid.iso"}).err, HasSubstr("nor wider than 0.38 mm"));
  const CommandResult beside = isolint({"--verify", "--window", "160,60,190,90", "rapid.iso", "first.iso"});
  EXPECT_EQ(beside.status, 0) << beside.out;
  EXPECT_THAT(beside.err, HasSubstr("the material outside X160 to X190"));
  // Beside the blank of one of them.
  EXPECT_EQ(isolint({"--verify", "--window", "500,0,600,100", "rapid.iso"}).status, 0);
  const CommandResult wrong = isolint({"--verify", "--resolution", "0.009", "rapid.iso"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.err, "isolint: --resolution takes a plain number of mm from 0.01 to 100, such as 0.5, not 0.009\n");
  EXPECT_EQ(isolint({"--resolution", "0.2", "rapid.iso"}).status, 2) << "without --verify";
}

TEST_F(StockOfRuns, RefusesWindowsAndResolutionsThatAreNone) {
  const auto said_of = [&](std::vector<std::string> options) {
    options.emplace_back("first.iso");
    const CommandResult result = run(std::move(options));
    EXPECT_EQ(result.status, 2) << result.err;
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  for (const char* const wrong :
       {"", "0,0,1", "0,0,1,1,1", "0,0,0,10", "10,0,0,10", "a,0,1,1", "0,0,nan,1", "0, 0, 1e3, 1"})
    EXPECT_THAT(said_of({"--verify", "--window", wrong}), StartsWith("isorun: --window takes two corners in mm"))
        << wrong;
  EXPECT_THAT(said_of({"--verify", "--window", "500,0,600,100"}),
              EndsWith("there is nothing of the stock, which reaches from X0 Y0 to X200 Y100\n"));
  for (const char* const wrong : {"0", "0.000001", "0.009", "100.1", "200", "-1", "a", "1e-1", ""})
    EXPECT_EQ(
        said_of({"--verify", "--resolution", wrong}),
        fmt::format("isorun: --resolution takes a plain number of mm from 0.01 to 100, such as 0.5, not {}\n", wrong));
  EXPECT_EQ(run({"--verify", "--resolution", "100", "first.iso"}).status, 0);
  EXPECT_EQ(said_of({"--resolution", "0.5"}),
            "isorun: --resolution goes with --verify, --stock-out or --plot FILE.html, which cut the stock\n");
  EXPECT_THAT(said_of({"--window", "0,0,9,9", "--sheet", "sheet.html"}),
              StartsWith("isorun: --window goes with --verify"));
  folder_.write("first.setup.json", R"({"stock": {"box": [[0, 0, -20], [3000, 1500, 0]]}})");
  EXPECT_THAT(said_of({"--verify", "--resolution", "0.01"}), HasSubstr("; 0.2 mm would fit"));
  EXPECT_THAT(said_of({"--stock-out", "left.obj"}), HasSubstr("ends in .stl or .stock"));
  EXPECT_THAT(said_of({"--verify", "--window", "0,0,10,10", "--stock-out", "part.stock"}),
              HasSubstr("part.stock: with --window only a part of the blank is cut"));
  folder_.write("first.setup.json", "{}");
  EXPECT_THAT(said_of({"--verify", "--window", "0,0,10,10"}), HasSubstr("--window takes a setup with a stock"));
}

/// The sheet lists what goes wrong in the stock, and the status says so.
TEST_F(StockOfRuns, IsCutForASheet) {
  folder_.write("deep.iso", "M06 T101001\nS12000 M03\nG00 X50 Y50 Z5\nZ-8\nG01 X150 F1000\nG00 Z50\nM05\nM02\n");
  folder_.write("deep.setup.json", R"({"stock": {"box": [[0, 0, -20], [200, 100, 0]]}, "resolution": 0.5})");
  EXPECT_EQ(run({"deep.iso"}).status, 0);
  const CommandResult result = run({"--sheet", "sheet.html", "deep.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[E150]"));
  EXPECT_EQ(run({"--sheet", "sheet.html", "first.iso"}).status, 0);
}

}  // namespace
}  // namespace isocnc::commands
