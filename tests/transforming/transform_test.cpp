#include "analyzer/transforming/transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace isocnc::transforming {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const Transformation kMirrorX{Movement::MirrorX, {400, 0, 0}};
const Transformation kMirrorY{Movement::MirrorY, {0, 100, 0}};
const Transformation kTurn{Movement::Rotate, {0, 0, 0}, 90};
const Transformation kSlant{Movement::Rotate, {100, 50, 0}, 30};
const Transformation kHalfTurn{Movement::Rotate, {0, 0, 0}, 180};
const Transformation kShift{Movement::Shift, {100, -50.5, 2}};
const Transformation kSlower{.feed_factor = 0.8};

constexpr std::string_view kHead = "M06 T101001\nF1000\n";
constexpr std::string_view kEnd = "M02\n";

std::variant<std::string, TransformationRefusal> transformed(std::string_view program, const Transformation& how) {
  return transform(program, how, {}, dialect::Language::English);
}

struct TransformCase {
  std::string_view name;
  Transformation how;
  std::string_view before;  ///< Between kHead and kEnd.
  std::string_view after;
};

void PrintTo(const TransformCase& each, std::ostream* out) { *out << each.name; }

class TransformedLines : public testing::TestWithParam<TransformCase> {};

TEST_P(TransformedLines, AreWrittenSo) {
  const auto whole = [](std::string_view lines) { return std::string(kHead) + std::string(lines) + std::string(kEnd); };
  const std::string program = whole(GetParam().before);
  const auto result = transformed(program, GetParam().how);
  if (const auto* refusal = std::get_if<TransformationRefusal>(&result))
    FAIL() << refusal->message(dialect::Language::English);
  EXPECT_EQ(std::get<std::string>(result), whole(GetParam().after));
}

const TransformCase kCases[] = {
    {"Coordinates", kMirrorX, "G00 X100 Y20.5 Z5 ; X1\n", "G00 X700 Y20.5 Z5 ; X1\n"},
    {"DecimalsStay", kMirrorX, "G00 X100.500 Y+2 Z5\nG01 X+10.5 Y3\n", "G00 X699.500 Y+2 Z5\nG01 X+789.5 Y3\n"},
    {"TheLayoutStays", kMirrorX, "  g0 x - 1 . 5 (edge)y2  Z5\n", "  g0 x801.5 (edge)y2  Z5\n"},
    {"CommentsInsideAWordStay", kMirrorX, "G0 X1(a)0 Y0 Z0\n", "G0 X790 (a) Y0 Z0\n"},
    {"OnlyWhatIsMirroredChanges", kMirrorX, "G00 X1 Y1 Z1\nY2\nZ4 ; up\nG04 P1\nS100 M03\n",
     "G00 X799 Y1 Z1\nY2\nZ4 ; up\nG04 P1\nS100 M03\n"},
    {"Arcs", kMirrorX, "G00 X0 Y0 Z5\nG02 X10 Y10 I10 J0\nG3 X0 Y0 R10.0\n",
     "G00 X800 Y0 Z5\nG03 X790 Y10 I790 J0\nG2 X800 Y0 R10.0\n"},
    {"OneCenterCoordinate", kMirrorX, "G00 X0 Y0 Z5\nG02 X10 Y10 I10\nX20 Y0 J0\n",
     "G00 X800 Y0 Z5\nG03 X790 Y10 I790\nX780 Y0 J0\n"},
    {"FullTurns", kMirrorY, "G00 X0 Y0 Z5\nG002 Y0 I10 J0\n", "G00 X0 Y200 Z5\nG003 Y200 I10 J200\n"},
    {"ArcsInPlanesAcross", kMirrorX, "G00 X0 Y0 Z0\nG18 G02 X10 Z10 R10\nG19 G02 Y10 Z20 R10\n",
     "G00 X800 Y0 Z0\nG18 G03 X790 Z10 R10\nG19 G02 Y10 Z20 R10\n"},
    {"AGThatCannotContinueIsWritten", kMirrorX,
     "G00 X0 Y0 Z0\nG02 X10 Y10 R10\nG19\nY20 Z10 R10\n  Y30 Z0 R10\nG17\nX20Y40R10\n",
     "G00 X800 Y0 Z0\nG03 X790 Y10 R10\nG19\nG02 Y20 Z10 R10\n  Y30 Z0 R10\nG17\nG03X780Y40R10\n"},
    {"Sides", kMirrorX, "G00 X0 Y0 Z0\nG41 G01 X10 Y10\nX50\nG40\nG42\nX90\nY9\nG40 ; G42\n",
     "G00 X800 Y0 Z0\nG42 G01 X790 Y10\nX750\nG40\nG41\nX710\nY9\nG40 ; G42\n"},
    {"SidesInAPlaneAcross", kMirrorX, "G00 X0 Y0 Z0\nG19\nG41\nG01 Y10\nZ50\nG40\n",
     "G00 X800 Y0 Z0\nG19\nG41\nG01 Y10\nZ50\nG40\n"},
    {"Increments", kMirrorX, "G00 X0 Y0 Z5\nG91 G01 X10.50 Y1\nX-3\nG02 X10 Y10 I10 J0\nG01 X0 Y0\nG90\n",
     "G00 X800 Y0 Z5\nG91 G01 X-10.50 Y1\nX3\nG03 X-10 Y10 I-10 J0\nG01 X0 Y0\nG90\n"},
    {"IncrementsFromHome", kShift, "G91 G00 X10 Y0 Z-3\nG01 X5\n", "G91 G00 X110 Y-50.5 Z-1\nG01 X5\n"},
    {"RotaryAxes", kMirrorX, "G00 X0 Y0 Z5 B30 C-45.5\nG49\nG01 X1 B0 C10\nG48\n",
     "G00 X800 Y0 Z5 B-30 C45.5\nG49\nG01 X799 B0 C-10\nG48\n"},
    {"RotaryAxesAcross", kMirrorY, "G00 X0 Y0 Z5 B30 C-45.5\nG49\nG01 X1 B0 C10\nG48\n",
     "G00 X0 Y200 Z5 B30 C45.5\nG49\nG01 X1 B0 C-10\nG48\n"},
    {"TheWorkpieceFrameStays", kMirrorX, "G92 X50 Y60\nG00 X100 Y20 Z5\n", "G92 X50 Y60\nG00 X700 Y20 Z5\n"},
    {"PlacesOfTheMachineStay", kMirrorX, "G00 Z0\nG92 X50 Y60\nG00 X100 Y20 Z5\nG92 X0 Y0 Z0\nG00 X0 Y0\n",
     "G00 Z0\nG92 X50 Y60\nG00 X700 Y20 Z5\nG92 X0 Y0 Z0\nG00 X0 Y0\n"},
    {"WithoutAFrameTheMachineIsTheWorkpiece", kMirrorX, "G92 X0 Y0 Z0\nG00 X0 Y0 Z5\n",
     "G92 X0 Y0 Z0\nG00 X800 Y0 Z5\n"},
    {"FacesByAngles", kMirrorX, "G00 X0 Y0 Z5\nG29 X10 Z-3 B90 C-30\nG00 X1 Y2 Z3\nG02 X11 Y12 I11 J2\nG27\n",
     "G00 X800 Y0 Z5\nG29 X790 Z-3 B-90 C30\nG00 X-1 Y2 Z3\nG03 X-11 Y12 I-11 J2\nG27\n"},
    {"FacesWithoutAnX", kMirrorX, "G00 X0 Y0 Z5\nG29 B90\nG00 X1 Y2 Z3\nG27\n",
     "G00 X800 Y0 Z5\nG29 X800 B-90\nG00 X-1 Y2 Z3\nG27\n"},
    {"FacesByAnglesAcross", kMirrorY, "G00 X0 Y0 Z5\nG29 X10 B90 C-30\nG00 X1 Y2 Z3\nG27\n",
     "G00 X0 Y200 Z5\nG29 X10 Y200 B90 C30\nG00 X1 Y-2 Z3\nG27\n"},
    {"FacesByAxes", kMirrorX, "G00 X0 Y0 Z5\nG24 X10 Y5 A0.6 B0.8 I-0.8 J0.6 R1\nG00 X1 Y2 Z3\nG27\n",
     "G00 X800 Y0 Z5\nG24 X790 Y5 A0.6 B-0.8 I0.8 J0.6 R1\nG00 X-1 Y2 Z3\nG27\n"},
    {"FacesAtTheTip", kMirrorY, "G00 X0 Y0 Z5\nG28 X0.6 Y0.8 I-0.8 J0.6 R1\nG00 X1 Y2 Z3\nG27\n",
     "G00 X0 Y200 Z5\nG28 X0.6 Y-0.8 I0.8 J0.6 R1\nG00 X1 Y-2 Z3\nG27\n"},
    {"Inches", kMirrorX, "G70 G00 X1 Y0 Z5\nG91 G01 X0.5\nG71\n", "G70 G00 X30.496063 Y0 Z5\nG91 G01 X-0.5\nG71\n"},
    {"AxesThatWereNotGiven", kMirrorX, "G00 Z50\nY10\nG00 X10 Y20\nG01 Z-5\n", "G00 Z50\nY10\nG00 X790 Y20\nG01 Z-5\n"},

    {"QuarterTurns", kTurn, "G00 X10.50 Y20 Z5\nG01 X30\nY7\nX1Y2\nZ2\n",
     "G00 X-20.00 Y10.5 Z5\nG01 Y30\nX-7\nX-2Y1\nZ2\n"},
    {"QuarterTurnsOfArcs", kTurn, "G00 X0 Y0 Z5\nG02 X10 Y10 I10 J0\nG03 X20 Y0 I20\nX30 J0\n",
     "G00 X0 Y0 Z5\nG02 X-10 Y10 I0 J10\nG03 X0 Y20 J20\nY30 I0\n"},
    {"QuarterTurnsOfC", kTurn, "G00 X0 Y0 Z5 B30 C-45\nG91 C10\nG90 B0\n", "G00 X0 Y0 Z5 B30 C45\nG91 C10\nG90 B0\n"},
    {"TheCOfHomeIsWritten", kTurn, "G00 X0 Y0 Z5\nG00 B30\nG01 X5\n", "G00 X0 Y0 Z5\nG00 B30 C90\nG01 Y5\n"},
    {"FacesTurn", kTurn, "G00 X0 Y0 Z5\nG29 X10 Z-3 B90 C100\nG00 X1 Y2 Z3\nG27\n",
     "G00 X0 Y0 Z5\nG29 X0 Z-3 Y10 B90 C-170\nG00 X1 Y2 Z3\nG27\n"},
    {"FacesByAxesTurn", kTurn, "G00 X0 Y0 Z5\nG28 X1 J1 R1\nG00 X1 Y2 Z3\nG27\n",
     "G00 X0 Y0 Z5\nG28 X0 Y1 J0 I-1 R1\nG00 X1 Y2 Z3\nG27\n"},
    {"Slants", kSlant, "G00 X100 Y50 Z5\nG01 X200\nY60 F500\nG02 X210 Y70 R10\n",
     "G00 X100 Y50 Z5\nG01 X186.60254 Y100\nY108.66025 X181.60254 F500\nG02 X185.26279 Y122.32051 R10\n"},
    {"SlantsOfHalfTurnsByRadius", kSlant, "G00 X100 Y50 Z5\nG02 X200 Y50 R50\n",
     "G00 X100 Y50 Z5\nG02 X186.60254 Y100 I143.30127 J75\n"},
    {"SlantsOfIncrementsDoNotDrift", kSlant, "G00 X100 Y50 Z5\nG91\nG01 X1\nX1\nX1\nX-3\nG90\n",
     "G00 X100 Y50 Z5\nG91\nG01 X0.86603 Y0.5\nX0.86602 Y0.5\nX0.86603 Y0.5\nX-2.59808 Y-1.5\nG90\n"},
    {"HalfTurnsInPlanesAcross", kHalfTurn, "G00 X0 Y0 Z0\nG18 G02 X10 Z10 R10\n",
     "G00 X0 Y0 Z0\nG18 G03 X-10 Z10 R10\n"},

    {"Shifts", kShift, "G00 X10 Y0 Z5\nG03 X20 Y10 I10 J10\nG29 B90\nG00 X1 Y2 Z3\nG27\nG00 Z50\n",
     "G00 X110 Y-50.5 Z7\nG03 X120 Y-40.5 I110 J-40.5\nG29 X100 Y-50.5 Z2 B90\nG00 X1 Y2 Z3\nG27\nG00 Z52\n"},

    {"WhatNoPathReaches", kMirrorX, "G00 X1 Y0 Z0\nV1 = 2\nIF V1 = 2 GOTO N5\nG00 X2\nN5 X3\n",
     "G00 X799 Y0 Z0\nV1 = 2\nIF V1 = 2 GOTO N5\nG00 X2\nN5 X797\n"},
    {"AllPaths", kMirrorX, "G00 X1 Y0 Z0\nIF VGPL = 2 GOTO N5\nG00 X2\nN5 X3\n",
     "G00 X799 Y0 Z0\nIF VGPL = 2 GOTO N5\nG00 X798\nN5 X797\n"},
};

INSTANTIATE_TEST_SUITE_P(Transform, TransformedLines, testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.name); });

struct RefusalCase {
  std::string_view name;
  Transformation how;
  std::string_view program;
  std::size_t line;  ///< From 1.
  TransformObstacle obstacle;
  std::string_view message;
};

void PrintTo(const RefusalCase& each, std::ostream* out) { *out << each.name; }

class Refusals : public testing::TestWithParam<RefusalCase> {};

TEST_P(Refusals, NameTheirLine) {
  const auto result = transformed(GetParam().program, GetParam().how);
  ASSERT_TRUE(std::holds_alternative<TransformationRefusal>(result)) << std::get<std::string>(result);
  const auto& refusal = std::get<TransformationRefusal>(result);
  EXPECT_EQ(refusal.line + 1, GetParam().line);
  EXPECT_EQ(refusal.obstacle, GetParam().obstacle);
  EXPECT_THAT(refusal.message(dialect::Language::English), HasSubstr(GetParam().message));
  EXPECT_THAT(refusal.message(dialect::Language::Italian),
              StartsWith("riga " + std::to_string(GetParam().line) + ": "));
}

const RefusalCase kRefusals[] = {
    {"AnError", kMirrorX, "M06 T101001\nG00 X1\nG01 X2\nM02\n", 3, TransformObstacle::ProgramError, "ISO066"},
    {"AMotionWithoutArguments", kShift, "M06 T101001\nG00 X0 Y0 Z5\nG00 G02 X5 Y5 R3\nM02\n", 3,
     TransformObstacle::ProgramError, "ISO0"},
    {"NoEnd", kMirrorX, "M06 T101001\nG00 X1\n", 2, TransformObstacle::ProgramError, "ISO045"},
    {"TwoPaths", kMirrorX, "M06 T101001\nG00 X1 Y0 Z0\nIF VGPL = 1 GOTO N5\nG91\nN5 G00 X3\nG90\nM02\n", 5,
     TransformObstacle::OnTwoPaths, "two paths"},
    {"FeedsInTheMachine", kMirrorX, "M06 T101001\nG92 X5\nG00 X0 Y0 Z0\nG92 X0\nG00 X0\nG01 X5 F100\nM02\n", 6,
     TransformObstacle::FeedInMachine, "G92 X0 Y0 Z0"},
    {"AnArcOutOfItsPlane", kTurn, "M06 T101001\nG00 X0 Y0 Z0\nG18\nG02 X10 Z10 R10 F100\nM02\n", 4,
     TransformObstacle::PlaneRotated, "G18 or G19"},
    {"ASideOutOfItsPlane", kTurn, "M06 T101001\nG00 X0 Y0 Z0\nG18\nG41\nG01 X10 F100\nZ9\nG40\nM02\n", 5,
     TransformObstacle::SideDiffers, "G41 or G42"},
    {"AFeedMoveFromHome", kMirrorX, "M06 T101001\nG00 Y5 Z0\nG01 Y9 F100\nM02\n", 3, TransformObstacle::StartUnknown,
     "a place that the program has not given"},
    {"ATiltedToolWhoseCIsThatOfHome", kTurn,
     "M06 T101001\nG92 X5\nG92 X0\nG00 B30\nG92 X5\nG00 X0 Y0 Z0\nG01 X1 F100\nM02\n", 7,
     TransformObstacle::StartUnknown, "a place that the program has not given"},
    {"AnIfRepeated",
     {.movement = Movement::Repeat, .place = {50, 30, 0}, .columns = 2, .rows = 2},
     "M06 T101001\nIF VGPL = 1 GOTO N5\nN5 M02\n",
     2,
     TransformObstacle::JumpRepeated,
     "IF"},
    {"AnErrorRepeated",
     {.movement = Movement::Repeat, .place = {50, 30, 0}, .columns = 2, .rows = 2},
     "M06 T101001\nG00 X1.2.3\nM02\n",
     2,
     TransformObstacle::ProgramError,
     "ISO"},
    {"AFaceAtHome", kMirrorX, "M06 T101001\nG00 Z0\nG28 X1 J1 R1\nG27\nM02\n", 3, TransformObstacle::FaceUnknown,
     "the face"},
};

INSTANTIATE_TEST_SUITE_P(Transform, Refusals, testing::ValuesIn(kRefusals),
                         [](const auto& each) { return std::string(each.param.name); });

const Transformation kTwice{.movement = Movement::Repeat, .place = {50, 30, 0}, .columns = 2, .rows = 1};

TEST(Transform, RepeatsWithTheModesOfTheStart) {
  EXPECT_EQ(std::get<std::string>(transformed(
                "N1 M06 T101001\r\nG92 X5 Y6 Z7\r\nG00 X1 Y2 Z0\r\nG91 G01 X3 F100\r\nG70\r\nM02\r\nrest", kTwice)),
            "N1 M06 T101001\r\nG92 X5 Y6 Z7\r\nG00 X1 Y2 Z0\r\nG91 G01 X3 F100\r\nG70\r\n(copy 2 of 2: X+50 "
            "Y+0)\r\nG71\r\nG90\r\n"
            "G92 X0 Y0 Z0\r\nN1 M06 T101001\r\nG92 X5 Y6 Z7\r\nG00 X51 Y2 Z0\r\nG91 G01 X3 F100\r\nG70\r\nM02\r\nrest");
  Transformation rows = kTwice;
  rows.columns = 1;
  rows.rows = 3;
  rows.feed_factor = 0.5;
  EXPECT_EQ(std::get<std::string>(transformed("M06 T101001\nG00 X1 Y2 Z0\nG01 X3 F100\nM02\n", rows)),
            "M06 T101001\nG00 X1 Y2 Z0\nG01 X3 F50\n(copy 2 of 3: X+0 Y+30)\nM06 T101001\nG00 X1 Y32 Z0\nG01 X3 F50\n"
            "(copy 3 of 3: X+0 Y+60)\nM06 T101001\nG00 X1 Y62 Z0\nG01 X3 F50\nM02\n");
}

TEST(Transform, DoesNotRepeatWhatEndsElsewhereThanItBegins) {
  // The second copy would begin with B where the first one has left it.
  const auto result = transformed("M06 T101001\nG00 X1 Y2 Z0\nG49\nG01 X3 F100\nB10\nG48\nM02\n", kTwice);
  ASSERT_TRUE(std::holds_alternative<TransformationRefusal>(result)) << std::get<std::string>(result);
  EXPECT_EQ(std::get<TransformationRefusal>(result).obstacle, TransformObstacle::CopyStartsLow);
  EXPECT_EQ(std::get<TransformationRefusal>(result).line, 1U);
}

/// The first rapid of a copy comes from where the copy before it ends, not from home.
TEST(Transform, RepeatsOnlyWhatEndsAtItsHighestZ) {
  const auto repeated = [](const std::string& first, const std::string& last) {
    return transformed(
        "M06 T101001\nG92 X100 Y50 Z-10\n" + first + "\nG00 X5 Y5\nZ5\nG01 Z-5 F500\nX30 Y20\n" + last + "\nM02\n",
        kTwice);
  };
  for (const auto& [first, last] : {std::pair("G00 X20 Y0", "G01 X31"),
                                    {"G00 X20 Y0", "G00 Z2"},
                                    {"G00 X20 Y0 Z30", "G00 Z5"},
                                    {"G00 X20 Y0 Z30", "G00 Z30 B5"}}) {
    const auto result = repeated(first, last);
    ASSERT_TRUE(std::holds_alternative<TransformationRefusal>(result)) << std::get<std::string>(result);
    EXPECT_EQ(std::get<TransformationRefusal>(result).obstacle, TransformObstacle::CopyStartsLow) << first << last;
    EXPECT_EQ(std::get<TransformationRefusal>(result).line, 2U);
  }
  for (const auto& [first, last] : {std::pair("G00 X20 Y0", "G00 Z5"),
                                    {"G00 Z30", "G00 Z20"},
                                    {"G00 X20 Y0 Z30 B0", "G00 Z30 B5"},
                                    {"G00 X20 Y0 Z30", "G00 X0 Z30"}})
    EXPECT_TRUE(std::holds_alternative<std::string>(repeated(first, last))) << first << last;
}

TEST(Transform, ScalesFeeds) {
  EXPECT_EQ(std::get<std::string>(transformed("M06 T101001\nG00 X0 Y0 Z5\nG01 X10 F1500\nX20 F1333\nf 10 (F5)\nX9\n"
                                              "G93\nX1 F2.5\nG94\nM02\nF7\n",
                                              kSlower)),
            "M06 T101001\nG00 X0 Y0 Z5\nG01 X10 F1200\nX20 F1066.4\nf8 (F5)\nX9\nG93\nX1 F2.0\nG94\nM02\nF7\n");
}

TEST(Transform, TriesTheValuesOfRegistersThatAreNotSet) {
  const auto result = transformed(
      "M06 T101001\nG00 X1 Y0 Z0\nIF V5 <= 18 GOTO N7\nX2\nIF VGPL = 1 GOTO N7\nX3\nIF V6 > 2 GOTO N7\nX4\nN7 "
      "M02\nX5\n",
      kMirrorX);
  EXPECT_EQ(std::get<std::string>(result),
            "M06 T101001\nG00 X799 Y0 Z0\nIF V5 <= 18 GOTO N7\nX798\nIF VGPL = 1 GOTO N7\nX797\nIF V6 > 2 GOTO "
            "N7\nX796\nN7 M02\nX5\n");
}

TEST(Transform, RefusesTooManyPaths) {
  std::string program = "M06 T101001\n";
  for (int value = 0; value < 40; ++value) program += "IF VGPL=" + std::to_string(value) + " GOTO N9\n";
  const auto result = transformed(program + "N9 M02\n", kMirrorX);
  ASSERT_TRUE(std::holds_alternative<TransformationRefusal>(result));
  EXPECT_THAT(std::get<TransformationRefusal>(result).message(dialect::Language::English),
              HasSubstr("more than 64 combinations"));
}

TEST(Transform, KeepsLineEndsAndWhatFollowsTheEnd) {
  const auto result = transformed("M06 T101001\r\nG00 X1 Y0 Z0\rM02\nG00 X5", kMirrorX);
  EXPECT_EQ(std::get<std::string>(result), "M06 T101001\r\nG00 X799 Y0 Z0\rM02\nG00 X5");
}

}  // namespace
}  // namespace isocnc::transforming
