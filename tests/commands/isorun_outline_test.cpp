#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kSquare =
    "M06 T101001\nS12000 M03\nG00 X0 Y0 Z50\nZ2\nG01 Z-5 F2000\nX40\nY30\nX0 Y0\nG00 Z50\nM05\nM02\n";

CommandResult outline(std::vector<std::string> options, std::string_view program = kSquare) {
  options.insert(options.begin(), {"isorun", "--lang", "en", "-"});
  return run_command(options, {.input = std::string(program)});
}

TEST(IsorunOutline, WritesAProgramThatIsolintFindsClean) {
  for (const char* const shape : {"rectangle", "hull", "path"}) {
    const CommandResult made = outline({"--outline", shape});
    EXPECT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, StartsWith("; around <stdin>, at Z7, spindle off: "));
    const CommandResult checked = run_command({"isolint", "--lang", "en", "--verify", "-"}, {.input = made.out});
    EXPECT_EQ(checked.status, 0) << checked.out;
    EXPECT_EQ(checked.out, "");
    const CommandResult run = run_command({"isorun", "--lang", "en", "-"}, {.input = made.out});
    EXPECT_THAT(run.out, StartsWith("result: ran to M02"));
  }
}

TEST(IsorunOutline, IsNotWrittenWhereTheMachineCannotGo) {
  const support::TemporaryFolder folder;
  const std::string machine = folder.write("isocnc.json",
                                           R"({"machine": {"home": {"z": 400}, "axes": {"X": {"min": -5, "max": 1000}},
          "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 10, "length": 100}]}})");
  const CommandResult left = outline({"--machine", machine, "--outline", "rectangle"});
  EXPECT_EQ(left.status, 1);
  EXPECT_EQ(left.out, "");
  EXPECT_THAT(left.err, HasSubstr("<stdin>: no outline is written: on its way, "));
  EXPECT_THAT(left.err, HasSubstr("--clearance sets another height"));
}

TEST(IsorunOutline, RefusesMistakenCommands) {
  EXPECT_THAT(outline({"--outline", "circle"}).err, HasSubstr("--outline takes rectangle, hull or path, not circle"));
  EXPECT_EQ(outline({"--outline", "circle"}).status, 2);
  EXPECT_THAT(outline({"--outline", "hull", "--restart-at", "3"}).err, HasSubstr("excludes"));
  EXPECT_THAT(outline({"--clearance", "30"}).err,
              HasSubstr("--clearance goes with --restart-at, --tool, --lift or --outline"));
  const CommandResult idle = outline({"--outline", "hull"}, "M02\n");
  EXPECT_EQ(idle.status, 1);
  EXPECT_THAT(idle.err, HasSubstr("the program has no feed move with a tool"));
  const CommandResult broken = outline({"--outline", "hull"}, "M06 T101001\nG01 X10 F100\nG02 X5\nM02\n");
  EXPECT_EQ(broken.status, 1);
  EXPECT_THAT(broken.err, HasSubstr("<stdin>:3: error: "));
}

TEST(IsorunLift, WritesTheProgramHigher) {
  const CommandResult made = outline({"--lift", "60"});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out,
            "M06 T101001\nS12000 M03\nG00 X0 Y0 Z110\nZ62\nG01 Z55 F2000\nX40\nY30\nX0 Y0\nG00 Z110\nM05\nM02\n");
}

TEST(IsorunLift, IsRefusedWhereItCannotBeRight) {
  for (const char* const wrong : {"0", "-5", "x", "1e9"}) {
    EXPECT_EQ(outline({"--lift", wrong}).status, 2) << wrong;
    EXPECT_THAT(outline({"--lift", wrong}).err, HasSubstr("--lift takes a plain number of mm above 0"));
  }
  const support::TemporaryFolder folder;
  const std::string machine =
      folder.write("isocnc.json", R"({"machine": {"home": {"z": 100}, "axes": {"Z": {"min": -100, "max": 100}}}})");
  const CommandResult high = outline({"--machine", machine, "--lift", "60"});
  EXPECT_EQ(high.status, 1);
  EXPECT_EQ(high.out, "");
  EXPECT_THAT(high.err, HasSubstr("<stdin>: the raised program is not written: "));
}

}  // namespace
}  // namespace isocnc::commands
