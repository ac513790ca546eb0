#include "interpreter/outline/outline_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace isocnc::outline {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kProgram =
    "G71 G90\nG92 X100 Y200 Z50\nM06 T101001\nS12000 M03\nG00 X0 Y0 Z80\nZ2\n"
    "G01 Z-5 F2000\nX40\nY30\nX0 Y0\nG00 Z60\nM02\n";

OutlineOptions options() {
  OutlineOptions made;
  made.name = "part.iso";
  made.run.setup.home.tip = {0, 0, 500};
  made.machine.home = made.run.setup.home;
  made.machine.tool_radii[{1, 1, 1}] = 8;
  made.machine.tool_lengths[{1, 1, 1}] = 120;
  return made;
}

std::string outline_of(std::string_view text, const OutlineOptions& options) {
  const auto made = outline_program(text, options);
  const auto* const program = std::get_if<std::string>(&made);
  return program ? *program : "refused";
}

TEST(OutlineProgram, GoesAroundTheRectangleInTheFrameOfTheProgram) {
  // 5 mm above the highest feed move, which begins at Z2; from where the tool hangs at home, and back.
  EXPECT_EQ(outline_of(kProgram, options()),
            "; around part.iso, at Z7, spindle off: the rectangle\nG71 G90\nG92 X100 Y200 Z50\nM06 T101001\nG00 Z330\n"
            "X-8 Y-8\nZ7\nG01 X48 Y-8 F1000\nX48 Y38\nX-8 Y38\nX-8 Y-8\nG00 Z330\nM02\n");
}

TEST(OutlineProgram, GoesWhereItIsTold) {
  OutlineOptions other = options();
  other.height = 30;
  other.feed = 500;
  other.language = dialect::Language::Italian;
  const std::string program = outline_of(kProgram, other);
  EXPECT_THAT(program, HasSubstr("; intorno a part.iso, a Z30, mandrino fermo: il rettangolo\n"));
  EXPECT_THAT(program, HasSubstr("\nZ30\nG01 X48 Y-8 F500\n"));
  // Above that it goes straight there.
  other.height = 350;
  EXPECT_THAT(outline_of(kProgram, other), HasSubstr("G00 Z350\nX-8 Y-8\nG01 X48"));
}

TEST(OutlineProgram, SaysThatItGoesAroundBelowTheWork) {
  OutlineOptions low = options();
  low.height = -3;
  EXPECT_THAT(
      outline_of(kProgram, low),
      HasSubstr("the rectangle\n; lower than the highest feed move, at Z2: look whether the way around is free\nG71"));
  low.height = 2;
  EXPECT_THAT(outline_of(kProgram, low), Not(HasSubstr("; lower")));
}

TEST(OutlineProgram, GoesToAPlungeOnce) {
  const std::string head = "; not widened for T101002: its radius is not known\nG71 G90\nM06 T101002\nG00 Z500\n";
  const auto around = [](const std::string& moves) {
    return outline_of("M06 T101002\nG00 Z50\n" + moves + "G00 Z50\nM02\n", options());
  };
  EXPECT_THAT(around("G01 Z0 F1000\n"), EndsWith(head + "X0 Y0\nZ55\nG00 Z500\nM02\n"));
  EXPECT_THAT(around("G01 Z0 F1000\nX30\n"), EndsWith(head + "X0 Y0\nZ55\nG01 X30 Y0 F1000\nX0 Y0\nG00 Z500\nM02\n"));
}

TEST(OutlineProgram, KeepsTheClearanceOfTheMachine) {
  OutlineOptions machine = options();
  machine.run.setup.clearance = 25;
  EXPECT_THAT(outline_of(kProgram, machine), HasSubstr("\nZ25\nG01"));
}

TEST(OutlineProgram, ComesFromNoHigherThanTheMachineReaches) {
  OutlineOptions low = options();
  low.machine.motion.axes[kinematics::kZ].maximum =
      240;  // With a tool of 120 mm: Z120 of the machine, Z70 of the frame.
  EXPECT_THAT(outline_of(kProgram, low), HasSubstr("M06 T101001\nG00 Z70\n"));
}

TEST(OutlineProgram, CountsEachToolWithItsRadius) {
  OutlineOptions two = options();
  two.machine.tool_radii[{1, 1, 2}] = 20;
  const std::string text =
      "M06 T101001\nS12000 M03\nG00 X0 Y0 Z50\nG01 Z0 F1000\nX10\nG00 Z50\nM05\nM06 T101002\nS12000 M03\n"
      "G00 X100 Y0 Z50\nG01 Z0 F1000\nX110\nG00 Z50\nM06 T101003\nS12000 M03\nG00 X400 Y0 Z50\nG01 Z0\nG00 Z50\nM02\n";
  const std::string program = outline_of(text, two);
  EXPECT_THAT(program, HasSubstr("X-8 Y-20\n"));
  EXPECT_THAT(program, HasSubstr("X400 Y20\n"));
  EXPECT_THAT(program, HasSubstr("; not widened for T101003: its radius is not known\n"));
  EXPECT_THAT(program, Not(HasSubstr("M03")));
}

TEST(OutlineProgram, GoesUpBetweenTheParts) {
  OutlineOptions path = options();
  path.shape = OutlineShape::Path;
  const std::string text =
      "M06 T101001\nS12000 M03\nG00 X0 Y0 Z50\nG01 Z0 F1000\nX10\nG00 Z50\nX300\nG01 Z0\nG00 Z50\nM02\n";
  const std::string program = outline_of(text, path);
  EXPECT_THAT(program, HasSubstr("\nG00 Z380\nG00 X29"));
}

TEST(OutlineProgram, IsRefusedWhereThereIsNothingToGoAround) {
  const auto idle = outline_program("M06 T101001\nG00 X10\nM02\n", options());
  ASSERT_TRUE(std::holds_alternative<OutlineRefusal>(idle));
  EXPECT_EQ(std::get<OutlineRefusal>(idle).run.ending, running::Ending::ProgramEnd);
  const auto made = outline_program("M06 T101001\nG01 X10 F100\nG02 X5\nM02\n", options());
  ASSERT_TRUE(std::holds_alternative<OutlineRefusal>(made));
  EXPECT_EQ(std::get<OutlineRefusal>(made).run.ending, running::Ending::Error);
}

}  // namespace
}  // namespace isocnc::outline
