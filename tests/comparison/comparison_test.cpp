#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/anchors.h"
#include "tests/comparison/compared.h"

namespace isocnc::comparison {
namespace {

/// Programs, and what the second one does differently.
struct ComparisonCase {
  const char* name;
  std::string old_program;
  std::string new_program;
  std::string changes;
};

void PrintTo(const ComparisonCase& each, std::ostream* out) { *out << each.name; }

const std::string kHead = "M06 T101001\nS12000 M03\nG00 X10 Y20 Z40\n";
const std::string kSquare = kHead + "G01 Z-5 F2000\nX100\nY80\nX10\nY20\nG00 Z40\nM02\n";

const std::string kPlunged = kHead + "G01 Z-5 F2000\n";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t place = text.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return text.replace(place, what.size(), with);
}

std::string square(const std::string& what, const std::string& with) { return replaced(kSquare, what, with); }

/// A drilled row under G91.
const std::string kRow =
    "M06 T101001\nG91\nG00 X10 Y5\nG01 Z-3 F500\nG00 Z3\nX20\nG01 Z-3\nG00 Z3\nX20\nG01 Z-3\nG00 Z3\nG90\nX0 Y0\nM02\n";

/// Holes at some X, four lines each from line 5 on.
std::string holes(const std::vector<int>& places) {
  std::string program = kHead + "Z5\n";
  for (const int x : places) program += fmt::format("G00 X{} Y0\nZ2\nG01 Z-10 F500\nG00 Z5\n", x);
  return program + "Z40\nM02\n";
}

/// Two faces of a part in its zero.
std::string faces(const std::string& zero) {
  return "M06 T101001\n" + zero + "\nG00 X1 Y2 Z50\nG29 X10 C30\nG00 X100 Y0\nG01 Z0 F1000\nY100\nG27\n" +
         "G29 X300 C60\nG00 X100 Y0\nG01 Z0\nX80\nG27\nG92 X0 Y0 Z0\nG00 X0 Y0 Z80\nX9\nM02\n";
}

/// A square that is cut in passes of these depths, with a retract after each: its lines are 7, from line 3 on.
std::string passes(const std::vector<double>& depths, const std::string& retract = "G00") {
  std::string program = "M06 T101001\nS12000 M03\n";
  for (const double z : depths)
    program += fmt::format("G00 X0 Y0 Z2\nG01 Z{} F500\nX100 Y0 F2000\nX100 Y50\nX0 Y50\nX0 Y0\n{} Z2\n", -z, retract);
  return program + "G00 Z50\nM05\nM02\n";
}

/// Operations on parts of a table, each by its tool: its lines are 9, from its tool change to its M05.
std::string operations(const std::string& tools) {
  std::string program;
  for (const char tool : tools) {
    const int x = 100 * (tool - '0');
    program += fmt::format("M06 T10100{}\nS{}000 M03\nG00 X{} Y5\nZ40\nG01 Z-3 F{}000\nX{}\nY9\nG00 Z50\nM05\n", tool,
                           tool, x, tool, x + 40);
  }
  return program + "M02\n";
}

/// The same contour on three plates, a tool for each; with the spindle of the second one started before its M06.
std::string plates(bool starts_too_early) {
  std::string program;
  for (const char tool : {'1', '2', '3'}) {
    const std::string change = std::string("M06 T10100") + tool + "\n";
    const std::string start = "S9000 M03\n";
    program += starts_too_early && tool == '2' ? start + change : change + start;
    program += fmt::format("G00 X{} Y0 Z2\nG01 Z-2 F1000\nX{} F3000\nY30\nX{}\nY0\nG00 Z30\nM05\n", 100 * (tool - '0'),
                           100 * (tool - '0') + 30, 100 * (tool - '0'));
  }
  return program + "M02\n";
}

/// Operations that begin and end in one place, to different depths, each by its tool: 9 lines.
std::string nested(const std::string& tools) {
  std::string program;
  for (const char tool : tools)
    program += fmt::format("M06 T10100{}\nS9000 M03\nG00 X50 Y5\nZ20\nG01 Z-{} F500\nX9{}\nX50 Y5\nG00 Z20\nM05\n",
                           tool, tool, tool);
  return program + "M02\n";
}

/// Operations at places of their own that begin and end at one height, each by its tool: 8 lines.
std::string at_height(const std::string& tools) {
  std::string program;
  for (const char tool : tools)
    program += fmt::format("M06 T10100{}\nS9000 M03\nG00 Z20\nX{}00 Y5\nG01 Z-{} F500\nX{}50\nG00 Z20\nM05\n", tool,
                           tool, tool, tool);
  return program + "M02\n";
}

/// The same with one M05, after the last of them: each M06 stops the spindle.
std::string with_one_stop(std::string program) {
  const std::string stop = "M05\n";
  for (std::size_t at = program.find(stop); at != program.rfind(stop); at = program.find(stop))
    program.erase(at, stop.size());
  return program;
}

const ComparisonCase kCases[] = {
    // Nothing that the machine would notice.
    {"Itself", kSquare, kSquare, ""},
    {"Comments", kSquare, "( square )\n" + kSquare + "; end\n", ""},
    {"Numbers", kHead + "X20\nM02\n", "N10 M06 T101001\nN20 S12000 M03\nN30 G00 X10 Y20 Z40\nN40 X20\nN50 M02\n", ""},
    {"OneLineAsTwo", kSquare, square("X100\n", "X40\nX70\nX100\n"), ""},
    {"OneLineAsTwoWithOtherWords", kSquare, square("Y80\n", "X100 Y50\nG01 Y80\n"), ""},
    {"ModalWordsWithoutEffect", kSquare, square("X100\n", "G01 X100 F2000\n"), ""},
    {"FeedWithoutMotion", kSquare, square("G00 Z40\nM02", "G00 Z40\nF800\nM02"), ""},
    {"SpeedWithoutStart", kSquare, square("G00 Z40\nM02", "G00 Z40\nS800\nM02"), ""},
    {"MotionThatGoesNowhere", kSquare, square("Y80\n", "X100\nY80\n"), ""},
    {"FrameThatIsUndone", kHead + "X50\nY9\nM02\n", kHead + "G92 X5 Y0 Z0\nX45\nG92 X0 Y0 Z0\nY9\nM02\n", ""},
    {"JumpThatIsNotTaken", kSquare, square("X100\n", "IF VGPL = 1 GOTO N7\nX100\nN7\n"), ""},
    {"SmallerThanTheTolerance", kSquare, square("X100\n", "X100.0009\n"), ""},
    {"ArcByRadiusOrCenter", kHead + "G03 X30 Y0 I30 J20 F500\nM02\n", kHead + "G03 X30 Y0 R20 F500\nM02\n", ""},
    {"HalfCircleAsQuarters", kHead + "G02 X50 Y20 I30 J20 F500\nM02\n",
     kHead + "G02 X30 Y40 I30 J20 F500\nX50 Y20 I30 J20\nM02\n", ""},
    {"InverseTime", kHead + "G01 X110 F1000\nM02\n", kHead + "G93 G01 X110 F10\nM02\n", ""},

    // Places.
    {"Coordinate", kSquare, square("X100\n", "X101\n"), "moved 5-6|5-6: moved by X1\n"},
    {"CoordinateOfOneMotion", kHead + "X50 Y50\nX100 Y0\nM02\n", kHead + "X50 Y50.5\nX100 Y0\nM02\n",
     "moved 4|4: moved by Y0.5\n"},
    // Their ways are the same in another order, but a coordinate has another sign.
    {"SignOfACoordinate", kPlunged + "X10\nY50\nX20\nY20\nX30\nM02\n", kPlunged + "X10\nY-10\nX20\nY20\nX30\nM02\n",
     "moved 6-7|6-7: moved by Y-60\n"},
    {"SignOfADepth", kHead + "G01 Z30 F500\nZ40\nX50\nM02\n", kHead + "G01 Z50 F500\nZ40\nX50\nM02\n",
     "moved 4|4: moved by Z20\n"},
    {"SignOfARectangle", kHead + "G91 G01 X100 F500\nY50\nX-100\nY-50\nG90\nX30\nM02\n",
     kHead + "G91 G01 X100 F500\nY-50\nX-100\nY50\nG90\nX30\nM02\n", "moved 5-6|5-6: moved by Y-100\n"},
    {"LastMotion", kSquare, square("G00 Z40\nM02", "G00 Z30\nM02"), "moved 9|9: moved by Z-10\n"},
    {"Depth", kSquare, square("Z-5 ", "Z-5.2 "), "moved 4-8|4-8: moved by Z-0.2\n"},
    // The retract between two passes is where it was.
    {"PassesByTheSame", passes({1, 2, 3}), passes({1.1, 2.1, 3.1}),
     "moved 4-8|4-8: moved by Z-0.1\nmoved 11-15|11-15: moved by Z-0.1\nmoved 18-22|18-22: moved by Z-0.1\n"},
    {"PassesWithRetractsAtAFeed", passes({1, 2, 3}, "G01"), passes({1.1, 2.1, 3.1}, "G01"),
     "moved 4-8|4-8: moved by Z-0.1\nmoved 11-15|11-15: moved by Z-0.1\nmoved 18-22|18-22: moved by Z-0.1\n"},
    {"PassesMoreAndMore", passes({1, 2, 3}), passes({1.02, 2.04, 3.06}),
     "moved 4-8|4-8: moved by Z-0.02\nmoved 11-15|11-15: moved by Z-0.04\nmoved 18-22|18-22: moved by Z-0.06\n"},
    {"MotionsMovedOneByOneBeforeAMovedRow", kPlunged + "X20 Y40\nX30 Y20\nX40 Y60\nX50 Y10\nX70\nY90\nX5\nM02\n",
     kPlunged + "X21 Y40\nX31.5 Y20.5\nX41.4 Y60\nX51.4 Y10\nX71.4\nY90\nX6.4\nM02\n",
     "moved 5-11|5-11: moved by up to 1.581 mm\n"},
    {"IncrementMovesWhatFollows", kRow, replaced(kRow, "G00 Z3\nX20\n", "G00 Z3\nX21\n"),
     "moved 6-11|6-11: moved by X1\n"},
    {"Zero", "M06 T101001\nG92 X5 Y0 Z0\nG00 X10\nY10\nX20\nY50\nM02\n",
     "M06 T101001\nG92 X7 Y0 Z0\nG00 X10\nY10\nX20\nY50\nM02\n",
     "frame 3-6|3-6: moved by X2: the frame of line 2 is elsewhere\n"},
    // The frames after it are the same in it, and a motion that gives one coordinate is moved along that one.
    {"ZeroBeforeAnotherOne", "G92 X5 Y0 Z0\nM06 T101001\nG00 X10\nY10\nX20 Y20\nG92 X90 Y0 Z0\nX30\nY9\nX7\nM02\n",
     "G92 X7 Y0 Z0\nM06 T101001\nG00 X10\nY10\nX20 Y20\nG92 X90 Y0 Z0\nX30\nY9\nX7\nM02\n",
     "frame 3-5|3-5: moved by X2: the frame of line 1 is elsewhere\n"},
    {"ZeroOneCoordinateAfterTheOther", "M06 T101001\nG92 X5 Y5 Z0\nG00 X10\nY10\nX20\nY50\nZ9\nX30 Y60\nM02\n",
     "M06 T101001\nG92 X7 Y8 Z0\nG00 X10\nY10\nX20\nY50\nZ9\nX30 Y60\nM02\n",
     "frame 3-8|3-8: moved by X2 Y3: the frame of line 2 is elsewhere\n"},
    {"ZeroThatOneMotionOutlives",
     "M06 T101001\nG92 X5 Y5 Z0\nG00 X10 Y10\nX20\nG92 X0 Y0 Z0\nZ30\nX1 Y1\nX9\nY9\nM02\n",
     "M06 T101001\nG92 X7 Y5 Z0\nG00 X10 Y10\nX20\nG92 X0 Y0 Z0\nZ30\nX1 Y1\nX9\nY9\nM02\n",
     "frame 3-6|3-6: moved by X2: the frame of line 2 is elsewhere\n"},
    {"ZeroOfTwoFaces", faces("G92 X5 Y0 Z0"), faces("G92 X6 Y1 Z0"),
     "frame 3-12|3-12: moved by X1 Y1: the frame of line 2 is elsewhere\n"},
    {"FaceBeforeAnotherOne", faces("G92 X5 Y0 Z0"), replaced(faces("G92 X5 Y0 Z0"), "G29 X10 C30", "G29 X11 C30"),
     "frame 5-7|5-7: moved by X1: the frame of line 4 is elsewhere\n"},
    {"ZeroAndAPlaceInIt", "M06 T101001\nG92 X5 Y0 Z0\nG00 X10\nY10\nX20\nY50\nX60\nY70\nX80\nM02\n",
     "M06 T101001\nG92 X7 Y0 Z0\nG00 X10\nY10\nX21\nY50\nX60\nY70\nX80\nM02\n",
     "frame 3-9|3-9: moved by X2: the frame of line 2 is elsewhere\nmoved 5|5: moved by X3\n"},
    {"CoordinateThatIsNoFrame", "M06 T101001\nG92 X5 Y0 Z0\nG00 X10\nY10\nX20\nY50\nM02\n",
     "M06 T101001\nG92 X5 Y0 Z0\nG00 X12\nY10\nX20\nY50\nM02\n", "moved 3-4|3-4: moved by X2\n"},
    {"ArcAsLine", kHead + "G03 X50 Y20 I30 J20 F500\nM02\n", kHead + "G01 X50 Y20 F500\nM02\n",
     "shape 4|4: another path, up to 20 mm away\n"},
    {"OtherWayAround", kHead + "G03 X50 Y20 I30 J20 F500\nM02\n", kHead + "G02 X50 Y20 I30 J20 F500\nM02\n",
     "shape 4|4: another path, up to 28.284 mm away\n"},
    {"ArcAsCoarseChords", kHead + "G03 X50 Y20 I30 J20 F500\nM02\n", kHead + "G01 X30 Y0 F500\nX50 Y20\nM02\n",
     "shape 4|4-5: another path, 2 motions instead of 1, up to 5.858 mm away\n"},
    {"ArcOfAnotherRadiusInAMovedBlock", kPlunged + "X50\nG03 X60 Y30 R10\nG01 Y60\nG00 Z50\nM02\n",
     kPlunged + "X51\nG03 X61 Y30 R30\nG01 Y60\nG00 Z50\nM02\n",
     "moved 5-8|5-8: moved by X1\nshape 6|6: another path, up to 2.084 mm away\n"},
    // Of the whole ways, which begin in one place.
    {"ArcOfAnotherRadiusThatMovesWhatFollows", kPlunged + "G03 X40 Y20 R15.5\nG01 Y60\nX0\nM02\n",
     kPlunged + "G03 X45 Y20 R40\nG01 Y60\nX0\nM02\n",
     "moved 5-6|5-6: moved by X5\nshape 5|5: another path, up to 7.661 mm away\n"},
    {"ArcThatMovesWhatFollowsUpToTheEnd", kPlunged + "G03 X40 Y20 R15.5\nG01 Y60\nX0 Y90\nX7 Y50\nX99\nM02\n",
     kPlunged + "G03 X45 Y20 R40\nG01 X45 Y60\nX5 Y90\nX12 Y50\nX104\nM02\n",
     "shape 5|5: another path, up to 7.661 mm away\nmoved 5-9|5-9: moved by X5\n"},
    {"CircleOfAnotherRadiusBesideAFunction", kPlunged + "M08\nG03 X10 Y20 I30 J20\nG01 X20\nM02\n",
     kPlunged + "M09\nG03 X10 Y20 I15 J20\nG01 X20\nM02\n",
     "function 5|5: M09 instead of M08\nshape 6|6: another path, up to 30 mm away\n"},
    {"OtherWayAroundBesideATool", kPlunged + "G03 X-30 Y20 I-10 J20\nG00 Z40\nM06 T101002\nX5\nM02\n",
     kPlunged + "G02 X-30 Y20 I-10 J20\nG00 Z40\nM06 T101099\nX5\nM02\n",
     "shape 5|5: another path, up to 28.284 mm away\ntool 7|7: T101099 instead of T101002\n"},
    {"OtherWayAroundBesideAMovedLine", kPlunged + "X50\nG03 X10 Y20 I30 J20\nG01 Y80\nX0\nM02\n",
     kPlunged + "X50\nG02 X10 Y20 I30 J20\nG01 Y81\nX0\nM02\n",
     "shape 6|6: another path, up to 28.284 mm away\nmoved 7-8|7-8: moved by Y1\n"},
    {"ArcWhoseStartMoves", kPlunged + "X50\nG03 X60 Y30 R10\nG01 Y60\nX0\nM02\n",
     kPlunged + "X52\nG02 X60 Y30 R10\nG01 Y60\nX0\nM02\n",
     "moved 5|5: moved by X2\nshape 6|6: another path, up to 4.509 mm away\n"},
    {"ArcAsLineBesideAFunction", kPlunged + "G03 X50 Y20 I30 J20\nM08\nG01 Y80\nX0\nM02\n",
     kPlunged + "G01 X50 Y20\nG01 Y80\nX0\nM02\n",
     "shape 5|5: another path, up to 20 mm away\nfunction 6|-: removed: M08\n"},
    {"TwoArcsTheOtherWayAround", kPlunged + "G03 X-30 Y20 I-10 J20\nG01 Y60\nG03 X-60 Y60 R15\nG01 X-99\nM02\n",
     kPlunged + "G02 X-30 Y20 I-10 J20\nG01 Y60\nG02 X-60 Y60 R15\nG01 X-99\nM02\n",
     "shape 5|5: another path, up to 28.284 mm away\nshape 7|7: another path, up to 21.213 mm away\n"},
    {"CircleTheOtherWayAround", kPlunged + "G03 X10 Y20 I30 J20\nG01 X20\nM02\n",
     kPlunged + "G02 X10 Y20 I30 J20\nG01 X20\nM02\n", "shape 5|5: the same path the other way around\n"},
    // Each of them alone, as they follow each other in one program only.
    {"ContourTheOtherWayAroundWithAnotherFeed", kPlunged + "X100\nY80\nX10\nY20\nG00 Z40\nM02\n",
     kHead + "G01 Z-5 F3000\nY80\nX100\nY20\nX10\nG00 Z40\nM02\n",
     "feed 4|4: F3000 instead of F2000\nshape 5-8|5-8: the same path the other way around\n"
     "feed 5|8: F3000 instead of F2000\nfeed 6|7: F3000 instead of F2000\nfeed 7|6: F3000 instead of F2000\n"
     "feed 8|5: F3000 instead of F2000\n"},
    {"ContourTheOtherWayAround", kSquare, square("X100\nY80\nX10\nY20\n", "Y80\nX100\nY20\nX10\n"),
     "shape 5-8|5-8: the same path the other way around\n"},
    {"SplitOnALineBesideAFunction", kPlunged + "M08\nX60\nY50\nM02\n", kPlunged + "M09\nX40\nX60\nY50\nM02\n",
     "function 5|5: M09 instead of M08\n"},
    {"OtherPartsBesideAMovedLine", kPlunged + "X40\nX70\nY80\nX10 F3000\nY50\nM02\n",
     kPlunged + "X71\nX70.5 Y50\nX70 Y80\nX10 F3000\nY50\nM02\n", "moved 5-6|5: moved by X1\n"},
    {"OtherPartsBesideAMovedLineWithAnotherFeed",
     kHead + "G49\nG01 X55 Y70 B5 F1000\nX100 Y120 B10\nX60 Y70 B0 F2000\nG00 Z200\nM02\n",
     kHead + "G49\nG01 X100 Y120 B11 F1000\nX80 Y95 B5.5 F2000\nX60 Y70 B0\nG00 Z200\nM02\n",
     "moved 5-6|5: B or C turned by up to 1 degree\n"},
    {"CutLostBeforeARetraction", kPlunged + "X100 F8000\nG00 Z50\nX150 Y20\nG01 Z-5 F2000\nM02\n",
     kPlunged + "G00 Z50\nX150 Y20\nG01 Z-5 F2000\nM02\n",
     "removed 5|-: removed: 1 motion\nmoved 6|5: moved by X-90\n"},
    {"CutThatBecomesARapid", kPlunged + "X100 F8000\nG00 Z50\nX150 Y20\nG01 Z-5 F2000\nM02\n",
     kPlunged + "G00 X101\nX150 Y20 Z50\nG01 Z-5 F2000\nM02\n",
     "shape 5-6|5: another path, 1 motion instead of 2, up to 37.333 mm away\nfeed 5|5: G00 instead of F8000\n"},
    {"EndsAreMovedAlongThePath", kPlunged + "X50 Y20.1\nX100 Y20.3\nX150 Y20.6\nY90\nM02\n",
     kPlunged + "X55 Y20.1\nX107 Y20.3\nX150 Y20.6\nY90\nM02\n", "moved 5-6|5-6: moved by up to 7 mm\n"},
    {"TurnInTwoParts", kHead + "G49\nG01 B40 C20 F1000\nG48\nG00 Z200\nM02\n",
     kHead + "G49\nG01 B20 C10 F1000\nB40 C20\nG48\nG00 Z200\nM02\n", ""},
    {"LostFrame", "G71 G90\nG92 X100 Y50 Z-20\n" + kPlunged + "X90\nM02\n", "G71 G90\n" + kPlunged + "X90\nM02\n",
     "frame 5-7|4-6: moved by X-100 Y-50 Z20: the frame of old line 2 is missing\n"},
    {"DwellBesideAnIfOverSomethingElse", kPlunged + "G04 P2\nX100\nM02\n",
     kPlunged + "V7=3\nIF V7 > 2 GOTO N5\nM99\nN5 X100\nM02\n", "dwell 5|-: dwell of 2 s removed\n"},
    {"OtherPartsBesideAMovedLineWithADwell", kPlunged + "X40\nX70\nG04 P1\nY80\nX10\nY50\nM02\n",
     kPlunged + "X70.01\nG04 P1\nX70.005 Y50\nX70 Y80\nX10\nY50\nM02\n", "moved 5-6|5: moved by X0.01\n"},
    {"OtherPartsBesideAMovedLineWithASpindle", kPlunged + "X40\nX70\nS9000 M03\nY80\nX10\nY50\nM02\n",
     kPlunged + "X70.01\nS9000 M03\nX70.005 Y50\nX70 Y80\nX10\nY50\nM02\n", "moved 5-6|5: moved by X0.01\n"},
    {"FeedOfOtherPartsBesideAMovedLine", kPlunged + "X40\nX70\nY80\nX10\nY50\nM02\n",
     kPlunged + "X71 F1000\nX70 Y80 F2000\nX10\nY50\nM02\n",
     "moved 5-6|5: moved by X1\nfeed 5-6|5: F1000 instead of F2000\n"},
    {"PartsOfOtherFeedsBesideAMovedLine", kPlunged + "X20 Y20\nX30 Y20\nX35 Y20 F3000\nX40 Y20\nG00 Z40\nM02\n",
     kPlunged + "X20 Y21\nX30 Y20 F2000\nX35 Y20 F3000\nG00 Z40\nM02\n",
     "shape 5-9|5-8: another path, 4 motions instead of 5, up to 5 mm away\nfeed 7|6: F2000 instead of F3000\n"},
    {"PartsAroundAFunctionBesideAMovedLine", kPlunged + "X20\nM08\nX30\nX40 Y50\nX9 Y3\nM02\n",
     kPlunged + "X31\nX40 Y50\nX9 Y3\nM02\n",
     "shape 5-7|5: another path, 1 motion instead of 2, up to 0.949 mm away\nfunction 6|-: removed: M08\n"},
    {"ArcAndLineInsteadOfAMovedLine", kPlunged + "G03 X30 Y20 R12\nG01 X50\nX60 Y90\nX9 Y3\nM02\n",
     kPlunged + "G01 X51\nX60 Y90\nX9 Y3\nM02\n",
     "shape 5-6|5: another path, 1 motion instead of 2, up to 5.367 mm away\n"},
    {"PlaceOnALineThatLeavesIt", kPlunged + "X40\nX70\nX99\nY50\nM02\n", kPlunged + "X40\nX70 Y90\nX99 Y20\nY50\nM02\n",
     "moved 6|6: moved by Y70\n"},
    // Each of the two, though the same rapid is there elsewhere.
    {"RapidAndFeedMoveExchangedInAMovedRow",
     kPlunged + "G91\nG00 X40 Y3\nG01 X30 Y-5 F900\nX30 Y9\nG90\nX500\nY9\nX2\nM02\n",
     kPlunged + "G91\nG01 X41 Y5 F900\nG00 X40 Y3\nG01 X31 Y11\nG90\nX500\nY9\nX2\nM02\n",
     "feed 6|6: F900 instead of G00\nmoved 6-10|6-10: moved by up to 16.971 mm\nfeed 7|7: G00 instead of F900\n"},
    {"HeightFromWhichToPlunge", kHead + "Z2\nG01 Z-2 F1000\nX50\nM02\n", kHead + "Z1.5\nG01 Z-2 F1000\nX50\nM02\n",
     "moved 4|4: moved by Z-0.5\n"},
    {"RapidInsteadOfHalfAFeedMove", kHead + "G01 X50 F500\nY7\nM02\n", kHead + "G00 X30\nG01 X50 F500\nY7\nM02\n",
     "feed 4|4: G00 instead of F500\n"},
    {"Turn", kHead + "G49\nG01 X20 B10 F500\nX50 Y7\nM02\n", kHead + "G49\nG01 X20 B12 F500\nX50 Y7\nM02\n",
     "moved 5-6|5-6: B or C turned by up to 2 degrees\n"},

    // Motions more or less, and their order.
    {"LineLost", kHead + "X50 Y50\nX100 Y0\nX0 Y7\nM02\n", kHead + "X50 Y50\nX0 Y7\nM02\n",
     "removed 5|5: removed: 1 motion; the next one takes another path, up to 70.711 mm away\n"},
    // The rapid above the part becomes a cut through it, or a rapid through it.
    {"RetractLost", kPlunged + "Y100\nG00 Z50\nY150\nG01 Z-5\nY200\nG00 Z50\nM02\n",
     kPlunged + "Y100\nY150\nG01 Z-5\nY200\nG00 Z50\nM02\n",
     "removed 6-7|6: removed: 2 motions; the next one takes another path, up to 55 mm away\n"},
    // The cut there begins with the feed of the next line, which is not new.
    {"RetractLostBeforeACut", kPlunged + "X50 F8000\nG00 Z40\nY90\nG01 Z-5 F2000\nY99 F8000\nG00 Z40\nM02\n",
     kPlunged + "X50 F8000\nY90\nG01 Z-5 F2000\nY99 F8000\nG00 Z40\nM02\n",
     "removed 6-7|6: removed: 2 motions; the next one takes another path, up to 45 mm away\n"},
    {"RetractLostBeforeARapid", kPlunged + "Y100\nG00 Z50\nG00 Y150\nG01 Z-5\nY200\nG00 Z50\nM02\n",
     kPlunged + "Y100\nG00 Y150\nG01 Z-5\nY200\nG00 Z50\nM02\n",
     "removed 6-7|6: removed: 2 motions; the next one takes another path, up to 55 mm away\n"
     "feed 8|6: G00 instead of F2000\n"},
    {"RetractLostAndAnotherOneGained", kPlunged + "X50\nG00 Z50\nG01 Y10\nG00 Z5\nG01 Y70\nX10\nZ40\nX70 Y90\nM02\n",
     kPlunged + "X50\nY10\nG00 Z5\nG01 Y70\nG00 Z55\nG01 X10\nZ40\nX70 Y90\nM02\n",
     "removed 6|-: removed: 1 motion\nmoved 7|6: moved by Z-55\nadded -|9: added: 1 motion\n"
     "moved 10|10: moved by Z50\n"},
    {"RetractGained", kPlunged + "Y100\nY150\nY200\nM02\n", kPlunged + "Y100\nG00 Z50\nY150\nG01 Z-5\nY200\nM02\n",
     "added 6|6-7: added: 2 motions; the next one takes another path, up to 55 mm away\n"},
    // The next motion goes where the old program does.
    {"WayOutAndBackLost", kPlunged + "Y100\nX50\nX10\nY150\nM02\n", kPlunged + "Y100\nY150\nM02\n",
     "removed 6-7|-: removed: 2 motions\n"},
    {"LineGained", kHead + "X50 Y50\nX0 Y7\nM02\n", kHead + "X50 Y50\nX100 Y0\nX9 Y9\nX0 Y7\nM02\n",
     "added 5|5-6: added: 2 motions; the next one takes another path, up to 26.015 mm away\n"},
    {"HoleOfAGrid",
     kHead + "X20 Y0\nG01 Z0 F500\nG00 Z40\nX40\nG01 Z0\nG00 Z40\nX60\nG01 Z0\nG00 Z40\nX80\nG01 Z0\nG00 Z40\nM02\n",
     kHead + "X20 Y0\nG01 Z0 F500\nG00 Z40\nX60\nG01 Z0\nG00 Z40\nX80\nG01 Z0\nG00 Z40\nM02\n",
     "removed 7-9|-: removed: 3 motions\n"},
    {"LastHoleLost", kHead + "X20 Y0\nG01 Z0 F500\nG00 Z5\nX40\nG01 Z0\nG00 Z5\nX60\nG01 Z0\nG00 Z5\nG00 Z50\nM02\n",
     kHead + "X20 Y0\nG01 Z0 F500\nG00 Z5\nX40\nG01 Z0\nG00 Z5\nG00 Z50\nM02\n",
     "removed 10-12|-: removed: 3 motions\nmoved 13|10: moved by X-20\n"},
    // Holes at other times: exchanged, in a circle, and one of them last.
    {"HolesSwapped", holes({20, 40, 60, 80, 100}), holes({20, 80, 60, 40, 100}),
     "reordered 9-12|17-20: order changed\nreordered 17-20|9-12: order changed\n"},
    {"HoleSwappedWithTheLastOne", holes({20, 40, 60, 80, 100}), holes({20, 100, 60, 80, 40}),
     "reordered 9-12|21-24: order changed\nreordered 21-24|9-12: order changed\n"},
    {"HolesInACircle", holes({20, 40, 60, 80, 100, 120, 140}), holes({20, 80, 60, 120, 100, 40, 140}),
     "reordered 9-12|25-28: order changed\nreordered 17-20|9-12: order changed\nreordered 25-28|17-20: order "
     "changed\n"},
    {"NeighborsSwapped", holes({20, 40, 60, 80}), holes({20, 60, 40, 80}), "reordered 9-12|13-16: order changed\n"},
    {"RowOfHolesTheOtherWayAround", holes({20, 40, 60, 80, 100, 120}), holes({100, 80, 60, 40, 20, 120}),
     "reordered 5-12|17-24: order changed\nreordered 17-24|5-12: order changed\n"},
    {"HoleLater", holes({20, 40, 60, 80, 100}), holes({20, 60, 80, 40, 100}), "reordered 9-12|17-20: order changed\n"},
    {"HoleMovedToTheEnd", holes({20, 40, 60, 80, 100}), holes({20, 60, 80, 100, 40}),
     "reordered 9-12|21-24: order changed\n"},
    {"LastHoleMovedToTheStart", holes({20, 40, 60, 80, 100}), holes({100, 20, 40, 60, 80}),
     "reordered 21-24|5-8: order changed\n"},
    {"AnotherHoleAtTheEnd", holes({20, 40, 60, 80, 100}), holes({20, 60, 80, 100, 41}),
     "removed 9-12|-: removed: 4 motions\nadded -|21-24: added: 4 motions\nmoved 25|25: moved by X-59\n"},
    {"HolesMovedNotSwapped", holes({20, 40, 60, 80, 100}), holes({20, 80, 60, 41, 100}),
     "moved 9-12|9-12: moved by X40\nmoved 17-20|17-20: moved by X-39\n"},
    {"LinesSwapped", kHead + "X50 Y50\nX100 Y0\nX0 Y7\nM02\n", kHead + "X100 Y0\nX50 Y50\nX0 Y7\nM02\n",
     "reordered 4-5|4-5: order changed\n"},
    {"LinesSwappedBeforeMovedOnes", kPlunged + "X50 Y50\nX100 Y0\nX0 Y7\nX30\nX44 Y2\nX9 Y9\nG00 Z40\nM02\n",
     kPlunged + "X100 Y0\nX50 Y50\nX1 Y7\nX31\nX45 Y2\nX10 Y9\nG00 Z40\nM02\n",
     "reordered 5-6|5-6: order changed\nmoved 7-11|7-11: moved by X1\n"},
    {"LinesSwappedAroundOneOfAnotherFeed",
     kPlunged + "X50 Y50 F1000\nX100 Y0 F2000\nX30 Y30 F1000\nX0 Y7 F900\nG00 Z40\nM02\n",
     kPlunged + "X30 Y30 F1000\nX100 Y0 F2500\nX50 Y50 F1000\nX0 Y7 F900\nG00 Z40\nM02\n",
     "reordered 5-7|5-7: order changed\nfeed 6|6: F2500 instead of F2000\n"},
    // The control knows the tool's radius alone; the motion that closes them is on the same side as well.
    {"LinesSwappedUnderCompensation",
     "M06 T102001\nS12000 M03\nG00 X0 Y0 Z5\nG41\nG01 X10 Y10 F1000\nX50 Y50\nX100 Y0\nX0 Y7\nG40\nG01 X20 Y30\nX9 "
     "Y9\nX4 Y2\nM02\n",
     "M06 T102001\nS12000 M03\nG00 X0 Y0 Z5\nG41\nG01 X10 Y10 F1000\nX100 Y0\nX50 Y50\nX0 Y7\nG40\nG01 X20 Y30\nX9 "
     "Y9\nX4 Y2\nM02\n",
     "reordered 6-7|6-7: order changed\n"},
    {"LinesSwappedBeforeOneOfAnotherFeed", kPlunged + "X50 Y50\nX100 Y0\nX0 Y7\nX30\nX44 Y2\nG00 Z40\nM02\n",
     kPlunged + "X100 Y0\nX50 Y50\nX0 Y7 F3000\nX30 F2000\nX44 Y2\nG00 Z40\nM02\n",
     "reordered 5-6|5-6: order changed\nfeed 7|7: F3000 instead of F2000\n"},
    // A place that is reached twice: where it is in its old place, it stays.
    {"PlaceTwiceOfWhichOneStays",
     kPlunged + "X50 Y50 F1000\nX100 Y0 F2000\nX50 Y50 F3000\nX30 Y30 F1500\nX60 Y9 F1200\nX0 Y7 F900\nM02\n",
     kPlunged + "X30 Y30 F1500\nX100 Y0 F2000\nX50 Y50 F3000\nX60 Y9 F1200\nX50 Y50 F1000\nX0 Y7 F900\nM02\n",
     "reordered 5-9|5-9: order changed\n"},
    // A rapid goes nowhere the other way around.
    {"ContourWithARapidInAnotherOrder", kPlunged + "X100\nG00 Y80\nG01 X10\nY20\nG00 Z40\nM02\n",
     kPlunged + "Y80\nX100\nY20\nX10\nG00 Z40\nM02\n",
     "reordered 5-7|5-7: order changed\nfeed 6|6: F2000 instead of G00\n"},
    {"IncrementsSwapped", kHead + "G91\nX50 Y50\nX100 Y0\nX9 Y7\nM02\n", kHead + "G91\nX100 Y0\nX50 Y50\nX9 Y7\nM02\n",
     "reordered 5-6|5-6: order changed\n"},

    // Operations, each from a tool change to the next one.
    {"OperationsSwapped", operations("123"), operations("132"),
     "reordered 19-27|10-18: order changed: now after T101001, was after T101002\n"},
    {"OperationsSwappedAtTheStart", operations("123"), operations("213"),
     "reordered 10-18|1-9: order changed: now the first one, was after T101001\n"},
    {"OperationsSwappedBeforeTheLastStop", with_one_stop(operations("12")), with_one_stop(operations("21")),
     "reordered 9-16|1-8: order changed: now the first one, was after T101001\n"},
    {"ToolWhereThereWasNone", "M100\nG04 P1\nM101\nM102\nM103\nM02\n",
     "M06 T101001\nM100\nG04 P1\nM101\nM102\nM103\nM02\n", "tool -|1: added: T101001\n"},
    {"ToolAfterWhatNeedsNone", "M100\nG04 P1\nM101\nM02\n", "M100\nG04 P1\nM101\nM06 T101001\nM02\n",
     "added -|4: added: operation of T101001, 0 motions\n"},
    {"OperationMovedToTheEnd", operations("1234"), operations("2341"),
     "reordered 1-9|28-36: order changed: now after T101004, was the first one\n"},
    {"OperationLost", operations("123"), operations("13"),
     "removed 10-18|-: removed: operation of T101002, 6 motions\n"},
    {"LastOperationLost", operations("123"), operations("12"),
     "removed 19-27|-: removed: operation of T101003, 6 motions\n"},
    {"OperationTwice", operations("123"), operations("1223"),
     "added -|19-27: added: operation of T101002, 6 motions\n"},
    {"OperationMovedAndOneChanged", operations("1234"), replaced(operations("2341"), "F4000", "F4500"),
     "reordered 1-9|28-36: order changed: now after T101004, was the first one\n"
     "feed 32-34|23-25: F4500 instead of F4000\n"},
    {"OperationGainedBeforeAChangedOne", operations("13"), replaced(operations("123"), "F3000", "F3500"),
     "added -|10-18: added: operation of T101002, 6 motions\nfeed 14-16|23-25: F3500 instead of F3000\n"},
    {"OperationOfAnotherToolAndOneGained", operations("12"), replaced(operations("123"), "T101001", "T101004"),
     "tool 1|1: T101004 instead of T101001\nadded -|19-27: added: operation of T101003, 6 motions\n"},
    {"OperationLostAndALaterOneOfAnotherTool", operations("123"), replaced(operations("2356"), "T101003", "T101004"),
     "removed 1-9|-: removed: operation of T101001, 6 motions\ntool 19|10: T101004 instead of T101003\n"
     "added -|19-27: added: operation of T101005, 6 motions\nadded -|28-36: added: operation of T101006, 6 motions\n"},
    {"OperationLostAndMotionsOfAnotherOne", operations("12"), replaced(operations("1"), "G00 Z50", "X150\nG00 Z50"),
     "added -|8: added: 1 motion\nmoved 8|9: moved by X10\nremoved 10-18|-: removed: operation of T101002, 6 "
     "motions\n"},
    {"OperationsOfOneToolSwapped", replaced(operations("12"), "T101002", "T101001"),
     replaced(operations("21"), "T101002", "T101001"),
     "reordered 10-18|1-9: order changed: now the first one, was after T101001@1\n"},
    {"OneOperationLostAndAnotherOneAdded", operations("12"), operations("23"),
     "removed 1-9|-: removed: operation of T101001, 6 motions\nadded -|10-18: added: operation of T101003, 6 "
     "motions\n"},
    {"OperationMovedAndChanged", operations("12"), replaced(operations("21"), "X140", "X145"),
     "moved 6-8|15-17: moved by X5\nreordered 10-18|1-9: order changed: now the first one, was after T101001\n"},
    {"OperationOnceMoreAtTheStart", operations("12"), operations("212"),
     "added -|1-9: added: operation of T101002, 6 motions\n"},
    {"AllOperationsNew", "M02\n", operations("12"),
     "added -|1-9: added: operation of T101001, 6 motions\nadded -|10-18: added: operation of T101002, 6 motions\n"},
    {"FirstOperationLostWithALineBefore", "M100\n" + operations("12"), operations("2"),
     "function 1|-: removed: M100\nremoved 2-10|-: removed: operation of T101001, 6 motions\n"},
    // Where nothing brings B back, the second operation is another one.
    {"OperationsSwappedWithAnotherTilt", "M06 T101001\nG00 X10 B10\nX20\nM06 T101002\nG00 X50\nX60\nM02\n",
     "M06 T101002\nG00 X50\nX60\nM06 T101001\nG00 X10 B10\nX20\nM02\n",
     "reordered 4-6|1-3: order changed: now the first one, was after T101001\n"
     "moved 5-6|2-3: B or C turned by up to 10 degrees\n"},
    {"ToolsSwapped", operations("12"), replaced(replaced(operations("12"), "T101001", "T101003"), "T101002", "T101001"),
     "tool 1|1: T101003 instead of T101001\ntool 10|10: T101001 instead of T101002\n"},
    {"ToolChangeLost", operations("12"), replaced(operations("12"), "M06 T101002\n", ""),
     "tool 10|-: removed: T101002\n"},
    {"FirstToolChangeLost", operations("12"), replaced(operations("12"), "M06 T101001\n", ""),
     "tool 1|-: removed: T101001\nend 3-19|2: ends with ISO044 instead of M02: from here on 0 motions instead of 12\n"},

    // What is no motion.
    {"Feed", kSquare, square("F2000", "F3000"), "feed 4-8|4-8: F3000 instead of F2000\n"},
    {"FeedOnTheWay", kSquare, square("X100\n", "X40\nX100 F3000\nF2000\n"), "feed 5|6: F3000 instead of F2000\n"},
    {"FeedInInverseTime", kHead + "G93 G01 X110 F10\nM02\n", kHead + "G93 G01 X110 F20\nM02\n",
     "feed 4|4: F2000 instead of F1000\n"},
    {"RapidInsteadOfFeed", kHead + "G01 X50 F500\nM02\n", kHead + "G00 X50\nM02\n", "feed 4|4: G00 instead of F500\n"},
    {"Speed", kSquare, square("S12000", "S9000"), "speed 2|2: S9000 M03 instead of S12000 M03\n"},
    {"SpindleStop", kSquare, square("G00 Z40\nM02", "G00 Z40\nM05\nM02"), "speed -|10: added: M05\n"},
    {"SpindleStartLost", kSquare.substr(0, kSquare.size() - 4) + "M05\nX9\nM02\n",
     replaced(kSquare.substr(0, kSquare.size() - 4) + "M05\nX9\nM02\n", "S12000 M03\n", ""),
     "speed 2|-: removed: S12000 M03\n"},
    {"SpindleStartAndStopOfTwo", kHead + "M05\nS9000 M03\nX50\nM05\nM02\n", kHead + "X50\nM05\nM02\n",
     "speed 4|-: removed: M05\nspeed 5|-: removed: S9000 M03\n"},
    // A tool change stops the spindle: each S and M03 is there, and it is cut with a spindle that stands.
    {"SpindleStartBeforeTheToolChange",
     kPlunged + "X50\nG00 Z40\nM05\nM06 T101002\nS9000 M03\nG00 X0 Y0\nG01 Z-5 F500\nX90\nG00 Z40\nM05\nM02\n",
     kPlunged + "X50\nG00 Z40\nM05\nS9000 M03\nM06 T101002\nG00 X0 Y0\nG01 Z-5 F500\nX90\nG00 Z40\nM05\nM02\n",
     "reordered 8-9|8-9: order changed\nspeed 11-12|11-12: the spindle stands still, was S9000 M03\n"},
    {"ToolChangeThatStopsTheSpindle", kSquare, square("X100\n", "M06 T101001\nX100\n"),
     "tool -|5: added: T101001\nspeed 5-8|6-9: the spindle stands still, was S12000 M03\n"},
    // What has another speed before the tool change does not say that it stands after it.
    {"ToolChangeThatStopsASpindleOfAnotherSpeed", kPlunged + "X50 Y30\nX60 Y90\nX70\nY10\nX90\nG00 Z40\nM02\n",
     kPlunged + "S11000 M03\nX50 Y30\nX60 Y90\nM06 T101001\nX70\nY10\nX90\nG00 Z40\nM02\n",
     "speed -|5: added: S11000 M03\ntool -|8: added: T101001\n"
     "speed 7-9|9-11: the spindle stands still, was S12000 M03\n"},
    {"ToolChangeThatStopsASpindleOfAnotherSpeedFromTheStart",
     kPlunged + "X50 Y30\nX60 Y90\nX70\nY10\nX90\nG00 Z40\nM02\n",
     replaced(kPlunged, "S12000", "S11000") + "X50 Y30\nX60 Y90\nM06 T101001\nX70\nY10\nX90\nG00 Z40\nM02\n",
     "speed 2|2: S11000 M03 instead of S12000 M03\ntool -|7: added: T101001\n"
     "speed 7-9|8-10: the spindle stands still, was S12000 M03\n"},
    {"ToolChangeThatStopsTheSpindleBesideALostStop", kPlunged + "X50\nM05\nS9000 M03\nY30\nX70\nM02\n",
     kPlunged + "X50\nS9000 M03\nM06 T101001\nY30\nX70\nM02\n",
     "speed 6|-: removed: M05\ntool -|7: added: T101001\nspeed 8-9|8-9: the spindle stands still, was S9000 M03\n"},
    {"ToolChangeThatNoLongerStopsTheSpindle", square("X100\n", "M06 T101001\nX100\n"), kSquare,
     "tool 5|-: removed: T101001\nspeed 6-9|5-8: the spindle turns, S12000 M03, stood still before\n"},
    // What stops a spindle that has turned in both is no idle stop, whatever S waits before it.
    {"SpindleStopAfterASpeedThatWaits", kPlunged + "X50\nY50\nX70\nM02\n",
     kPlunged + "X50\nS8000\nY50\nM05\nX70\nM02\n", "speed -|6: added: S8000\nspeed -|8: added: M05\n"},
    // Nor is one after a start in a spindle that turns already.
    {"SpindleStopAfterAnotherSpeed", kPlunged + "X50 Y30\nX60 Y90\nX70\nY10\nG00 Z40\nM02\n",
     kPlunged + "X50 Y30\nS9000 M03\nX60 Y90\nM05\nX70\nY10\nG00 Z40\nM02\n",
     "speed -|6: added: S9000 M03\nspeed -|8: added: M05\n"},
    {"Tool", kSquare, square("T101001", "T101002"), "tool 1|1: T101002 instead of T101001\n"},
    {"Function", kSquare, square("G00 Z40\nM02", "G00 Z40\nM100 P1=2\nM02"), "function -|10: added: M100 P1=2\n"},
    {"Parameter", kSquare + "", square("G00 Z40\nM02", "G00 Z40\nM100 P1=3\nM02"), "function -|10: added: M100 P1=3\n"},
    {"ParametersInAnotherOrder", kHead + "M100 P1=2 P2=3\nM02\n", kHead + "M100 P2=3 P1=2\nM02\n", ""},
    {"ParametersExchanged", kHead + "M100 P1=2 P2=3\nM02\n", kHead + "M100 P1=3 P2=2\nM02\n",
     "function 4|4: M100 P1=3 P2=2 instead of M100 P1=2 P2=3\n"},
    {"FunctionEarlierOnALine", kPlunged + "X60\nM08\nY50\nM02\n", kPlunged + "X40\nM08\nX60\nY50\nM02\n",
     "function 6|6: M08 comes 20 mm earlier\n"},
    {"FunctionLostBesideAWayOutAndBack", kPlunged + "Y100\nM08\nY150\nX9\nM02\n",
     kPlunged + "Y100\nX50\nX10\nY150\nX9\nM02\n", "function 6|-: removed: M08\nadded -|6-7: added: 2 motions\n"},
    {"DwellLaterOnAContour", kPlunged + "X60\nG04 P1\nY50\nX99\nM02\n", kPlunged + "X60\nY50\nG04 P1\nX99\nM02\n",
     "dwell 6|7: dwell of 1 s comes 30 mm later\n"},
    {"DwellAsTwo", kHead + "G04 P1\nX50\nM02\n", kHead + "G04 P0.5\nG04 P0.5\nX50\nM02\n", ""},
    {"DwellAsTwoBesideAMovedLine", kPlunged + "X60\nG04 P2\nG00 X99\nM02\n",
     kPlunged + "X61\nG04 P1\nG04 P1\nG00 X99\nM02\n", "moved 5|5: moved by X1\n"},
    {"DwellAsTwoIsLonger", kHead + "G04 P2\nX50\nM02\n", kHead + "G04 P1.1\nG04 P1.1\nX50\nM02\n",
     "dwell 4|4-5: dwell of 2.2 s instead of 2 s\n"},
    {"DwellInOtherPartsBesideAMovedLine", kPlunged + "X60\nG04 P1\nG04 P2\nG04 P3\nG00 X99\nM02\n",
     kPlunged + "X61\nG04 P2\nG04 P2\nG04 P2.5\nG00 X99\nM02\n",
     "moved 5|5: moved by X1\ndwell 6-8|6-8: dwell of 6.5 s instead of 6 s\n"},
    // Lines of which one is lost and another one is new are taken for each other in their order, feeds included.
    {"LineLostAndAnotherOneGainedInAMovedRow",
     kPlunged + "X20 Y40 F4000\nX30 Y20\nX40 Y40 F3000\nX50 Y22\nX60 Y45\nX90 Y50\nX95 Y0\nM02\n",
     kPlunged + "X21 Y41 F4000\nX41 Y43 F3000\nX20 Y70\nX51 Y22\nX61 Y47\nX90 Y50\nX95 Y0\nM02\n",
     "moved 5-9|5-9: moved by up to 36.056 mm\nfeed 6|6: F3000 instead of F4000\n"},
    {"LineLostAndAnArcGainedInAMovedRow",
     kPlunged + "X20 Y40 F4000\nX30 Y20\nX40 Y40 F3000\nX50 Y22\nX60 Y45\nX90 Y50\nX95 Y0\nM02\n",
     kPlunged + "X21 Y41 F4000\nX41 Y43 F3000\nG02 X20 Y70 R40\nG01 X51 Y22\nX61 Y47\nX90 Y50\nX95 Y0\nM02\n",
     "shape 5-9|5-9: another path, up to 30 mm away\n"},
    {"OneOfTwoDwellsIsLonger", kPlunged + "X60\nG04 P1\nG04 P2\nG00 X99\nM02\n",
     kPlunged + "X61\nG04 P1\nG04 P3\nG00 X99\nM02\n",
     "moved 5|5: moved by X1\ndwell 7|7: dwell of 3 s instead of 2 s\n"},
    {"Dwell", kHead + "G04 P1\nM02\n", kHead + "G04 P1.5\nM02\n", "dwell 4|4: dwell of 1.5 s instead of 1 s\n"},
    {"ExactStop", kSquare, square("X100\n", "X100 G09\n"), "function -|5: added: G09\n"},
    {"Path", kHead + "IF VGPL = 1 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nX110\nX120\nM02\n",
     kHead + "IF VGPL = 0 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nX110\nX120\nM02\n",
     "path 5-6|4: another path: the IF of line 4 jumps in the new program only (0 motions instead of 2)\n"},
    {"PathAfterALineInParts", kHead + "X40\nIF VGPL = 1 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nX110\nX120\nM02\n",
     kHead + "X25\nX40\nIF VGPL = 0 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nX110\nX120\nM02\n",
     "path 6-7|6: another path: the IF of line 6 jumps in the new program only (0 motions instead of 2)\n"},
    {"PathBeforeAnotherFeed", kPlunged + "IF VGPL = 1 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nX110\nX120\nM02\n",
     kPlunged + "IF VGPL = 0 GOTO N5\nX50\nX70\nN5 X90 Y90 F3000\nX100 F2000\nX110\nX120\nM02\n",
     "path 6-7|5: another path: the IF of line 5 jumps in the new program only (0 motions instead of 2)\n"
     "feed 8|8: F3000 instead of F2000\n"},
    {"JumpBesideADwell", kPlunged + "G04 P1\nX50\nM02\n",
     kPlunged + "G04 P2\nIF VGPL = 0 GOTO N9\nG00 X99\nN9\nX50\nM02\n", "dwell 5|5: dwell of 2 s instead of 1 s\n"},
    {"JumpBesideATool", "M06 T101001\nS9000 M03\nM02\n",
     "M06 T101002\nIF VGPL = 0 GOTO N9\nS1 M04\nN9\nS9000 M03\nM02\n", "tool 1|1: T101002 instead of T101001\n"},
    {"JumpWithoutIfInTheOtherProgram", kHead + "X20\nX50 Y50\nX70 Y0\nN5 X90 Y90\nX100\nY110\nX120\nM02\n",
     kHead + "X20\nIF VGPL = 0 GOTO N5\nX50 Y50\nX70 Y0\nN5 X90 Y90\nX100\nY110\nX120\nM02\n",
     "path 5-6|5: another path: the IF of line 5 jumps in the new program only (0 motions instead of 2)\n"},
    {"JumpBeforeAnotherChange", kHead + "X20\nX50 Y50\nX70 Y0\nN5 X90 Y90\nX100\nM08\nY110\nX120\nM02\n",
     kHead + "X20\nIF VGPL = 0 GOTO N5\nX50 Y50\nX70 Y0\nN5 X90.5 Y90\nX100\nM08\nY110\nX120\nM02\n",
     "path 5-6|5: another path: the IF of line 5 jumps in the new program only (0 motions instead of 2)\n"
     "moved 7|8: moved by X0.5\n"},
    {"JumpToAnotherBranch",
     kHead + "IF VGPL = 1 GOTO N5\nX50 Y50\nX70\nIF V1 = 0 GOTO N6\nN5 X20 Y30\nX90\nN6 X99 Y99\nX110\nY120\nM02\n",
     kHead + "IF VGPL = 0 GOTO N5\nX50 Y50\nX70\nIF V1 = 0 GOTO N6\nN5 X20 Y30\nX90\nN6 X99 Y99\nX110\nY120\nM02\n",
     "path 5-6|4-9: another path: the IF of line 4 jumps in the new program only (2 motions instead of 2)\n"},
    {"JumpAfterAnotherChange", kHead + "G04 P1\nIF VGPL = 1 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nY110\nX120\nM02\n",
     kHead + "G04 P2\nIF VGPL = 0 GOTO N5\nX50\nX70\nN5 X90 Y90\nX100\nY110\nX120\nM02\n",
     "dwell 4|4: dwell of 2 s instead of 1 s\n"
     "path 6-7|5: another path: the IF of line 5 jumps in the new program only (0 motions instead of 2)\n"},
    {"Error", kHead + "G02 X30 Y0 R20 F500\nG01 X7\nM02\n", kHead + "G02 X30 Y0 R2 F500\nG01 X7\nM02\n",
     "end 4-6|4: ends with ISO030 instead of M02: from here on 0 motions instead of 2\n"},
    {"OtherWayAroundBeforeAnError", kPlunged + "G03 X50 Y20 I30 J20\nG01 Y80\nG02 X30 Y60 R20\nG01 X7\nM02\n",
     kPlunged + "G02 X50 Y20 I30 J20\nG01 Y80\nG02 X30 Y60 R2\nG01 X7\nM02\n",
     "shape 5|5: another path, up to 28.284 mm away\n"
     "end 7-9|7: ends with ISO030 instead of M02: from here on 0 motions instead of 2\n"},
    // A motion that one program alone has as its last one is listed before the end.
    {"MotionBeforeAnotherEnd", kPlunged + "X50 Y60\nX70 Y10\nX90 Y80\nGOTO N99\n",
     kPlunged + "X70 Y10\nX90 Y80\nX20 Y5\nM02\n",
     "removed 5|5: removed: 1 motion; the next one takes another path, up to 46.032 mm away\n"
     "added -|7: added: 1 motion\n"
     "end 8|8: ends with M02 instead of E003\n"},

    // Several at once.
    {"TwoFarApart", kSquare, replaced(square("S12000", "S9000"), "G00 Z40\nM02", "G00 Z30\nM02"),
     "speed 2|2: S9000 M03 instead of S12000 M03\nmoved 9|9: moved by Z-10\n"},
    {"CoordinateAndFeed", kHead + "G01 X50 Y50 F500\nX100 Y0\nM02\n", kHead + "G01 X50 Y51 F400\nX100 Y0\nM02\n",
     "moved 4|4: moved by Y1\nfeed 4-5|4-5: F400 instead of F500\n"},
};

const ComparisonCase kTurnsAndOrders[] = {
    // A B or C that is lost tilts all that follows. Where it turns, 180 mm from the pivot, the tip swings by 180 (1 -
    // cos 22.5).
    {"TurnLost", kHead + "B45\nX50 Y9\nG01 Z0 F500\nX90\nM02\n", kHead + "X50 Y9\nG01 Z0 F500\nX90\nM02\n",
     "shape 4-7|4-6: another path, 3 motions instead of 4, up to 13.702 mm away, B or C turned by up to 45 degrees\n"},
    {"TurnAndBackLost", kPlunged + "G49\nX50\nC30\nC0\nX60\nM02\n", kPlunged + "G49\nX50\nX60\nM02\n",
     "removed 7-8|-: removed: 2 motions\n"},
    {"TurnOfALineLost", kHead + "X60 C90\nX80\nX90\nM02\n", kHead + "X60\nX80\nX90\nM02\n",
     "shape 4-6|4-6: B or C turned by up to 90 degrees\n"},
    // At X60, 0.4 of the way, the line that turns from B10 to B34 has B19.6.
    {"TurnOfAPlaceOnALineLost", kHead + "G49\nG01 X20 B10 F500\nX60 B13\nX120 B30\nY50\nM02\n",
     kHead + "G49\nG01 X20 B10 F500\nX120 B34\nY50 B30\nM02\n",
     "shape 6-7|6: another path, 1 motion instead of 2, B or C turned by up to 6.6 degrees\n"},
    // How deep a hole is says nothing about the way beside it.
    {"DeepHoleGained", kHead + "X20 Y0\nG01 Z0 F500\nG00 Z40\nX60\nG01 Z0\nG00 Z40\nM02\n",
     kHead + "X20 Y0\nG01 Z0 F500\nG00 Z40\nX40 Y30\nG01 Z-100\nG00 Z40\nX60 Y0\nG01 Z0\nG00 Z40\nM02\n",
     "added 7|7-9: added: 3 motions; the next one takes another path, up to 30 mm away\n"},
    // What another tool does elsewhere in the same way has not been moved.
    {"SpindleStartBeforeTheToolChangeOfOneOfThree", plates(false), plates(true),
     "reordered 11-12|11-12: order changed\nspeed 14-18|14-18: the spindle stands still, was S9000 M03\n"},
    {"FramesOfTwoLines", kHead + "G92 X5 Y0 Z0\nX50\nY9\nG92 X25 Y0 Z0\nX60\nY3\nX7\nM02\n",
     kHead + "G92 X6 Y0 Z0\nX50\nY9\nG92 X26 Y0 Z0\nX60\nY3\nX7\nM02\n",
     "frame 5-6|5-6: moved by X1: the frame of line 4 is elsewhere\n"
     "frame 8-10|8-10: moved by X1: the frame of line 7 is elsewhere\n"},
    // The first one of them leaves out the rapids to where the one before it has ended.
    {"OperationsThatBeginInOnePlaceSwapped", nested("123"), nested("213"),
     "reordered 10-18|1-9: order changed: now the first one, was after T101001\n"},
    {"FirstOperationThatBeginsInOnePlaceIsLast", nested("123"), nested("231"),
     "reordered 1-9|19-27: order changed: now after T101003, was the first one\n"},
    // Each begins with a rapid to its height, which goes nowhere after another operation.
    {"OperationsThatBeginAtOneHeightSwapped", at_height("123"), at_height("213"),
     "reordered 9-16|1-8: order changed: now the first one, was after T101001\n"},
    {"ParameterInItsFifthDecimal", kHead + "M110 P1=4.5\nM02\n", kHead + "M110 P1=4.50001\nM02\n",
     "function 4|4: M110 P1=4.50001 instead of M110 P1=4.5\n"},
};

class ComparisonTable : public testing::TestWithParam<ComparisonCase> {};

TEST_P(ComparisonTable, NamesTheChanges) {
  EXPECT_EQ(shown(changes_between(GetParam().old_program, GetParam().new_program)), GetParam().changes);
}

INSTANTIATE_TEST_SUITE_P(Programs, ComparisonTable, testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(TurnsAndOrders, ComparisonTable, testing::ValuesIn(kTurnsAndOrders),
                         [](const auto& info) { return std::string(info.param.name); });

/// What is added within a line leaves the rest of that line to the next motion.
TEST(Comparison, TimesMotionsThatAreAddedWithinALine) {
  const RecordedRun old_run = recorded(kPlunged + "X1010 F2000\nM02\n");
  const RecordedRun new_run = recorded(kPlunged + "X500 F2000\nZ10\nZ-5\nX1010\nM02\n");
  const std::vector<BehaviorChange> changes = compare(old_run, new_run, {});
  ASSERT_EQ(shown(changes), "added -|5-7: added: 3 motions\n");
  EXPECT_NEAR(changes.front().seconds, new_run.seconds - old_run.seconds, 0.1);
}

TEST(Comparison, WritesSecondsAsTheyAre) {
  const RecordedRun old_run = recorded(kHead + "G04 P1\nM02\n");
  const RecordedRun new_run = recorded(kHead + "G04 P11.5\nM02\n");
  const std::vector<BehaviorChange> changes = compare(old_run, new_run, {});
  const nlohmann::ordered_json json = changes_json({old_run, new_run, changes}, dialect::Language::English);
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["seconds"], 10.5);
}

/// With a large tolerance, ways that differ by less than it have no order.
TEST(Comparison, TakesNoBumpForAnotherOrder) {
  const std::string old_program = kPlunged + "X10 Y5\nX20 Y1\nX30 Y0\nX40 Y3\nX50 Y9\nM02\n";
  const std::string new_program = kPlunged + "X10 Y5.06\nX20 Y1.12\nX30 Y0.12\nX40 Y3.06\nX50 Y9\nM02\n";
  EXPECT_EQ(shown(changes_between(old_program, new_program, {.tolerance = 0.1})), "moved 6-7|6-7: moved by Y0.12\n");
}

/// What the change itself takes, where it begins or ends within a line of the other program.
TEST(Comparison, TimesAFeedOnAPartOfALine) {
  const auto check = [](const std::string& old_words, const std::string& new_words) {
    const RecordedRun old_run = recorded(kPlunged + old_words + "M02\n");
    const RecordedRun new_run = recorded(kPlunged + new_words + "M02\n");
    const std::vector<BehaviorChange> changes = compare(old_run, new_run, {});
    double seconds = 0;
    for (const BehaviorChange& change : changes) seconds += change.seconds;
    EXPECT_NEAR(seconds, new_run.seconds - old_run.seconds, 0.1) << old_words << new_words;
  };
  check("X110 F500\n", "X60 F500\nX110 F700\n");
  check("X110 F500\n", "X30 F500\nX60 F700\nX110 F500\n");
  check("X60 F500\nX110 F700\n", "X110 F500\n");
  check("X30 F500\nX110 F500\n", "X60 F300\nX110 F700\n");
}

TEST(Comparison, IgnoresWhatIsAskedFor) {
  const std::string changed = kHead + "G04 P2\n" + "G01 X50 F500 G09\nM02\n";
  const std::string old_program = "M06 T101001\nS9000 M03\nG00 X10 Y20 Z40\nG04 P1\nG01 X50 F600\nM02\n";
  EXPECT_EQ(shown(changes_between(old_program, changed)),
            "speed 2|2: S12000 M03 instead of S9000 M03\ndwell 4|4: dwell of 2 s instead of 1 s\n"
            "feed 5|5: F500 instead of F600\nfunction -|5: added: G09\n");
  EXPECT_EQ(shown(changes_between(old_program, changed, {.ignores_time = true})),
            "speed 2|2: S12000 M03 instead of S9000 M03\nfeed 5|5: F500 instead of F600\n");
  EXPECT_EQ(
      shown(changes_between(old_program, changed, {.ignores_feed = true, .ignores_speed = true, .ignores_time = true})),
      "");
}

/// What is ignored takes nothing else with it.
TEST(Comparison, NamesWhatStandsBesideWhatIsIgnored) {
  const std::string old_program = kPlunged + "G04 P1\nG03 X10 Y20 I30 J20\nG01 X20 G09\nG03 X40 Y20 R10\nM02\n";
  const std::string new_program =
      replaced(kPlunged, "M03", "M04") + "G04 P2\nG03 X10 Y20 I15 J20\nG01 X20\nG02 X40 Y20 R10\nM02\n";
  EXPECT_EQ(shown(changes_between(old_program, new_program, {.ignores_speed = true, .ignores_time = true})),
            "shape 6|6: another path, up to 30 mm away\nshape 8|8: another path, up to 14.142 mm away\n");
  EXPECT_EQ(shown(changes_between(kPlunged + "G04 P1\nX50\nM02\n",
                                  kPlunged + "IF VGPL = 0 GOTO N9\nG00 X99\nN9\nX50\nM02\n", {.ignores_time = true})),
            "");
}

/// More than can be compared, and no motion among it.
TEST(Comparison, SaysWhereThereAreTooManyFunctions) {
  std::string old_program = kHead;
  std::string new_program = kHead;
  for (int i = 0; i < 1100; ++i) {
    old_program += fmt::format("M{}\n", 10 + i * 7 % 40);
    new_program += fmt::format("M{}\n", 50 + i * 11 % 40);
  }
  EXPECT_EQ(shown(changes_between(old_program + "X50\nM02\n", new_program + "X50\nM02\n")),
            "function 4-1103|4-1103: other functions, too many to compare\n");
}

TEST(Comparison, NeverIgnoresARapidInsteadOfAFeedMove) {
  EXPECT_EQ(shown(changes_between(kHead + "G01 X50 F500\nX70 F600\nM02\n", kHead + "G00 X50\nG01 X70 F700\nM02\n",
                                  {.ignores_feed = true})),
            "feed 4|4: G00 instead of F500\n");
}

/// The joints of a rapid that turns B go straight, not its tip: the pivot of the head is 180 mm above it.
TEST(Comparison, ARapidThatTurnsTakesAnotherPath) {
  const std::vector<BehaviorChange> changes =
      changes_between(kHead + "G49\nG01 B60 F500 X10\nM02\n", kHead + "G49\nG00 B60 X10\nM02\n");
  ASSERT_EQ(changes.size(), 2U) << shown(changes);
  EXPECT_EQ(changes[0].kind, ChangeKind::Shape);
  // Half of the way the tip is off by 180 mm of what the chord of B from 0 to 60 degrees is off its arc.
  EXPECT_NEAR(changes[0].distance.value_or(0), 180 * (1 - std::cos(30 * std::acos(-1.0) / 180)), 0.01);
  EXPECT_EQ(changes[1].new_value, "G00");
}

/// B goes from 0 to 60 degrees in one rapid or in two. The joints stand at the same places if X of the head does, which
/// is 180 mm * sin(B) beside the tip: half of the turn is not half of the way of the tip.
TEST(Comparison, ComparesTheWholePathOfRapidsThatTurn) {
  const std::string start = kHead + "G49\n";
  const double pi = std::acos(-1.0);
  // The joints X and Z of the nose's pivot go straight from above the tip at B0 to where it is at B60.
  const auto tip_at = [&](double part) {
    const double b = 60 * part * pi / 180;
    const double x = part * 180 * std::sin(pi / 3) - 180 * std::sin(b);
    const double z = part * 180 * (std::cos(pi / 3) - 1) - 180 * (std::cos(b) - 1);
    return fmt::format("X{:.5f} Z{:.5f} B{}", 10 + x, 40 + z, 60 * part);
  };
  const std::string one = start + "G00 B60\nM02\n";
  const auto in_two = [&](const std::string& middle) { return start + "G00 " + middle + "\nX10 Z40 B60\nM02\n"; };
  const std::string on_the_way = shown(changes_between(one, in_two(tip_at(0.5))));
  const std::string beside = shown(changes_between(one, in_two("X10 Z40 B30")));
  EXPECT_EQ(on_the_way, "") << tip_at(0.5);
  EXPECT_NE(beside, "");
  // Another machine leads the tip otherwise between the same ends.
  timing::TimedMachine other = machine_of_tests();
  other.motion.kinematics.pivot += 50;
  const std::vector<BehaviorChange> changes = compare(recorded(one), record(one, {}, other), {});
  ASSERT_EQ(changes.size(), 1U) << shown(changes);
  EXPECT_EQ(changes[0].kind, ChangeKind::Shape);
  EXPECT_GT(changes[0].distance.value_or(0), 1);
}

/// The same with a tool that is 100 mm long: the tip is 280 mm below the pivot.
TEST(Comparison, ComparesTheWholePathOfRapidsThatTurnATool) {
  timing::TimedMachine machine = machine_of_tests();
  machine.tool_lengths = {{execution::tool_code(101001), 100}};
  const double pi = std::acos(-1.0);
  const double x = 10 + 280 * (std::sin(pi / 3) / 2 - std::sin(pi / 6));
  const double z = 40 + 280 * ((1 + std::cos(pi / 3)) / 2 - std::cos(pi / 6));
  const std::string whole = kHead + "G49\nG00 B60\nM02\n";
  const std::string parts = kHead + fmt::format("G49\nG00 X{:.5f} Z{:.5f} B30\nX10 Z40 B60\nM02\n", x, z);
  EXPECT_EQ(shown(compare(record(whole, {}, machine), record(parts, {}, machine), {})), "") << parts;
}

/// Where each joint goes at its own speed, a place on the line between the ends is not on the way.
TEST(Comparison, ComparesTheWholePathOfIndependentRapids) {
  timing::TimedMachine machine = machine_of_tests();
  const auto shown_on = [&](const std::string& one, const std::string& other) {
    return shown(compare(record(one, {}, machine), record(other, {}, machine), {}));
  };
  const std::string one = kHead + "X310 Y80\nM02\n";
  const std::string in_two = kHead + "X160 Y50\nX310 Y80\nM02\n";
  const std::string with_y_first = kHead + "Y80\nX310\nM02\n";
  EXPECT_EQ(shown_on(one, in_two), "");
  machine.motion.rapid_motion = kinematics::RapidMotion::Independent;
  EXPECT_NE(shown_on(one, in_two), "");
  EXPECT_NE(shown_on(one, with_y_first), "");
  EXPECT_EQ(shown_on(one, one), "");
  // Y has arrived long before X is there: the rest of the way is a line, a place on which is on the way.
  EXPECT_EQ(shown_on(one, kHead + "X160 Y80\nX310\nM02\n"), "");
  EXPECT_EQ(shown_on(one, kHead + "X160 Y80\nX310 Y80.5\nM02\n"),
            "shape 4|4-5: another path, 2 motions instead of 1, up to 0.5 mm away\n");
  EXPECT_EQ(shown_on(one, replaced(one, "X310", "X312")), "moved 4|4: moved by X2\n");
  // Motions of one axis are lines on every machine.
  EXPECT_EQ(shown_on(with_y_first, kHead + "Y50\nY80\nX310\nM02\n"), "");
}

/// Of a contour that is larger by 0.01 mm each motion is moved by another vector, though neighbors are moved by the
/// same within the tolerance.
TEST(Comparison, NamesAContourOfAnotherSizeOnce) {
  const auto contour = [](double radius) {
    std::string program = kHead + fmt::format("G00 X{:.4f} Y0\nG01 Z-5 F1000\n", radius);
    for (int i = 1; i <= 100; ++i) {
      const double angle = i * std::acos(-1.0) / 50;
      program += fmt::format("X{:.4f} Y{:.4f}\n", radius * std::cos(angle), radius * std::sin(angle));
    }
    return program + "G00 Z40\nX0 Y0\nM02\n";
  };
  EXPECT_EQ(shown(changes_between(contour(100), contour(100.01))), "moved 4-106|4-106: moved by up to 0.01 mm\n");
  // Two increments that change remain two.
  const auto steps = [](const std::string& first, const std::string& second) {
    const std::string rest = "Y5\nX-18\nY6\nX30\nZ-1\nY-7\n";
    return kHead + "G91\n" + first + "\n" + rest + second + "\n" + rest + "M02\n";
  };
  EXPECT_EQ(shown(changes_between(steps("X20", "X21"), steps("X21", "X21.2"))),
            "moved 5-11|5-11: moved by X1\nmoved 12-18|12-18: moved by X1.2\n");
}

/// In a frame that is turned each motion is moved otherwise, and all of them are one change.
TEST(Comparison, NamesATurnedFrameOnce) {
  const auto in_frame = [](const std::string& angle) {
    return "G92 X0 Y0 Z0\nM06 T101001\nS12000 M03\nG29 X100 Y50 Z20 B" + angle +
           " C0\nG00 X0 Y0 Z50\nZ5\nG01 Z-2 F2000\nX50\nG03 X50 Y30 I50 J15\nG01 X0\nY0\nG00 Z50\nG27\n"
           "G00 X0 Y0 Z200\nM02\n";
  };
  // The tip is farthest from the origin of the frame at X65 Y15 Z-2 or X50 Z5: 2 * 65.03 * sin(5 degrees / 2).
  for (const auto& [angle, distance] : {std::pair("35", 5.67), std::pair("30.02", 0.0227)}) {
    const std::vector<BehaviorChange> changes = changes_between(in_frame("30"), in_frame(angle));
    ASSERT_EQ(changes.size(), 1U) << shown(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::Frame);
    EXPECT_EQ(changes[0].old_cause, std::optional<std::size_t>(3));
    EXPECT_EQ(changes[0].old_lines, (ChangedLines{4, 11}));
    ASSERT_TRUE(changes[0].distance);
    EXPECT_LT(*changes[0].distance, 1.001 * distance);
    EXPECT_GT(*changes[0].distance, distance / 2) << "as far as a path may be beside its neighbors";
    EXPECT_NE(in_words(changes[0], dialect::Language::English).find(": the frame of line 4 is turned"),
              std::string::npos);
  }
  // So are arcs in it whose numbers the tolerance allows.
  const std::vector<BehaviorChange> rounded =
      changes_between(in_frame("30"), replaced(in_frame("35"), "X50 Y30", "X50.0005 Y30"));
  ASSERT_EQ(rounded.size(), 1U) << shown(rounded);
  EXPECT_EQ(rounded[0].kind, ChangeKind::Frame);
  // An arc that goes the other way around is more than that.
  const std::vector<BehaviorChange> around = changes_between(in_frame("30"), replaced(in_frame("35"), "G03", "G02"));
  EXPECT_TRUE(std::any_of(around.begin(), around.end(), [](const BehaviorChange& each) {
    return each.kind == ChangeKind::Shape;
  })) << shown(around);
  // So is a full circle around another center.
  const auto circle = [&](const std::string& angle, const std::string& center) {
    return replaced(in_frame(angle), "G03 X50 Y30 I50 J15", "G03 X50 Y0 I50 " + center);
  };
  EXPECT_EQ(changes_between(circle("30", "J15"), circle("35", "J15")).size(), 1U);
  const std::vector<BehaviorChange> elsewhere = changes_between(circle("30", "J15"), circle("35", "J10"));
  EXPECT_TRUE(std::any_of(elsewhere.begin(), elsewhere.end(), [](const BehaviorChange& each) {
    return each.kind == ChangeKind::Shape;
  })) << shown(elsewhere);
  // A motion that is moved within the frame as well is one of its own.
  std::string other = in_frame("35");
  other.replace(other.find("X50\n"), 4, "X53\n");
  const std::vector<BehaviorChange> both = changes_between(in_frame("30"), other);
  EXPECT_TRUE(std::any_of(both.begin(), both.end(), [](const BehaviorChange& each) {
    return each.kind != ChangeKind::Frame;
  })) << shown(both);
}

/// What one program has between motions that are moved by nearly the same vector divides them.
TEST(Comparison, NamesMovedMotionsBesideWhatOneProgramHasAlone) {
  const auto zigzag = [](double first, double second, const std::string& between) {
    std::string program = kPlunged;
    for (int i = 0; i < 10; ++i) {
      if (i == 5) program += between;
      program += fmt::format("X{} Y{}\n", 50 + 20 * i + (i < 5 ? first : second), 40 + i % 2 * 7);
    }
    return program + "G00 Z40\nM02\n";
  };
  const std::string old_program = zigzag(0, 0, "");
  EXPECT_EQ(shown(changes_between(old_program, zigzag(1, 1.003, ""))), "moved 5-15|5-15: moved by up to 1.003 mm\n");
  EXPECT_EQ(shown(changes_between(old_program, zigzag(1, 1.003, "X135 Y90\n"))),
            "moved 5-9|5-9: moved by X1\n"
            "added 10|10: added: 1 motion; the next one takes another path, up to 45.872 mm away\n"
            "moved 10-15|11-16: moved by X1.003\n");
}

/// More motions than those among which a difference is looked for in all ways, after which a program goes on from where
/// it was; the other program has more of its own later, as each of the two may be the longer one.
TEST(Comparison, NamesALongDetourThatEndsWhereItBegan) {
  const auto detour = [](int x, int count, int bend) {
    std::string text;
    for (int i = 0; i < count; ++i) text += fmt::format("X{} Y{}\n", x + 3 * i, 50 + i * i * bend % 37);
    return text;
  };
  const auto program = [](const std::string& first, const std::string& second) {
    return kPlunged + "X50 Y50\nY60\nX60\n" + first + "Y-50\nX7\nX3 Y99\nX1 Y90\n" + second +
           "X-40\nX-45 Y3\nX-90 Y4\nX-91\nG00 Z40\nM02\n";
  };
  EXPECT_EQ(shown(changes_between(program(detour(70, 60, 1) + "X60 Y60\n", ""),
                                  program("", detour(500, 90, 2) + "X1 Y90\n"))),
            "removed 8-68|-: removed: 61 motions\nadded -|12-102: added: 91 motions\n");
}

/// A vertical stroke occurs many times and is no anchor; the place of each hole is one.
TEST(Anchors, OccurOnceInEachRun) {
  std::string program = kHead;
  for (int hole = 1; hole <= 4; ++hole) program += fmt::format("G00 X{} Y0 Z2\nG01 Z-3 F500\nG00 Z2\n", 20 * hole);
  const RecordedRun run = recorded(program + "G00 X20 Y0 Z2\nM02\n");
  const RunPair pair{run, run, 0.001};
  const Anchors anchors(pair);
  std::vector<std::size_t> lines;
  PlaceInBoth place;
  while (const std::optional<PlaceInBoth> next = anchors.next(place, Anchors::AnchorRow::Place)) {
    EXPECT_EQ(next->a, next->b);
    lines.push_back(run.actions[next->a].line + 1);
    place = {next->a + 1, next->b + 1};
  }
  // The tool, the first place, the holes' bottoms; the upper place of each hole is reached twice or more.
  EXPECT_EQ(lines, (std::vector<std::size_t>{1, 3, 5, 8, 11, 14}));
}

/// With a large tolerance, neighbors have one place, but each its own numbers.
TEST(Anchors, AreFoundByNumbersWhateverTheToleranceIs) {
  const RecordedRun run = recorded(kPlunged + "X10.5\nX11\nX11.5\nX12\nM02\n");
  const RunPair pair{run, run, 1};
  const Anchors anchors(pair);
  const PlaceInBoth after_plunge{4, 4};
  const auto line_after = [&](Anchors::AnchorRow row) {
    const std::optional<PlaceInBoth> next = anchors.next(after_plunge, row);
    return next ? std::optional(run.actions[next->a].line + 1) : std::nullopt;
  };
  EXPECT_EQ(line_after(Anchors::AnchorRow::Numbers), std::optional(5U));
  EXPECT_EQ(line_after(Anchors::AnchorRow::Place), std::nullopt);
}

/// Two chains of places in a plane, and whether they go along each other within 1 mm.
struct ChainCase {
  const char* name;
  std::vector<std::pair<double, double>> a;
  std::vector<std::pair<double, double>> b;
  bool goes_along;
};

const ChainCase kChains[] = {
    {"Itself", {{0, 0}, {10, 0}}, {{0, 0}, {10, 0}}, true},
    {"OtherParts", {{0, 0}, {4, 0}, {10, 0}}, {{0, 0}, {7, 0}, {10, 0}}, true},
    {"Beside", {{0, 0}, {10, 0}}, {{0, 1}, {10, 1}}, true},
    {"TooFar", {{0, 0}, {10, 0}}, {{0, 1.1}, {10, 1.1}}, false},
    {"OtherStart", {{0, 0}, {10, 0}}, {{-2, 0}, {10, 0}}, false},
    {"OtherEnd", {{0, 0}, {10, 0}}, {{0, 0}, {12, 0}}, false},
    {"BackABit", {{0, 0}, {10, 0}}, {{0, 0}, {6, 0}, {4.5, 0}, {10, 0}}, true},
    {"BackTooFar", {{0, 0}, {10, 0}}, {{0, 0}, {6, 0}, {3, 0}, {10, 0}}, false},
    {"StepsAroundTheStart", {{0, 0}, {10, 0}}, {{0, 0}, {-0.9, 0}, {0, 0.9}, {0, 0}, {10, 0}}, true},
    {"StepsTooFarFromTheStart", {{0, 0}, {10, 0}}, {{0, 0}, {-1.1, 0}, {0, 0.9}, {0, 0}, {10, 0}}, false},
    {"StepsAroundBothStarts", {{0, 0}, {0, 0.4}, {0.4, 0}, {10, 0}}, {{0, 0}, {-0.4, 0}, {0, -0.4}, {10, 0}}, true},
    {"StepsAroundTheEnd", {{0, 0}, {10, 0}}, {{0, 0}, {10, 0}, {10.9, 0}, {10, 0.9}, {10, 0}}, true},
    {"APlaceTwice", {{0, 0}, {5, 0}, {5, 0}, {10, 0}}, {{0, 0}, {5, 0}, {10, 0}}, true},
    {"APlaceTwiceAway", {{0, 0}, {5, 2}, {5, 2}, {10, 0}}, {{0, 0}, {10, 0}}, false},
    {"AwayFromAPlaceTwice", {{0, 0}, {9, 0}, {9, 0}, {20, 0}}, {{0, 0}, {9, 0}, {9, 30}, {9, 0}, {20, 0}}, false},
    {"OnePlaceTwiceOnly", {{0, 0}, {0, 0}}, {{0, 0}, {0.5, 0}, {0, 0}}, true},
    {"CircleTheOtherWayAround", {{0, 0}, {5, 0}, {5, 5}, {0, 0}}, {{0, 0}, {5, 5}, {5, 0}, {0, 0}}, false},
};

TEST(ActionPath, ChainsGoAlongEachOther) {
  const auto chain = [](const std::vector<std::pair<double, double>>& places) {
    std::vector<geometry::Vec3> points;
    for (const auto& [x, y] : places) points.emplace_back(x, y, 0);
    return points;
  };
  for (const ChainCase& each : kChains) {
    EXPECT_EQ(goes_along(chain(each.a), chain(each.b), 1), each.goes_along) << each.name;
    EXPECT_EQ(goes_along(chain(each.b), chain(each.a), 1), each.goes_along) << each.name << ", exchanged";
  }
}

/// What one distance takes is no longer left for others.
TEST(ActionPath, DistancesTakeFromWhatIsLeft) {
  const std::vector<geometry::Vec3> chain = {{0, 0, 0}, {10, 0, 0}};
  const std::vector<geometry::Vec3> other = {{0, 3, 0}, {10, 3, 0}};
  std::size_t left = 100;
  EXPECT_EQ(distance_from(chain, other, 0.001, &left), std::optional(3.0));
  EXPECT_LT(left, 100U);
  EXPECT_GT(left, 80U) << "two lines";
  left = 0;
  EXPECT_EQ(distance_from(chain, other, 0.001, &left), std::nullopt);
  EXPECT_EQ(left, 0U);
}

/// Each end of each motion from each motion of the other path, in both ways.
TEST(ActionPath, TurnsTakeFromWhatIsLeft) {
  const RecordedRun one = recorded("M06 T101001\nG00 X10\nX20\nM02\n");
  const RecordedRun other = recorded("M06 T101001\nG00 X10\nX15\nX20\nM02\n");
  const auto motions = [](const RecordedRun& run) { return std::span(run.actions).subspan(1, run.actions.size() - 2); };
  constexpr std::size_t kAll = 2 * 2 * 3 * 2;
  std::size_t left = kAll;
  EXPECT_EQ(turn_between(motions(one), motions(other), geometry::Vec3::Zero(), &left), std::optional(0.0));
  EXPECT_EQ(left, 0U);
  left = kAll - 1;
  EXPECT_EQ(turn_between(motions(one), motions(other), geometry::Vec3::Zero(), &left), std::nullopt);
}

/// Both runs are passed through from their starts to their ends, whichever is the old one.
TEST(AlignedSteps, AreMirroredIfTheRunsAreSwapped) {
  const RecordedRun one = recorded(kSquare);
  const RecordedRun other = recorded(square("X100\n", "X40\nM08\nX101\nY50\n"));
  const std::vector<AlignedStep> there = aligned_steps(one, other, 0.001);
  const std::vector<AlignedStep> back = aligned_steps(other, one, 0.001);
  ASSERT_EQ(there.size(), back.size());
  AlignedStep last;
  for (std::size_t i = 0; i < there.size(); ++i) {
    EXPECT_EQ(there[i].old_begin, last.old_end);
    EXPECT_EQ(there[i].new_begin, last.new_end);
    last = there[i];
    EXPECT_EQ(std::tie(back[i].old_begin, back[i].old_end), std::tie(last.new_begin, last.new_end));
    EXPECT_EQ(std::tie(back[i].new_begin, back[i].new_end), std::tie(last.old_begin, last.old_end));
  }
  EXPECT_EQ(last.old_end, one.actions.size());
  EXPECT_EQ(last.new_end, other.actions.size());
}

TEST(Comparison, ToleranceDecides) {
  EXPECT_EQ(shown(changes_between(kSquare, square("X100\n", "X100.05\n"), {.tolerance = 0.06})), "");
  EXPECT_EQ(shown(changes_between(kSquare, square("X100\n", "X100.05\n"), {.tolerance = 0.04})),
            "moved 5-6|5-6: moved by X0.05\n");
}

/// However large the tolerance is beside the radius, a half circle the other way around is another path.
TEST(Comparison, NamesArcsTheOtherWayAroundWithAnyTolerance) {
  const auto half_circle = [](const std::string& function, double radius) {
    return fmt::format("{}G01 X0 Y0 F500\n{} X{} Y0 I{} J0\nG01 Y50\nX0\nM02\n", kHead, function, 2 * radius, radius);
  };
  for (const auto& [radius, tolerance] : {std::pair(100.0, 0.1), std::pair(1.2, 1.0)})
    EXPECT_EQ(shown(changes_between(half_circle("G02", radius), half_circle("G03", radius), {.tolerance = tolerance})),
              fmt::format("shape 5|5: another path, up to {:.3f} mm away\n", radius * std::sqrt(2)));
}

TEST(Comparison, OnlyTwoArcsInOnePlaneAreTheOtherWayAround) {
  const auto first_feed = [](const RecordedRun& run) {
    return *std::find_if(run.actions.begin(), run.actions.end(),
                         [](const MachineAction& each) { return each.is_motion() && !each.is_rapid; });
  };
  const auto is_other_way = [&](const std::string& one, const std::string& other) {
    const RecordedRun a = recorded(kHead + one + " F500\nM02\n");
    const RecordedRun b = recorded(kHead + other + " F500\nM02\n");
    return is_other_way_around({a, b, 0.001}, first_feed(a), first_feed(b));
  };
  const std::string circle = "G02 X10 Y20 I15 J20";
  EXPECT_TRUE(is_other_way(circle, "G03 X10 Y20 I15 J20"));
  EXPECT_FALSE(is_other_way(circle, circle));
  EXPECT_FALSE(is_other_way(circle, "G18 G03 X10 Z40 I15 K40")) << "a plane across the first one";
  EXPECT_FALSE(is_other_way(circle, "G01 X50"));
  EXPECT_FALSE(is_other_way("G01 X50", circle));
}

/// While B turns, the tip may be anywhere within the tolerance.
TEST(Comparison, TakesATurnInPartsForTheSame) {
  const std::string whole = kHead + "G49\nG01 X20 B10 F500\nX20.04 B30\nY50\nX90\nM02\n";
  for (const char* const middle : {"X20 B20", "X20.02 B20", "X20.04 B20"}) {
    const std::string parts = replaced(whole, "X20.04 B30", fmt::format("{}\nX20.04 B30", middle));
    EXPECT_EQ(shown(changes_between(whole, parts, {.tolerance = 0.1})), "") << middle;
  }
}

/// Around a corner with a tool, under the G words of its contour.
std::string contour(std::string_view tool, std::string_view side) {
  return fmt::format("M06 {}\nS12000 M03\nG00 X0 Y0 Z5\n{}\nG01 X10 Y10 F1000\nY50\nX50\nG40\nG00 X0 Y0\nM02\n", tool,
                     side);
}

/// The control knows radii that the machine of a test does not: T102001 has none here.
TEST(Comparison, NamesTheSideOfCompensationWhereTheRadiusIsUnknown) {
  const auto changes = [](std::string_view old_side, std::string_view new_side) {
    return shown(changes_between(contour("T102001", old_side), contour("T102001", new_side)));
  };
  EXPECT_EQ(changes("G41", "G42"), "function 5-7|5-7: G42 instead of G41\n");
  EXPECT_EQ(changes("", "G42"), "function 5-7|5-7: added: G42\n");
  EXPECT_EQ(changes("G41", ""), "function 5-7|5-7: removed: G41\n");
  EXPECT_EQ(changes("G41", "G41 ;the same"), "");
  EXPECT_EQ(changes("G41\nG01 Z-5 F500", "G01 Z-5 F500\nG41"), "") << "the plunge has no side";
  const auto up_to_the_end = [](std::string_view side) {
    return replaced(contour("T102001", side), "G40\nG00 X0 Y0\n", "G40\n");
  };
  EXPECT_EQ(shown(changes_between(up_to_the_end("G41"), up_to_the_end("G42"))),
            "function 5-7|5-7: G42 instead of G41\n");
  const std::string old_program = contour("T102001", "G41");
  std::string split = contour("T102001", "G41");
  split.replace(split.find("Y50\n"), 4, "Y30\nY50\n");
  EXPECT_EQ(shown(changes_between(old_program, split)), "");
  split.replace(split.find("G41"), 3, "G42");
  EXPECT_EQ(shown(changes_between(old_program, split)), "function 5-7|5-8: G42 instead of G41\n");
}

TEST(Comparison, ShowsTheSideOfCompensationByThePathWhereTheRadiusIsKnown) {
  const std::string text = shown(changes_between(contour("T101001", "G41"), contour("T101001", "G42")));
  EXPECT_NE(text, "");
  EXPECT_EQ(text.find("function"), std::string::npos) << text;
}

/// The tool's radius is 3 mm: so far the path is away from the contour, whatever of it ends beside what.
TEST(Comparison, NamesALostCompensationByTheRadius) {
  const auto program = [](const std::string& turn, const std::string& side) {
    return "M06 T101001\nS1000 M03\nG00 X-40 Y-40 Z10" + turn + "\nG01 Z0 F1000\nX-20 Y-20\n" + side +
           "G01 X0 Y-20\nY50\nX80\nY0\nX-20\nG40\nG00 Z20\nM02\n";
  };
  for (const char* const turn : {"", " C30"}) {
    EXPECT_EQ(shown(changes_between(program(turn, "G41 "), program(turn, ""))),
              "shape 6-12|6-12: another path, 6 motions instead of 9, up to 3 mm away\n")
        << turn;
    EXPECT_EQ(shown(changes_between(program(turn, "G41 "), program(turn, "G41 "))), "") << turn;
  }
}

/// A path of short lines along Y = 5 sin(X / 7), with bumps in Y of some height beside some X.
std::string fine_path(double step, double height, const std::vector<double>& bumps) {
  std::string program = kHead + "G01 Z-5 F2000\n";
  for (int i = 1; i * step < 150; ++i) {
    const double x = i * step;
    double y = 5 * std::sin(x / 7);
    for (const double bump : bumps) y += height * std::exp(-(x - bump) * (x - bump) / 4);
    program += fmt::format("X{:.3f} Y{:.3f}\n", x, y);
  }
  return program + "G00 Z40\nM02\n";
}

/// Each corner is half a tolerance off the line between its neighbors, on the other side, and the lines are nearly one
/// tolerance apart.
TEST(Comparison, NamesWaysOfLinesThatAreJoinedFromParts) {
  const std::string old_program = kPlunged + "X40 Y19.96\nX70 Y20\nG00 Z40\nM02\n";
  const std::string new_program = replaced(kPlunged, "Y20 ", "Y20.09 ") + "X30 Y20.13\nX70 Y20.09\nG00 Z40\nM02\n";
  EXPECT_EQ(shown(changes_between(old_program, new_program, {.tolerance = 0.1})),
            "shape 5-6|5-6: another path, up to 0.16 mm away\n");
  EXPECT_EQ(shown(changes_between(old_program, new_program, {.tolerance = 0.2})), "");
}

/// Each of them has two parts, of which the second one ends where it did.
TEST(Comparison, NamesTheFirstPartsOfTwoLinesThatAreExchanged) {
  const auto program = [](const std::string& first, const std::string& second) {
    return "M06 T101001\nG00 X10 Y" + first + "G00 Z40\nX10 Y" + second + "G00 Z40\nM02\n";
  };
  const std::string one = "20\nG01 Z-5 F2000\nX40 Y19.96\nX70 Y20\n";
  const std::string other = "20.09\nG01 Z-5 F2000\nX40.1 Y20.13\nX70 Y20.09\n";
  EXPECT_EQ(shown(changes_between(program(one, other), program(other, one), {.tolerance = 0.1})),
            "reordered 4|9: order changed\nreordered 9|4: order changed\n");
}

/// Places off a line by less than the tolerance, and a feed that differs by less than 0.01 %.
TEST(Comparison, NamesWhatStandsBesideALineOfOtherPartsAlone) {
  const std::string last = "X60 Y20\nY40\nX30\nG00 Z50\nM02\n";
  const std::string parts = "X13 Y20.04\nX16 Y20.03\nX19 Y20\nX22 Y20.03\nX25 Y20\nX28 Y20.04\n";
  const std::string other_parts = "X14 Y20.03\nX17 Y20\nX20\nX23\nX26\nX29\n";
  EXPECT_EQ(shown(changes_between(kPlunged + parts + last,
                                  replaced(kPlunged, "F2000", "F2000.1") + other_parts + "G04 P1\n" + last,
                                  {.tolerance = 0.05})),
            "dwell -|11: dwell of 1 s added\n");
  const std::string fine = "X11 Y20.02\nX12 Y20\nX13 Y20.04\nX14 Y20\nX15 Y20.02\nX16 Y20.03\nX17 Y20\nX18\n";
  const std::string other_fine = "X11 Y20.04\nX12\nX13 Y20.02\nX14 Y20.04\nX15\nX16 Y20.02\nX17 Y20\nX18\n";
  EXPECT_EQ(shown(changes_between(
                kPlunged + fine + "X19 Y20.02\nX20\nX21 Y20\nX22\n" + last,
                kPlunged + other_fine + "M08\nX19\nX20 Y20.04\nX21 Y20.02\nX22 Y20\nX61\nY40\nX31\n" + "G00 Z50\nM02\n",
                {.tolerance = 0.05})),
            "function -|13: added: M08\nmoved 17-20|18-21: moved by X1\n");
}

/// With a tolerance of two lines of the path, neighbors of what is missing go along it for a while.
TEST(Comparison, NamesAMissingSectionOfAFinePath) {
  std::string whole = fine_path(0.05, 0, {});
  const std::size_t begin = whole.find("X50.000");
  std::string without = whole;
  without.erase(begin, whole.find("X55.000") - begin);
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    const std::vector<BehaviorChange> changes = changes_between(whole, without, {.tolerance = tolerance});
    ASSERT_EQ(changes.size(), 1U) << tolerance << '\n' << shown(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::Removed) << shown(changes);
    EXPECT_EQ(changes[0].old_motions, 100U) << shown(changes);
  }
}

/// Also where the programs differ from their first actions on.
TEST(Comparison, NamesAMissingSectionAfterAnotherTool) {
  const std::string path = fine_path(0.05, 0, {}).substr(kPlunged.size());
  const std::string whole = "M06 T101001\nG00 " + path;
  const std::string without = "M06 T101002\nG00 " + path.substr(path.find("X10.000"));
  for (const double tolerance : {0.001, 0.1, 0.2}) {
    const std::vector<BehaviorChange> changes = changes_between(whole, without, {.tolerance = tolerance});
    ASSERT_EQ(changes.size(), 2U) << tolerance << '\n' << shown(changes);
    EXPECT_EQ(changes[0].kind, ChangeKind::Tool) << shown(changes);
    EXPECT_EQ(changes[1].kind, ChangeKind::Removed) << shown(changes);
    EXPECT_EQ(changes[1].old_motions, 199U) << shown(changes);
  }
}

struct BumpCase {
  double step;
  double height;
  double tolerance;
};

TEST(Comparison, NamesABumpOfAFinePathOnce) {
  // Neighbors of these motions go nearly the same way, and end nearer than the bump is high or the tolerance large.
  for (const auto& [step, height, tolerance] :
       {BumpCase{0.2, 0.5, 0.001}, BumpCase{0.2, 0.12, 0.001}, BumpCase{0.1, 0.05, 0.001}, BumpCase{0.1, 2, 0.001},
        BumpCase{0.05, 0.12, 0.001}, BumpCase{0.05, 0.5, 0.01}, BumpCase{0.1, 0.5, 0.1}, BumpCase{0.05, 0.5, 0.1},
        BumpCase{0.2, 0.5, 0.2}}) {
    const std::string message = fmt::format("step {}, height {}, tolerance {}", step, height, tolerance);
    const std::string old_program = fine_path(step, height, {});
    const std::vector<BehaviorChange> one =
        changes_between(old_program, fine_path(step, height, {60}), {.tolerance = tolerance});
    ASSERT_EQ(one.size(), 1U) << message << '\n' << shown(one);
    EXPECT_EQ(one[0].kind, ChangeKind::Moved) << message << shown(one);
    EXPECT_NEAR(std::max(one[0].distance.value_or(0), one[0].end_distance), height, std::max(0.001, tolerance))
        << message << shown(one);
    // The bump is 0.0004 times as high 5.6 mm beside it.
    const double line_of_middle = 4 + 60 / step;
    EXPECT_NEAR(static_cast<double>(one[0].old_lines->first), line_of_middle, 5.6 / step + 3) << message << shown(one);
    EXPECT_NEAR(static_cast<double>(one[0].old_lines->last), line_of_middle, 5.6 / step + 3) << message << shown(one);
    const std::vector<BehaviorChange> two =
        changes_between(old_program, fine_path(step, height, {30, 90}), {.tolerance = tolerance});
    EXPECT_EQ(two.size(), 2U) << message << '\n' << shown(two);
  }
  for (const double tolerance : {0.1, 0.2})
    EXPECT_EQ(shown(changes_between(fine_path(0.05, 0, {}), fine_path(0.05, 0.09, {60}), {.tolerance = tolerance})),
              "");
}

/// So that the result is the same, mirrored, whichever of two programs is the old one: what makes them differ makes one
/// of them the first one.
TEST(Comparison, ProgramsThatDifferHaveAnOrder) {
  const std::string line = kHead + "G01 X50 F500\nM02\n";
  const std::string arc = kHead + "G02 X50 Y20 I30 J20 F500\nM02\n";
  const std::pair<std::string, std::string> pairs[] = {
      {line, replaced(line, "F500", "F600")},
      {line, replaced(line, "G01 X50 F500", "G93 G01 X50 F500")},
      {line, replaced(line, "G01 X50 F500", "G00 X50")},
      {line, replaced(line, "X50", "X51")},
      {line, replaced(line, "M02", "X60\nM02")},
      {line, replaced(line, "S12000", "S9000")},
      {line, replaced(arc, "G02", "G01")},
      {arc, replaced(arc, "G02", "G03")},
      {arc, replaced(arc, "I30 J20", "I30 J25")},
      {contour("T102001", "G41"), contour("T102001", "G42")},
  };
  for (const auto& [one, other] : pairs) {
    const RecordedRun left = recorded(one);
    const RecordedRun right = recorded(other);
    EXPECT_NE(is_before(left, right), is_before(right, left)) << one << "---\n" << other;
    EXPECT_FALSE(is_before(left, left)) << one;
  }
}

TEST(Comparison, SpeaksItalian) {
  const std::vector<BehaviorChange> changes = changes_between(kSquare, square("X100\n", "X101\n"));
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(in_words(changes[0], dialect::Language::Italian), "spostato di X1");
}

TEST(Comparison, RecordsTotals) {
  const RecordedRun run = recorded(kSquare);
  EXPECT_NEAR(run.feed_mm, 45 + 90 + 60 + 90 + 60, 1e-9);
  EXPECT_NEAR(run.rapid_mm, std::hypot(10, 20, 40) + 45, 1e-9);
  EXPECT_EQ(run.extents[0].maximum, 100);
  EXPECT_EQ(run.extents[2].minimum, -5);
}

/// The lines at which the programs come to each change, from 1.
std::string starts(const std::string& old_program, const std::string& new_program) {
  std::string text;
  for (const BehaviorChange& change : changes_between(old_program, new_program))
    text += fmt::format("{} {}|{}\n", name_of(change.kind), change.old_start + 1, change.new_start + 1);
  return text;
}

TEST(Comparison, NamesWhereEachProgramComesToAChange) {
  EXPECT_EQ(starts(kSquare, square("X100\n", "\nX101\n")), "moved 5|6\n");
  EXPECT_EQ(starts(kSquare, square("G00 Z40", "M100\nG00 Z40")), "function 9|9\n");
  EXPECT_EQ(starts("\n" + square("G00 Z40", "M100\nG00 Z40"), kSquare), "function 10|9\n");
  const std::string jumping = square("X100\n", "IF VGPL = 0 GOTO N7\nX100\nN7\n");
  EXPECT_EQ(starts(square("X100\n", "IF VGPL = 1 GOTO N7\nX100\nN7\n"), "\n" + jumping), "path 5|6\n");
  EXPECT_EQ(starts(operations("123"), "\n" + operations("13")), "removed 10|11\n");
  EXPECT_EQ(starts("\n" + operations("13"), operations("123")), "added 11|10\n");
  EXPECT_EQ(starts(kHead + "M02\n", kHead), "end 4|3\n") << "the last line without M02";
  EXPECT_EQ(starts(kPlunged + "Y100\nM08\nY150\nX9\nM02\n", kPlunged + "Y100\nX50\nX10\nY150\nX9\nM02\n"),
            "function 6|6\nadded 7|6\n");
}

}  // namespace
}  // namespace isocnc::comparison
