#include "interpreter/configuration/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "examples.h"
#include "interpreter/configuration/show.h"
#include "tests/support/random.h"

namespace isocnc::configuration {
namespace {

using dialect::Language;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string mistakes_of(std::string_view text, Language language = Language::English) {
  std::string said;
  for (const Mistake& mistake : read_configuration(text, "/").mistakes) {
    const LineColumn place = place_of(mistake.at, text);
    said += fmt::format("{}{}:{}: {}", said.empty() ? "" : "\n", place.line, place.column, mistake.message(language));
  }
  return said;
}

Configuration read(std::string_view text) {
  ReadConfiguration result = read_configuration(text, "/parts");
  EXPECT_THAT(result.mistakes, IsEmpty()) << text;
  return std::move(result.configuration);
}

TEST(ReadConfiguration, ReportsEachMistakeWithItsPlace) {
  for (const WrongText& wrong : kWrongTexts) EXPECT_EQ(mistakes_of(wrong.text), wrong.said) << wrong.text;
}

TEST(ReadConfiguration, ReportsMistakesInItalianToo) {
  for (const WrongText& wrong : kWrongTexts) {
    const std::string italian = mistakes_of(wrong.text, Language::Italian);
    EXPECT_NE(italian, wrong.said) << wrong.text;
    EXPECT_EQ(italian.substr(0, 4), wrong.said.substr(0, 4)) << wrong.text;
  }
  EXPECT_EQ(mistakes_of(R"({"machine": {"maxfeed": 1}})", Language::Italian),
            "1:14: machine.maxfeed: chiave sconosciuta; forse maxFeed?");
  EXPECT_EQ(mistakes_of(R"({"machine": {"maxFeed": true}})", Language::Italian),
            "1:25: machine.maxFeed: questo è true o false; ci vuole un numero");
}

TEST(ReadConfiguration, FindsNothingWrongWithWhatIsRight) {
  for (const std::string_view text : kRightTexts) EXPECT_EQ(mistakes_of(text), "") << text;
}

TEST(ReadConfiguration, IsReadAgainFromWhatIsShown) {
  for (const std::string_view text : kRightTexts) {
    const std::string shown = to_json(read(text));
    EXPECT_EQ(mistakes_of(shown), "") << shown;
    EXPECT_EQ(to_json(read(shown)), shown);
  }
}

TEST(ReadConfiguration, CountsColumnsInCodePoints) {
  EXPECT_EQ(mistakes_of("{\"machine\": {/* à */ \"u\": 1}}"), "1:22: machine.u: unknown key");
  EXPECT_EQ(mistakes_of("{\r\"u\": 1,\r\n\"v\": 2}"), "2:1: u: unknown key\n3:1: v: unknown key");
}

TEST(ReadConfiguration, LeavesTheSetupOpenWhereTheFileIsSilent) {
  const execution::Setup setup = read("{}").machine.setup;
  EXPECT_EQ(setup.home, geometry::Pose());
  EXPECT_EQ(setup.arc_tolerance, execution::Setup().arc_tolerance);
  EXPECT_FALSE(setup.tools || setup.functions || setup.clearance);
  EXPECT_EQ(setup.limits.feed, execution::Limits().feed);
}

TEST(ReadConfiguration, FillsTheSetup) {
  const Configuration configuration = read(R"({"machine": {
    "home": {"x": 1, "y": 2, "z": 3, "b": 4, "c": 5},
    "axes": {"X": {"min": -1, "max": 1}, "Y": {"min": -2}, "Z": {"max": 3}, "B": {"min": -4}, "C": {"max": 5}},
    "rapidMotion": "independent", "maxFeed": 6, "maxRotarySpeed": 7, "maxSpindleSpeed": 8, "tolerances": {"arc": 0.5}, "clearance": -9,
    "tools": [{"head": 1, "holder": 2, "tool": 3, "name": "cutter", "length": 80.5, "radius": 4}],
    "functions": {"M07": {"name": "air"}, "M100": {}}}})");
  const MachineConfiguration& machine = configuration.machine;
  const execution::Setup& setup = machine.setup;
  EXPECT_EQ(machine.timed.motion.rapid_motion, kinematics::RapidMotion::Independent);
  EXPECT_EQ(setup.home.tip, geometry::Vec3(1, 2, 3));
  EXPECT_EQ(setup.home.b, 4);
  EXPECT_EQ(setup.home.c, 5);
  EXPECT_EQ(setup.limits.travel[0].minimum, -1);
  EXPECT_EQ(setup.limits.travel[0].maximum, 1);
  EXPECT_EQ(setup.limits.travel[1].minimum, -2);
  EXPECT_EQ(setup.limits.travel[1].maximum, execution::Travel().maximum);
  EXPECT_EQ(setup.limits.travel[2].maximum, 3);
  EXPECT_EQ(setup.limits.travel[3].minimum, -4);
  EXPECT_EQ(setup.limits.travel[4].maximum, 5);
  EXPECT_EQ(setup.limits.feed, 6);
  EXPECT_EQ(setup.limits.rotary_speed, 7);
  EXPECT_EQ(setup.limits.spindle_speed, 8);
  EXPECT_EQ(setup.arc_tolerance, 0.5);
  EXPECT_EQ(setup.clearance, -9);
  ASSERT_TRUE(setup.tools);
  EXPECT_THAT(*setup.tools, ElementsAre(execution::ToolCode{1, 2, 3}));
  ASSERT_TRUE(setup.functions);
  EXPECT_THAT(*setup.functions, ElementsAre(7, 100));
  EXPECT_EQ(machine.tools->front().name, "cutter");
  EXPECT_EQ(machine.tools->front().length, 80.5);
  EXPECT_EQ(machine.tools->front().radius, 4);
  EXPECT_EQ(machine.functions->front().name, "air");
}

TEST(ReadConfiguration, DistinguishesAnEmptyListFromNone) {
  const execution::Setup setup = read(R"({"machine": {"tools": [], "functions": {}}})").machine.setup;
  ASSERT_TRUE(setup.tools);
  ASSERT_TRUE(setup.functions);
  EXPECT_THAT(*setup.tools, IsEmpty());
  EXPECT_THAT(*setup.functions, IsEmpty());
}

/// The files that users take are the machines that all is tested on.
TEST(ReadConfiguration, ReadsTheProfilesThatShip) {
  const std::pair<std::string, kinematics::Machine> profiles[] = {{"three-axis", kinematics::three_axis_router()},
                                                                  {"head", kinematics::head_router()},
                                                                  {"table", kinematics::table_router()}};
  for (const auto& [name, wanted] : profiles) {
    const std::filesystem::path file =
        std::filesystem::path(ISOCNC_SOURCE_DIR) / "examples/machines" / (name + ".json");
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    const timing::TimedMachine machine = read(text.str()).machine.timed;
    for (std::size_t axis = 0; axis < wanted.axes.size(); ++axis) {
      const kinematics::AxisLimits& limits = machine.motion.axes[axis];
      EXPECT_EQ(limits.minimum, wanted.axes[axis].minimum) << name << ' ' << axis;
      EXPECT_EQ(limits.maximum, wanted.axes[axis].maximum) << name << ' ' << axis;
      EXPECT_NEAR(limits.speed, wanted.axes[axis].speed, 1e-9) << name << ' ' << axis;
      EXPECT_EQ(limits.acceleration, wanted.axes[axis].acceleration) << name << ' ' << axis;
      EXPECT_FALSE(limits.jerk) << name << ' ' << axis;
    }
    EXPECT_EQ(machine.motion.kinematics.kind, wanted.kinematics.kind) << name;
    const bool has_pivot = wanted.kinematics.kind == kinematics::MachineKind::Head;
    EXPECT_EQ(has_pivot ? machine.motion.kinematics.pivot : 0, wanted.kinematics.pivot) << name;
    EXPECT_EQ(machine.motion.kinematics.b_point, wanted.kinematics.b_point) << name;
    EXPECT_EQ(machine.motion.kinematics.c_point, wanted.kinematics.c_point) << name;
    EXPECT_EQ(machine.motion.chord_tolerance, wanted.chord_tolerance) << name;
    EXPECT_EQ(machine.motion.corner_tolerance, wanted.corner_tolerance) << name;
    EXPECT_EQ(machine.home.tip.z(), wanted.axes[kinematics::kZ].maximum) << name << " begins with the spindle up";
  }
}

TEST(ReadConfiguration, StopsAtAHundredMistakes) {
  std::string text = "{";
  for (int i = 0; i < 5000; ++i) text += fmt::format("\"key{}\": [[[]]],\n", i);
  EXPECT_EQ(read_configuration(text + "\"end\": 1}", "/").mistakes.size(), 100u);
}

TEST(ReadConfiguration, RefusesAbsurdNesting) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(mistakes_of("{\"lint\": " + deep), "1:41: nested too deeply");
  EXPECT_EQ(mistakes_of("{\"lint\": " + deep + std::string(deep.size(), ']') + "}"), "1:41: nested too deeply");
}

TEST(ReadConfigurationProperty, AnyTextIsReadOrRefusedWithinItself) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    support::Random random(seed);
    std::string text(kRightTexts[random.below(std::size(kRightTexts))]);
    for (int edit = 0; edit < 4; ++edit)
      text.replace(random.below(text.size() + 1), random.below(3), random.below(2),
                   random.any_of("{}[]\",:/*\\ \n\r\t0-1.eEtnu\x01\xC3\xA8"));
    const ReadConfiguration read = read_configuration(text, "/");
    for (const Mistake& mistake : read.mistakes) {
      EXPECT_LE(mistake.at, text.size()) << seed << ": " << text;
      EXPECT_FALSE(mistake.message(Language::English).empty()) << seed << ": " << text;
    }
    EXPECT_TRUE(nlohmann::json::accept(text, true) || !read.mistakes.empty()) << seed << ": " << text;
  }
}

TEST(ReadConfiguration, ShortensWhatItRepeats) {
  const std::string said = mistakes_of("{\"" + std::string(100'000, 'x') + "\": 1}");
  EXPECT_LT(said.size(), 120u);
  EXPECT_THAT(said, HasSubstr("xxx...: unknown key"));
}

}  // namespace
}  // namespace isocnc::configuration
