#include "interpreter/simulation/compensation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/runner.h"

namespace isocnc::simulation {
namespace {

using execution::MoveKind;
using geometry::Vec3;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::IsEmpty;

/// The events and warnings of a run with cutter compensation.
struct Done {
  std::vector<running::Event> events;
  std::vector<RunWarning> warnings;
};

timing::TimedMachine machine_with(double radius) {
  timing::TimedMachine machine;
  if (radius > 0) machine.tool_radii[{1, 1, 1}] = radius;
  return machine;
}

Done run_with(const timing::TimedMachine& machine, std::string_view program) {
  Done done;
  Compensation compensation(machine);
  const Compensation::Listeners listeners{
      .event = [&](const running::Event& event) { done.events.push_back(event); },
      .warning = [&](const RunWarning& warning) { done.warnings.push_back(warning); }};
  running::run(program, {}, [&](const running::Event& event) { compensation.take(event, listeners); });
  compensation.finish(listeners);
  return done;
}

/// Runs the program after a tool change, which is line 1. The radius is in mm.
Done compensated(std::string_view program, double radius = 5) {
  return run_with(machine_with(radius), "M06 T101001\n" + std::string(program) + "M02\n");
}

std::string shown(const running::Event& event) {
  const auto* const move = std::get_if<running::MoveEvent>(&event.what);
  const auto number = [](double value) { return dialect::format_value(std::abs(value) < 1e-6 ? 0 : value); };
  std::string text = fmt::format("{} {}", event.line + 1, running::kind_of(event));
  if (move == nullptr) return text;
  const Vec3& to = move->to.tip;
  text += fmt::format(" X{} Y{} Z{}", number(to.x()), number(to.y()), number(to.z()));
  if (move->kind != MoveKind::Arc) return text;
  const Vec3& center = move->center;
  return text + fmt::format(" about {} {} {} by {}", number(center.x()), number(center.y()), number(center.z()),
                            number(move->sweep_deg));
}

/// The events except tool change and end.
std::vector<std::string> events_of(const Done& done) {
  std::vector<std::string> texts;
  for (const running::Event& event : done.events) texts.push_back(shown(event));
  if (!texts.empty()) texts.erase(texts.begin());
  if (!texts.empty()) texts.pop_back();
  return texts;
}

std::vector<std::string> events_of(std::string_view program) { return events_of(compensated(program)); }

std::vector<std::string> warnings_of(const Done& done) {
  std::vector<std::string> texts;
  for (const RunWarning& warning : done.warnings)
    texts.push_back(fmt::format("{} {}", dialect::definition(warning.id).code, warning.line + 1));
  return texts;
}

constexpr std::string_view kOutside =
    "G00 X-20 Y-20 Z0\n"
    "G42 G01 X0 Y0 F1000\n"
    "X100\n"
    "Y100\n"
    "X0\n"
    "Y0\n"
    "G40\n"
    "G00 X-20 Y-20\n";

TEST(Compensation, GoesRoundASquareInArcs) {
  const Done done = compensated(kOutside);
  EXPECT_THAT(events_of(done),
              ElementsAre("2 rapid X-20 Y-20 Z0", "3 feed X0 Y-5 Z0", "4 feed X100 Y-5 Z0",
                          "4 arc X105 Y0 Z0 about 100 0 0 by 90", "5 feed X105 Y100 Z0",
                          "5 arc X100 Y105 Z0 about 100 100 0 by 90", "6 feed X0 Y105 Z0",
                          "6 arc X-5 Y100 Z0 about 0 100 0 by 90", "7 feed X-5 Y0 Z0", "9 rapid X-20 Y-20 Z0"));
  EXPECT_THAT(done.warnings, IsEmpty());
}

TEST(Compensation, StaysInsideASquare) {
  const Done done = compensated(
      "G00 X50 Y50\n"
      "G41 G01 X50 Y0 F1000\n"
      "X100\nY100\nX0\nY0\nX50\n"
      "G40\n"
      "G01 X50 Y50\n");
  EXPECT_THAT(events_of(done),
              ElementsAre("2 rapid X50 Y50 Z0", "3 feed X50 Y5 Z0", "4 feed X95 Y5 Z0", "5 feed X95 Y95 Z0",
                          "6 feed X5 Y95 Z0", "7 feed X5 Y5 Z0", "8 feed X50 Y5 Z0", "10 feed X50 Y50 Z0"));
  EXPECT_THAT(done.warnings, IsEmpty());
}

/// The motions of the tip on the lines after the lead-in.
struct ContourCase {
  std::string_view name;
  std::string_view program;
  std::vector<std::string> events;
};

void PrintTo(const ContourCase& each, std::ostream* out) { *out << each.name; }

class CompensatedContour : public testing::TestWithParam<ContourCase> {};

TEST_P(CompensatedContour, HasItsClosedForm) {
  const Done done = compensated(GetParam().program);
  EXPECT_THAT(events_of(done), ElementsAreArray(GetParam().events));
  EXPECT_THAT(warnings_of(done), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Contours, CompensatedContour,
    testing::Values(
        ContourCase{"CircleInside",
                    "G41 G01 X20 Y0 F1000\nG03 X20 Y0 I0 J0\nG40\n",
                    {"2 feed X15 Y0 Z0", "3 arc X15 Y0 Z0 about 0 0 0 by 360"}},
        ContourCase{"CircleOutside",
                    "G00 X50\nG42 G01 X20 Y0 F1000\nG03 X20 Y0 I0 J0\nG40\n",
                    {"2 rapid X50 Y0 Z0", "3 feed X25 Y0 Z0", "4 arc X25 Y0 Z0 about 0 0 0 by 360"}},
        ContourCase{"Helix",
                    "G41 G01 X20 Y0 F1000\nG03 X20 Y0 Z-3 I0 J0\nG40\n",
                    {"2 feed X15 Y0 Z0", "3 arc X15 Y0 Z-3 about 0 0 0 by 360"}},
        ContourCase{"TangentLineAndArc",
                    "G00 X0 Y30\nG41 G01 X0 Y0 F1000\nX40\nG03 X60 Y20 R20\nG01 Y50\nG40\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", "5 arc X55 Y20 Z0 about 40 20 0 by 90",
                     "6 feed X55 Y50 Z0"}},
        ContourCase{"LineMeetsArcInside",
                    "G00 X0 Y30\nG41 G01 X0 Y0 F1000\nX40\nG02 X60 Y20 R20\nG40\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X35.5051 Y5 Z0",
                     fmt::format("5 arc X60 Y25 Z0 about 60 0 0 by {}",
                                 dialect::format_value(-90 + std::asin(5.0 / 25) * 180 / std::numbers::pi))}},
        ContourCase{"ArcsMeetInside",
                    "G00 X-60 Y-12\nG41 G01 X-36 Y-12 F1000\nG02 X0 Y0 I-16 J-12\nG02 X36 Y-12 I16 J-12\nG40\n",
                    {"2 rapid X-60 Y-12 Z0", "3 feed X-41 Y-12 Z0",
                     fmt::format("4 arc X0 Y7.2094 Z0 about -16 -12 0 by {}",
                                 dialect::format_value(-180 + std::acos(16.0 / 25) * 180 / std::numbers::pi)),
                     fmt::format("5 arc X41 Y-12 Z0 about 16 -12 0 by {}",
                                 dialect::format_value(-180 + std::acos(16.0 / 25) * 180 / std::numbers::pi))}},
        ContourCase{"ArcsMeetOutside",
                    "G00 X-20 Y-12\nG42 G01 X-36 Y-12 F1000\nG02 X0 Y0 I-16 J-12\nG02 X36 Y-12 I16 J-12\nG40\n",
                    {"2 rapid X-20 Y-12 Z0", "3 feed X-31 Y-12 Z0",
                     fmt::format("4 arc X-4 Y-3 Z0 about -16 -12 0 by {}",
                                 dialect::format_value(-180 + std::atan2(12, 16) * 180 / std::numbers::pi)),
                     fmt::format("4 arc X4 Y-3 Z0 about 0 0 0 by {}",
                                 dialect::format_value(2 * std::atan2(4, 3) * 180 / std::numbers::pi)),
                     fmt::format("5 arc X31 Y-12 Z0 about 16 -12 0 by {}",
                                 dialect::format_value(-180 + std::atan2(12, 16) * 180 / std::numbers::pi))}},
        ContourCase{"RoundTheEndOfALine",
                    "G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nX0\nG40\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0",
                     "4 arc X40 Y-5 Z0 about 40 0 0 by -180", "5 feed X0 Y-5 Z0"}},
        ContourCase{"BackOnTheOtherSide",
                    "G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG42 G01 X0\nG40\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", "5 feed X0 Y5 Z0"}},
        ContourCase{"PlungeAndOthersBetween",
                    "G00 Y30\nG41 G01 X0 Y0 F1000\nZ-4\nM100\nX40 G09\nG04 P1\nZ-8\nY-40\nG40\nG00 Z30\nX0\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X0 Y5 Z-4", "5 m", "6 feed X40 Y5 Z-4",
                     "6 arc X45 Y0 Z-4 about 40 0 -4 by -90", "6 stop", "7 dwell", "8 feed X45 Y0 Z-8",
                     "9 feed X45 Y-40 Z-8", "11 rapid X45 Y-40 Z30", "12 rapid X0 Y-40 Z30"}},
        ContourCase{"EndsBehindTheLastMotion",
                    "G00 Y30\nG41 G01 X0 Y0 F1000\nX40 G40\nX60 Y20\n",
                    {"2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", "5 feed X60 Y20 Z0"}},
        ContourCase{"OneMotionAlone", "G41 G01 X40 F1000\nG40\nY30\n", {"2 feed X40 Y5 Z0", "4 feed X40 Y30 Z0"}},
        ContourCase{"BesideAtTheEnd", "G41 G01 X40 F1000\n", {"2 feed X40 Y5 Z0"}},
        ContourCase{"InZX",
                    "G18\nG00 X30\nG41 G01 X0 Z0 F1000\nZ50\nX-30\nG40\n",
                    {"3 rapid X30 Y0 Z0", "4 feed X5 Y0 Z0", "5 feed X5 Y0 Z50", "5 arc X0 Y0 Z55 about 0 0 50 by -90",
                     "6 feed X-30 Y0 Z55"}},
        ContourCase{"InYZ",
                    "G19\nG00 Z30\nG41 G01 Y0 Z0 F1000\nY50\nZ-30\nG40\n",
                    {"3 rapid X0 Y0 Z30", "4 feed X0 Y0 Z5", "5 feed X0 Y50 Z5", "5 arc X0 Y55 Z0 about 0 50 0 by -90",
                     "6 feed X0 Y55 Z-30"}},
        ContourCase{"IncrementalInInches",
                    "G70 G91\nG00 Y1\nG41 G01 Y-1 F100\nX1\nY-1\nG40\n",
                    {"3 rapid X0 Y25.4 Z0", "4 feed X0 Y5 Z0", "5 feed X25.4 Y5 Z0",
                     "5 arc X30.4 Y0 Z0 about 25.4 0 0 by -90", "6 feed X30.4 Y-25.4 Z0"}},
        ContourCase{
            "RapidsCutCorners",
            "G00 Y30\nG41\nG00 X0 Y0\nX40\nG01 Y-40 F1000\nG40\n",
            {"2 rapid X0 Y30 Z0", "4 rapid X0 Y5 Z0", "5 rapid X40 Y5 Z0", "5 rapid X45 Y0 Z0", "6 feed X45 Y-40 Z0"}}),
    [](const auto& each) { return std::string(each.param.name); });

/// An arc without compensation starts at the programmed point: the cutter, which stood beside the contour, moves there
/// in a straight line, over the contour's end.
TEST(Compensation, ComesBackToWhereAnArcBegins) {
  const Done done = compensated("G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG40\nG02 X60 Y0 R10\n");
  EXPECT_THAT(events_of(done), ElementsAre("2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0",
                                           "6 feed X40 Y0 Z0", "6 arc X60 Y0 Z0 about 50 0 0 by -180"));
  EXPECT_THAT(warnings_of(done), ElementsAre("W138 6"));
}

TEST(Compensation, WithoutARadiusChangesNothing) {
  const auto lengths = [](const Done& done) {
    std::vector<double> all;
    for (const running::Event& event : done.events)
      if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) all.push_back(move->length);
    return all;
  };
  EXPECT_THAT(lengths(compensated(kOutside, 0)),
              ElementsAre(std::hypot(20, 20), std::hypot(20, 20), 100, 100, 100, 100, std::hypot(20, 20)));
}

TEST(Compensation, HoldsNothingBackWhenItIsOff) {
  const timing::TimedMachine machine = machine_with(5);
  Compensation compensation(machine);
  std::size_t in = 0;
  std::size_t out = 0;
  const Compensation::Listeners listeners{.event = [&](const running::Event&) { ++out; }, .warning = {}};
  running::run("M06 T101001\nG00 X5\nG01 X9 F100\nM100\nG02 X0 Y0 R20\nM02\n", {}, [&](const running::Event& event) {
    compensation.take(event, listeners);
    EXPECT_EQ(++in, out);
  });
  EXPECT_EQ(out, 6u);
}

std::vector<Vec3> ends_of_moves(const Done& done) {
  std::vector<Vec3> ends;
  for (const running::Event& event : done.events)
    if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) ends.push_back(move->to.tip);
  return ends;
}

/// In a face frame the tip moves, relative to the face, as it does without a face frame.
TEST(Compensation, IsTheSameInEveryFace) {
  struct Face {
    std::string_view program;
    Vec3 origin;
    double b;
    double c;
  };
  const std::vector<Vec3> plain = ends_of_moves(compensated(kOutside));
  for (const Face& face : {Face{"G29 X100 Y50 Z10 B90 C30\n", {100, 50, 10}, 90, 30},
                           Face{"G29 X1 Y2 Z3 B-20 C170\n", {1, 2, 3}, -20, 170}}) {
    const std::vector<Vec3> turned =
        ends_of_moves(compensated(std::string(face.program) + std::string(kOutside) + "G27\n"));
    ASSERT_EQ(turned.size(), plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const Vec3 seen = geometry::axes_from_angles(face.b, face.c).transpose() * (turned[i] - face.origin);
      EXPECT_NEAR((seen - plain[i]).norm(), 0, 1e-9) << face.program << i;
    }
  }
}

/// The feed applies to the tool's center, so the duration equals that of the same path programmed without compensation.
TEST(Compensation, TakesTheTimeOfThePathThatTheToolGoes) {
  const auto seconds = [](double radius, std::string_view program) {
    const timing::TimedMachine machine = machine_with(radius);
    timing::Timing timing(machine, timing::TimingListeners{});
    Compensation compensation(machine);
    const Compensation::Listeners listeners{.event = [&](const running::Event& event) { timing.take(event); },
                                            .warning = {}};
    running::run("M06 T101001\n" + std::string(program) + "M02\n", {},
                 [&](const running::Event& event) { compensation.take(event, listeners); });
    compensation.finish(listeners);
    timing.finish();
    return timing.time();
  };
  EXPECT_NEAR(seconds(5, kOutside),
              seconds(0,
                      "G00 X-20 Y-20\nG01 X0 Y-5 F1000\nX100\nG03 X105 Y0 R5\nG01 Y100\nG03 X100 Y105 R5\n"
                      "G01 X0\nG03 X-5 Y100 R5\nG01 Y0\nG00 X-20 Y-20\n"),
              1e-6);
  // Inverse time applies to the motion; its corner continues at the same speed.
  EXPECT_NEAR(seconds(5, "G93\nG00 Y30\nG41 G01 X0 Y0 F2\nX100 F2\nY-100 F2\nG40\n"),
              seconds(0, "G93\nG00 Y30\nG01 Y5 F2\nX100 F2\nG94\nG02 X105 Y0 R5 F200\nG93\nG01 Y-100 F2\n"), 1e-3);
}

struct Warned {
  std::string_view program;
  std::vector<std::string> warnings;
};

TEST(Compensation, WarnsOfWhatTheCutterCannotDo) {
  const Warned kCases[] = {
      {"G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG03 X44 Y4 R4\nG01 Y40\nG40\n", {"W139 5"}},
      // The lead-in comes from the wrong side, and the lead-out crosses the contour's end.
      {"G00 Y-30\nG41 G01 X0 Y0 F1000\nX40\nG40\n", {"W138 3"}},
      {"G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG40\nG01 Y-30\n", {"W138 6"}},
      {"G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG40\nG00 Y-30\n", {}},
      {"G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG40\nG00 Z30\nG01 Y-30\n", {}},
      // A change of side crosses the contour as well.
      {"G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG42 G01 X80\nG40\n", {"W138 4"}},
      // An arc cannot be a lead-in.
      {"G41 G02 X20 Y0 R10 F1000\nG40\n", {"W138 2"}},
      {"G49\nG41 G01 X20 F1000\nX30 B5\nG40\n", {"W140 4"}},
      {"G28 X1 J1 P0.1 R1\nG41 G01 X20 F1000\nG40\nG27\n", {"W140 3"}},
  };
  for (const Warned& each : kCases) EXPECT_EQ(warnings_of(compensated(each.program)), each.warnings) << each.program;
}

TEST(Compensation, TakesAToolsOwnRadius) {
  timing::TimedMachine machine = machine_with(5);
  machine.tool_radii[{1, 2, 2}] = 8;
  const Done done = run_with(machine,
                             "M06 T101001\nG41 G01 X40 F1000\nG40\nG00 X0 Y0\nM06 T102002\nG41 G01 X40\nG40\n"
                             "G00 X0 Y0\nM06 T103003\nG41 G01 X40\nG40\nM02\n");
  EXPECT_THAT(events_of(done), ElementsAre("2 feed X40 Y5 Z0", "4 rapid X0 Y0 Z0", "5 tool", "6 feed X40 Y8 Z0",
                                           "8 rapid X0 Y0 Z0", "9 tool", "10 feed X40 Y0 Z0"));
}

/// The control continues to read when the machine has arrived (I.5, I.3.11), and the contour continues from the
/// position beside it.
TEST(Compensation, PausesWhereTheControlReadsNoFurther) {
  const std::string entry = "G00 Y30\nG41 G01 X0 Y0 F1000\nX40\n";
  for (const std::string_view stop : {"G990\n", "IF V1=1 GOTO N9\n"}) {
    const std::string kind = stop == "G990\n" ? "5 update" : "5 jump";
    const Done outside = compensated(entry + std::string(stop) + "M100\nY-40\nN9 G40\n");
    EXPECT_THAT(events_of(outside), ElementsAre("2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", kind, "6 m",
                                                "7 arc X45 Y0 Z0 about 40 0 0 by -90", "7 feed X45 Y-40 Z0"));
    EXPECT_THAT(outside.warnings, IsEmpty());
    const Done inside = compensated(entry + std::string(stop) + "Y40\nN9 G40\n");
    EXPECT_THAT(events_of(inside), ElementsAre("2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", kind,
                                               "6 feed X35 Y0 Z0", "6 feed X35 Y40 Z0"));
    EXPECT_THAT(warnings_of(inside), testing::Contains("W138 4"));
  }
  // The same holds on the lead-in.
  EXPECT_THAT(events_of("G00 Y30\nG41 G01 X0 Y0 F1000\nG990\nX40\nG40\n"),
              ElementsAre("2 rapid X0 Y30 Z0", "3 feed X5 Y0 Z0", "4 update", "5 feed X0 Y5 Z0", "5 feed X40 Y5 Z0"));
}

/// A change of plane, tool or frame ends the contour at that point; the next motion is the lead-in of the next contour.
TEST(Compensation, BeginsAnewInAnotherPlane) {
  EXPECT_THAT(events_of("G00 Y30\nG41 G01 X0 Y0 F1000\nX40\nG18\nX80\nZ-50\nG40\n"),
              ElementsAre("2 rapid X0 Y30 Z0", "3 feed X0 Y5 Z0", "4 feed X40 Y5 Z0", "6 feed X75 Y0 Z0",
                          "7 feed X75 Y0 Z-50"));
}

TEST(Compensation, LetsAnyNumberOfBlocksStandBetween) {
  std::string program = "G00 Y30\nG41 G01 X0 Y0 F1000\nX40\n";
  for (int i = 0; i < 3000; ++i) program += "M100\n";
  const Done done = compensated(program + "X80\nY-40\nG40\n");
  std::size_t functions = 0;
  for (const running::Event& event : done.events)
    functions += std::holds_alternative<running::FunctionEvent>(event.what) ? 1 : 0;
  EXPECT_EQ(functions, 3000u);
  EXPECT_THAT(done.warnings, IsEmpty());
  const std::vector<std::string> events = events_of(done);
  EXPECT_THAT(std::vector<std::string>(events.end() - 3, events.end()),
              ElementsAre("3005 feed X80 Y5 Z0", "3005 arc X85 Y0 Z0 about 80 0 0 by -90", "3006 feed X85 Y-40 Z0"));
}

TEST(Compensation, IsAValue) {
  const timing::TimedMachine machine = machine_with(5);
  Compensation first(machine);
  std::vector<std::string> ends;
  std::vector<std::string> continues;
  const auto into = [](std::vector<std::string>& texts) {
    return Compensation::Listeners{.event = [&](const running::Event& event) { texts.push_back(shown(event)); },
                                   .warning = {}};
  };
  std::vector<running::Event> events;
  running::run("M06 T101001\nG00 Y30\nG41 G01 X0 Y0 F1000\nX40\nY-40\nM02\n", {},
               [&](const running::Event& event) { events.push_back(event); });
  for (std::size_t i = 0; i < 4; ++i) first.take(events[i], into(ends));
  Compensation second = first;
  first.finish(into(ends));
  EXPECT_EQ(ends.back(), "4 feed X40 Y5 Z0");
  for (std::size_t i = 4; i < events.size(); ++i) second.take(events[i], into(continues));
  second.finish(into(continues));
  EXPECT_THAT(continues,
              ElementsAre("4 feed X40 Y5 Z0", "4 arc X45 Y0 Z0 about 40 0 0 by -90", "5 feed X45 Y-40 Z0", "6 end"));
}

}  // namespace
}  // namespace isocnc::simulation
