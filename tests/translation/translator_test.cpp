#include "analyzer/translation/translator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <regex>

#include "analyzer/check/check_text.h"
#include "tests/support/text_of_file.h"

namespace isocnc::translation {
namespace {

namespace fs = std::filesystem;
using dialect::Language;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const fs::path kPrograms = ISOCNC_SOURCE_DIR "/tests/translation/programs";

TranslationMap map_in(const std::string& text) {
  auto map = read_translation_map(text);
  if (const auto* mistakes = std::get_if<std::vector<configuration::Mistake>>(&map)) {
    ADD_FAILURE() << mistakes->front().message(Language::English);
    return {};
  }
  return std::get<TranslationMap>(map);
}

/// A machine whose zero points are its own, with tools 1 to 3.
TranslationSetup setup_for(SourceControl control) {
  TranslationSetup setup{.control = control};
  setup.map = map_in(R"({"tools": {"1": "101001", "2": "101002", "3": "102003"}, "start": "101001",
                         "zeros": {"G54": [0, 0, 0], "G55": [10, 20, 30]}})");
  return setup;
}

std::string findings_text(const Translation& translation, Language language = Language::English) {
  std::string text;
  for (const TranslationFinding& finding : translation.findings)
    text +=
        std::to_string(finding.line) + ":" + std::to_string(finding.column) + ": " + finding.message(language) + "\n";
  return text;
}

/// The codes of all errors of a program, with their lines.
std::vector<std::string> errors_in(std::string_view program) {
  std::vector<std::string> errors;
  for (const check::LocatedFinding& located : check::check_text(program, {}).findings)
    if (located.severity() == dialect::Severity::Error)
      errors.push_back(std::to_string(located.line + 1) + " " +
                       std::string(dialect::definition(located.finding.id).code));
  return errors;
}

/// The lines of the translation of a program that follows a first motion to X0 Y0 Z0.
std::string translated(std::string_view text, SourceControl control = SourceControl::LinuxCnc) {
  const std::string start = "G0 X0 Y0 Z0\n";
  const Translation translation = translate(start + std::string(text), setup_for(control));
  EXPECT_THAT(errors_in(translation.program), IsEmpty()) << translation.program;
  const std::string head = "M06 T101001\nG00 X0 Y0 Z0\n";
  EXPECT_TRUE(translation.program.starts_with(head)) << translation.program;
  EXPECT_TRUE(translation.program.ends_with("M02\n")) << translation.program;
  const std::string rest = translation.program.substr(std::min(head.size(), translation.program.size()));
  return rest.substr(0, rest.size() - std::min<std::size_t>(rest.size(), 4));
}

std::vector<std::string> program_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kPrograms))
    if (entry.path().extension() == ".nc" || entry.path().extension() == ".ngc")
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

class GoldenTranslation : public testing::TestWithParam<std::string> {};

/// fanuc_pocket.nc is translated from fanuc, by map.json, as fanuc_pocket.iso; what it reports is in fanuc_pocket.txt.
TEST_P(GoldenTranslation, IsAsExpected) {
  const std::string& name = GetParam();
  const std::string stem = fs::path(name).stem().string();
  const SourceControl control = *control_named(name.substr(0, name.find('_')));
  TranslationSetup setup{.control = control};
  const std::string map = control == SourceControl::Grbl ? "grbl_map.json" : "map.json";
  setup.map = map_in(text_of_file(kPrograms / map));
  const Translation translation = translate(text_of_file(kPrograms / name), setup);
  EXPECT_FALSE(translation.refusal);
  EXPECT_EQ(translation.program, text_of_file(kPrograms / (stem + ".iso")));
  const fs::path findings = kPrograms / (stem + ".txt");
  EXPECT_EQ(findings_text(translation), fs::exists(findings) ? text_of_file(findings) : "");
  EXPECT_THAT(errors_in(translation.program), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, GoldenTranslation, testing::ValuesIn(program_names()));

TEST(Translation, KeepsWordsThatMeanTheSame) {
  struct Case {
    std::string_view original, expected;
  };
  for (const auto& [original, expected] : std::vector<Case>{
           {"G1 X1.50 Y+2 F100", "G01 X1.50 Y+2 F100\n"},
           {"g1x1y2f100", "G01 X1 Y2 F100\n"},
           {"X 1 0", "X10\n"},
           {"F100\nG1\nX1", "G01 X1 F100\n"},               // A G or an F alone waits for its motion.
           {"G0 X1 F100\nG1 X2", "G00 X1\nG01 X2 F100\n"},  // F on a rapid sets nothing here.
           {"G20 X1", "G70 X1\n"},
           {"G21 G21 X1\nG21 X2", "G71 X1\nX2\n"},  // W001
           {"G2 X10 I5 F1", "G02 X10 I5 J0 F1\n"},
           {"G0 X5\nG2 I5 F1", "G00 X5\nG02 X5 I10 J0 F1\n"},
           {"G91 G2 I5 F1", "G91 G02 X0 I5 J0 F1\nG90\n"},
           {"G3 X10 R10 F1", "G03 X10 R10 F1\n"},
           {"G3 X10 R-10 F1", "G03 X10 I5 J-8.660254 F1\n"},
           {"G2 X10 R-10 F1", "G02 X10 I5 J8.660254 F1\n"},
           {"G90.1 G2 X10 I5 J0 F1", "G02 X10 I5 J0 F1\n"},
           {"G18 G2 X10 I5 F1", "G18 G02 X10 I5 K0 F1\n"},
           {"G4 P.5", "G04 P0.5\n"},
           {"G61 G1 X1 F1", "G01 X1 F1 G09\n"},
           {"G92 X10\nG0 X10", "G92 X-10 Y0 Z0\nG00 X10\n"},
           {"G55 G0 X0 Y0", "G92 X10 Y20 Z30\nG00 X0 Y0\n"},
           {"G28", "G00 X0 Y0 Z0\n"},
           {"G1 X1 A0 F1", "G01 X1 F1\n"},  // An axis that a post writes and never turns.
           {"S0 M5", "M05\n"},
           {"T2\nM3 S1 G0 X1\nM6", "S1 M03 G00 X1\nM05\nM06 T101002\n"},
           {"(one)(two) G0 (three) X1", "G00 X1 (one) (two) (three)\n"},
           {"(open", ";open\n"},
           {"N10.5 G0 X1", "G00 X1\n"},
       })
    EXPECT_EQ(translated(original), expected) << original;
}

/// The code of a translation, without its comments.
std::string code_of(std::string_view text, SourceControl control) {
  const std::string all = translated(text, control);
  std::string code;
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = all.find('\n', begin) + 1;
    if (all[begin] != ';') code += all.substr(begin, end - begin);
    begin = end;
  }
  return code;
}

/// What may stand elsewhere than the map says stays a comment, with all that follows, until it is known again.
TEST(Translation, WritesNoMotionFromAPlaceThatMayBeAnother) {
  struct Case {
    SourceControl control;
    std::string_view original, expected;
  };
  constexpr auto kFanuc = SourceControl::Fanuc;
  constexpr auto kLinuxCnc = SourceControl::LinuxCnc;
  for (const auto& [control, original, expected] : std::vector<Case>{
           // Zero points that no map has, and the way back.
           {kFanuc, "G54.1 P3\nG0 X1. Y0. Z0.\nG1 X5. F1.\nG54\nG0 X2. Y0. Z0.", "G00 X2. Y0. Z0.\n"},
           {kFanuc, "G54 P3\nG0 X1. Y0. Z0.\nG1 X5. F1.", ""},
           {kFanuc, "G110\nG0 X1. Y0. Z0.\nG1 X5. F1.", ""},
           {kFanuc, "G54.2 P1\nG0 X1. Y0. Z0.\nG1 X5. F1.", ""},
           // X and Y on a face or a cylinder.
           {kFanuc, "G12.1\nG1 X5. F1.\nG13.1\nG0 X2. Y0. Z0.", "G00 X2. Y0. Z0.\n"},
           {kFanuc, "G7.1 C40.\nG1 X5. F1.", ""},
           {kFanuc, "G112\nG1 X5. F1.", ""},
           // A zero point that is given in a way that cannot be said.
           {kLinuxCnc, "G10 L2 P2 X5 R30\nG55\nG0 X1 Y0 Z0\nG1 X5 F1\nG54 G0 X1 Y1 Z0", "G00 X1 Y1 Z0\n"},
           {kLinuxCnc, "G10 L2 P2 X#1\nG55\nG0 X1 Y0 Z0\nG1 X5 F1", ""},
           {kLinuxCnc, "G10 L2 P#2 X1\nG55\nG0 X1 Y0 Z0\nG1 X5 F1", ""},
           {kLinuxCnc, "G10 L20 P2 X#1\nG55 G0 X1 Y0 Z0", ""},
           {kLinuxCnc, "G10 L1 P2 Z#1\nG54 G0 X1 Y0 Z0", "G00 X1 Y0 Z0\n"},
           // Offsets of another tool.
           {kLinuxCnc, "T1 M6\nG43 H2\nG0 Z20\nG43 H1\nG0 Z30", "M06 T101001\nG00 Z30\n"},
           {kFanuc, "T1 M6\nH2\nG0 Z20.\nG49\nG0 Z30.", "M06 T101001\n"},
           {kFanuc, "T1 M6\nG1 X1. F1.\nG41 D0\nG1 X5. Y2.\nX9.\nG40\nG0 X0. Y0.",
            "M06 T101001\nG01 X1. F1.\nG00 X0. Y0.\n"},
           // Lengths and radii that the program gives by itself.
           {kFanuc, "T1 M6\nG44 H1\nG0 X1. Y1. Z5.\nG43 H1\nG0 Z30.", "M06 T101001\nG00 Z30.\n"},
           {kFanuc, "T1 M6\nG44 Z5. H1\nG49\nG1 X5. F1.\nG0 Z3.", "M06 T101001\nG00 Z3.\n"},
           {kFanuc, "T1 M6\nG43.1 H1\nG0 X1. Y1. Z5.\nG43 H1\nG0 Z30.", "M06 T101001\nG00 Z30.\n"},
           {kLinuxCnc, "G41.1 D10\nG1 X5 F9\nX9 Y9\nG40 X0\nG0 X2 Y0 Z0", "G00 X2 Y0 Z0\n"},
           {kLinuxCnc, "G42.1 D10 G1 X5 F9\nG42\nG0 X2 Y0 Z0\nG40", "G42 G00 X2 Y0 Z0\nG40\n"},
           // Shifts of all zero points, which no other zero point ends.
           {kFanuc, "G92.1 X0. Y0. Z0.\nG0 X1. Y1. Z1.\nG55 G0 X2. Y2. Z2.", ""},
           {kFanuc, "G10 L2 P0 X1.\nG0 X1. Y1. Z1.\nG55 G0 X2. Y2. Z2.", ""},
           {kFanuc, "G92 X#1\nG55 G0 X2. Y2. Z2.", ""},
           {kFanuc, "G52 X#1\nG55 G0 X2. Y2. Z2.\nG52 X0. Y0. Z0.\nG54 G0 X3. Y3. Z3.", "G00 X3. Y3. Z3.\n"},
           {kLinuxCnc, "G92 X#1\nG52 X1\nG0 X2 Y2 Z2\nG92.1\nG0 X3 Y3 Z3", "G00 X3 Y3 Z3\n"},
           {kLinuxCnc, "G92 X#1\nG28\nG92 X1 Y1 Z1\nG0 X3 Y3 Z3", "G00 X0 Y0 Z0\nG92 X-1 Y-1 Z-1\nG00 X3 Y3 Z3\n"},
           {kFanuc, "G56\nG92 X1. Y1. Z1.\nG54\nG0 X2. Y2. Z2.", ""},
           // What a variable gives.
           {kLinuxCnc, "G1 X1 F9\nF#1\nX5", "G01 X1 F9\n"},
           {kLinuxCnc, "F9 G98 G81 X1 Z-5 R2\nR#1\nX5\nG80", "Z2\nX1\nG01 Z-5 F9\nG00 Z2\n"},
           {kFanuc, "F9\nM98 P#1\nG1 X5.", ""},
           {kLinuxCnc, "T#1\nM6\nG0 X5", ""},
           {kLinuxCnc, "T1 M6\nG41 D#1\nG0 X5 Y5 Z0\nG40 G0 X6 Y6 Z0", "M06 T101001\nG00 X6 Y6 Z0\n"},
           {kFanuc, "T1 M6\nG43 H2 Z#1\nG0 Z5.", "M06 T101001\n"},
           // A reference point that the program has put elsewhere.
           {kLinuxCnc, "G28.1\nG28\nG0 X1 Y1 Z1", "G00 X1 Y1 Z1\n"},
           // G52 is G92 there.
           {kLinuxCnc, "G92 X1 Y1\nG52 X5\nG0 X0", "G92 X5 Y-1 Z0\nG00 X0\n"},
           {kLinuxCnc, "G92 X1 Y1\nG52 X0 Y0\nG0 X7", "G00 X7\n"},
           // What holds from G90 would be increments.
           {kLinuxCnc, "F1\nG98 G81 X1 Z-5 R2\nG91 X5\nG90 G80\nG0 X1 Y1 Z1",
            "Z2\nX1\nG01 Z-5 F1\nG00 Z2\nG90\nG00 X1 Y1 Z1\n"},
       })
    EXPECT_EQ(code_of(original, control), expected) << original;
}

/// What M72 of LinuxCNC brings back no map can say; on a Fanuc it is a function of the shop.
TEST(Translation, MapsNoSavedModes) {
  TranslationSetup setup = setup_for(SourceControl::LinuxCnc);
  setup.map.functions = {{70, 0}, {72, 172}};
  setup.named_functions = {72};
  const std::string text = "G0 X0 Y0 Z9.\nM70\nM72\nG0 X5.\nM2\n";
  EXPECT_EQ(
      translate(text, setup).program,
      "M06 T101001\nG00 X0 Y0 Z9.\n; NOT TRANSLATED: M70\n; NOT TRANSLATED: M72\n; NOT TRANSLATED: G0 X5.\nM02\n");
  setup.control = SourceControl::Fanuc;
  EXPECT_EQ(translate(text, setup).program, "M06 T101001\nG00 X0 Y0 Z9.\nM172\nG00 X5.\nM02\n");
  EXPECT_EQ(code_of("M72\nG92 X5 Y5 Z5\nG21 G90 G0 X1 Y1 Z1\nG54 G40 G49 G0 X1", SourceControl::LinuxCnc), "");
  EXPECT_EQ(code_of("M72 X#1\nG0 X1", SourceControl::LinuxCnc), "");
  EXPECT_EQ(code_of("M72\nG53 G0 Z7", SourceControl::LinuxCnc), "");
}

/// Shops that keep the radii at D31 and up, and lengths at H101 and up, say so; all other numbers are still those of
/// another tool.
TEST(Translation, TakesOffsetsWhereTheMapSaysTheyAre) {
  struct Case {
    std::string_view offsets, d, h;
    bool is_compensated, has_length;
  };
  for (const auto& [offsets, d, h, is_compensated, has_length] : std::vector<Case>{
           {R"({})", "D1", "H1", true, true},
           {R"({})", "D31", "H101", false, false},
           {R"({"D": 30})", "D31", "H1", true, true},
           {R"({"D": 30})", "D1", "H101", false, false},
           {R"({"D": 30})", "D32", "H1", false, true},
           {R"({"D": 30, "H": 100})", "D31", "H101", true, true},
           {R"({"D": 30, "H": 100})", "D31", "H1", true, false},
           {R"({"D": 0})", "D1", "H1", true, true},
       }) {
    TranslationSetup setup = setup_for(SourceControl::Fanuc);
    const TranslationMap map = map_in("{\"offsets\": " + std::string(offsets) + "}");
    setup.map.length_offset = map.length_offset;
    setup.map.radius_offset = map.radius_offset;
    const auto program = [&](const std::string& text) {
      return translate("G00 X0. Y0. Z9.\nT1 M06\n" + text + "\nM30\n", setup).program;
    };
    EXPECT_EQ(program("G01 X1. F1.\nG41 " + std::string(d) + "\nG01 X5. Y2.\nG40").find("NOT TRANSLATED") ==
                  std::string::npos,
              is_compensated)
        << offsets << d;
    EXPECT_EQ(program("G43 " + std::string(h) + "\nG00 Z5.").find("NOT TRANSLATED") == std::string::npos, has_length)
        << offsets << h;
  }
}

TEST(Translation, KeepsTheWordsOfWhatStaysAComment) {
  EXPECT_EQ(translated("G51 X0. Y0. P2000", SourceControl::Fanuc), "; NOT TRANSLATED: G51 X0. Y0. P2000\n");
  EXPECT_EQ(translated("G68.2 X0. Y1. Z2. I0. J45. K0.", SourceControl::Fanuc),
            "; NOT TRANSLATED: G68.2 X0. Y1. Z2. I0. J45. K0.\n");
  EXPECT_EQ(translated("G96 D100 S10", SourceControl::LinuxCnc), "; NOT TRANSLATED: G96 D100 S10\n");
}

TEST(Translation, PointsAtTheGThatItCannotSay) {
  const auto findings = [](const std::string& block) {
    return findings_text(translate("G00 X0. Y0. Z9.\n" + block + "\nM30\n", setup_for(SourceControl::Fanuc)));
  };
  EXPECT_EQ(findings("G68 X0. Y0. R30.\nG17 G90 G68 X0. Y0. R60."),
            "3:9: G68 is translated where it has an R, its center is known, G90 holds and no other G68 does\n");
  EXPECT_EQ(findings("G68 X0. Y0. R30.\nG69\nG68 X0. Y0. R60.\nG69"), "");
  EXPECT_EQ(findings("G90 G10 L50"), "2:5: G10 L50 has no translation\n");
}

TEST(Translation, TakesFanucWordsAsFanucDoes) {
  struct Case {
    std::string_view original, expected;
  };
  for (const auto& [original, expected] : std::vector<Case>{
           {"G04 P500", "G04 P0.5\n"},
           {"G04 X1.5", "G04 P1.5\n"},
           {"G05.1 Q1\nG08 P1\nG00 X1.", "G00 X1.\n"},
           {"G00 X1. M05", "G00 X1. M05\n"},  // After the motion; LinuxCNC stops the spindle before it.
           {"G43 H1 G00 Z5.\nG49", "G00 Z5.\n"},
           {"G81 X1. Z-5. R2. F9. K0\nG80", ""},
       })
    EXPECT_EQ(translated(original, SourceControl::Fanuc), expected) << original;
  EXPECT_EQ(translated("M5 G0 X1"), "M05 G00 X1\n");
}

/// An S alone waits for the next M03 or M04 here, and changes the speed at once there.
TEST(Translation, ChangesTheSpeedOfASpindleThatTurns) {
  struct Case {
    SourceControl control;
    std::string_view original, expected;
  };
  constexpr auto kFanuc = SourceControl::Fanuc;
  constexpr auto kLinuxCnc = SourceControl::LinuxCnc;
  constexpr auto kGrbl = SourceControl::Grbl;
  for (const auto& [control, original, expected] : std::vector<Case>{
           {kFanuc, "S3000 M3\nS6000\nG0 X5.", "S3000 M03\nS6000 M03\nG00 X5.\nM05\n"},
           {kLinuxCnc, "S3000 M4\nS6000 G0 X5", "S3000 M04\nS6000 M04 G00 X5\nM05\n"},
           {kGrbl, "M3 S3000\nG1 X5 F9 S6000\nM4 S1", "S3000 M03\nS6000 M03 G01 X5 F9\nS1 M04\nM05\n"},
           {kLinuxCnc, "S1\nM3\nM5\nS2\nM3", "S1\nM03\nM05\nS2\nM03\nM05\n"},
           {kLinuxCnc, "S1 M3\nS2 M5", "S1 M03\nS2 M05\n"},
           {kFanuc, "S1 M3\nS2 M5", "S1 M03\nS2 M05\n"},
           {kFanuc, "S1 M3\nG0 X5. S2 M5", "S1 M03\nS2 M03 G00 X5. M05\n"},
           {kLinuxCnc, "S1 M3\nT2 M6\nS2\nM3", "S1 M03\nM05\nM06 T101002\nS2\nM03\nM05\n"},
       })
    EXPECT_EQ(translated(original, control), expected) << original;
}

TEST(Translation, CountsThousandthsWhereTheMapSaysSo) {
  const std::string text = "G00 X1500 Y0 Z2.\nM30\n";
  TranslationSetup setup = setup_for(SourceControl::Fanuc);
  const Translation refused = translate(text, setup);
  ASSERT_TRUE(refused.refusal);
  EXPECT_EQ(refused.program, "");
  EXPECT_EQ(refused.refusal->reason, UntranslatableReason::WholeNumber);
  EXPECT_EQ(refused.refusal->column, 5U);
  setup.map.counts_thousandths = true;
  EXPECT_EQ(translate(text, setup).program, "M06 T101001\nG00 X1.5 Y0 Z2.\nM02\n");
  setup.map.counts_thousandths = false;
  EXPECT_EQ(translate(text, setup).program, "M06 T101001\nG00 X1500 Y0 Z2.\nM02\n");
  setup.map.counts_thousandths = true;
  EXPECT_THAT(translate("G20 G00 X1500\nM30\n", setup).program, HasSubstr("G70 G00 X0.15\n"));
}

TEST(Translation, WritesNoMotionFromAWrongPlace) {
  const std::string_view kMark = "; NOT TRANSLATED: ";
  struct Case {
    std::string_view original;
    std::string expected;
  };
  const auto kept = [&](std::string_view line) { return std::string(kMark) + std::string(line) + "\n"; };
  for (const auto& [original, expected] : std::vector<Case>{
           {"G38.2 Z-5 F1\nG1 Z-2", kept("G38.2 Z-5 F1") + kept("G1 Z-2")},
           {"G38.2 Z-5 F1\nG0 Z2\nG1 X1", kept("G38.2 Z-5 F1") + "G00 Z2\nG01 X1 F1\n"},
           {"G38.2 Z-5 F1\nG91 G0 Z2", kept("G38.2 Z-5 F1") + kept("G91 G0 Z2") + ""},
           {"G56 G0 X1\nG54 G0 X2", kept("G56 G0 X1") + "G00 X2\n"},
       }) {
    std::string program = translated(original);
    if (program.ends_with("G90\n")) program.erase(program.size() - 4);
    EXPECT_THAT(program, HasSubstr(expected.substr(0, expected.find('\n')))) << original;
    EXPECT_EQ(std::count(program.begin(), program.end(), ';'), std::count(expected.begin(), expected.end(), ';'))
        << program;
  }
}

TEST(Translation, NeedsToBeToldZeroPointsAndTools) {
  TranslationSetup setup{.control = SourceControl::LinuxCnc};
  setup.map.start = "101001";
  const Translation without_zero = translate("G0 X1\nG1 Y2 F9\nM2\n", setup);
  EXPECT_EQ(without_zero.program, "M06 T101001\n; NOT TRANSLATED: G0 X1\n; NOT TRANSLATED: G1 Y2 F9\nM02\n");
  EXPECT_EQ(
      findings_text(without_zero),
      "1:1: where is the zero point of G54, in machine coordinates? Give it with --zero G54=X,Y,Z or in the map\n");
  setup = setup_for(SourceControl::LinuxCnc);
  setup.map.start.clear();
  const Translation without_tool = translate("G0 X1\nT7 M6\nG0 X2\nT1 M6\nG0 X3\nM2\n", setup);
  EXPECT_EQ(findings_text(without_tool),
            "1:1: no tool is mounted before this motion: name the first one in the map, under start\n"
            "2:1: T7 is not in the map of tools: --map says at which head and holder it is\n");
  EXPECT_THAT(without_tool.program, HasSubstr("; NOT TRANSLATED: G0 X2\nM06 T101001\nG00 X3\n"));
}

/// A block that is left as a comment has set all the same what the blocks below rely on.
TEST(Translation, FollowsWhatACommentHasSet) {
  const auto kept = [](std::string_view line) { return "; NOT TRANSLATED: " + std::string(line) + "\n"; };
  EXPECT_EQ(translated("G55 X#1\nG0 X0 Y0"), kept("G55 X#1") + "G92 X10 Y20 Z30\nG00 X0 Y0\n");
  EXPECT_EQ(translated("T2 M6 A9\nG0 X1"), kept("T2 M6 A9") + kept("G0 X1"));
  EXPECT_EQ(translated("T2 M6 A9\nT1 M6\nG0 X1"), kept("T2 M6 A9") + "M06 T101001\nG00 X1\n");
  EXPECT_EQ(translated("G91 G38.2 Z-1 F9\nG0 Z1\nG90 G0 Z1"),
            kept("G91 G38.2 Z-1 F9") + kept("G0 Z1") + "G90 G00 Z1\n");
  EXPECT_EQ(translated("G92 X#1\nG0 X1\nG92.1\nG0 X1"), kept("G92 X#1") + kept("G0 X1") + "G00 X1\n");
  EXPECT_EQ(translated("G84 X1 Z-1 R1\nX5\nG80 G0 X1 Z1", SourceControl::LinuxCnc),
            kept("G84 X1 Z-1 R1") + kept("X5") + "G00 X1 Z1\n");
}

/// G92 keeps its shift for G92.3, whether G92.2 has suspended it or not.
TEST(Translation, BringsBackTheShiftThatIsInForce) {
  EXPECT_EQ(translated("G92 X100\nG0 X90\nG92.3\nG0 X110"), "G92 X-100 Y0 Z0\nG00 X90\nG00 X110\n");
  EXPECT_EQ(translated("G92 X100\nG92.2\nG0 X5\nG92.3\nG0 X110"), "G00 X5\nG92 X-100 Y0 Z0\nG00 X110\n");
  EXPECT_EQ(translated("G92 X100\nG92.1\nG92.3\nG0 X5"), "G00 X5\n");
  EXPECT_EQ(translated("G92 X#1\nG92.2\nG0 X5\nG92.3\nG0 X5"),
            "; NOT TRANSLATED: G92 X#1\nG00 X5\n; NOT TRANSLATED: G0 X5\n");
}

/// The turns of an arc share the time that G93 gives it: 1080 degrees in half a minute.
TEST(Translation, DividesTheTimeOfAnArcAmongItsTurns) {
  EXPECT_EQ(translated("G93\nG2 X0 Y0 I5 J0 P3 F2"),
            "G93\nG02 X0 Y0 Z0 I5 J0 F6\nG02 X0 Y0 Z0 I5 J0 F6\nG02 X0 Y0 Z0 I5 J0 F6\n");
  EXPECT_EQ(translated("G93\nG2 X10 Y0 I5 J0 P3 F2"),
            "G93\nG02 X0 Y0 Z0 I5 J0 F5\nG02 X0 Y0 Z0 I5 J0 F5\nG02 X10 Y0 Z0 I5 J0 F10\n");
}

TEST(Translation, KeepsTheFeedOfARapidInMachineCoordinates) {
  EXPECT_EQ(translated("G1 Z1 F300\nG53 G0 Z0 F900\nG0 Z5\nG1 Z-1"), "G01 Z1 F300\nG00 Z0\nG00 Z5\nG01 Z-1 F900\n");
}

TEST(Translation, EndsCallsThatHaveNoEnd) {
  const TranslationSetup setup = setup_for(SourceControl::Fanuc);
  EXPECT_THAT(findings_text(translate("M98 P1\nM30\nO1\nM98 P1\nM99\n", setup)), HasSubstr("more than 8 deep"));
  const std::string deep = "M98 P1 L999999\nM30\nO1\nM98 P2 L999999\nM99\nO2\nM98 P3 L999999\nM99\nO3\nG04 P1\nM99\n";
  EXPECT_THAT(findings_text(translate(deep, setup)), HasSubstr("more than 16 MB"));
  EXPECT_THAT(findings_text(translate("M98 P1 L999999999\nM30\nO1", setup)), HasSubstr("more than 16 MB"));
  EXPECT_THAT(findings_text(translate("G00 X0. Y0. Z9.\nG83 Z-9. R1. Q0.01 K9999 F1.\nM30\n", setup)),
              HasSubstr("G83 makes more moves than any part needs"));
  EXPECT_THAT(findings_text(translate("G00 X0. Y0. Z9.\nG83 Z-9. R1. Q0.000001 F1.\nM30\n", setup)),
              HasSubstr("more moves than any part needs"));
}

TEST(Translation, KeepsLineEnds) {
  const TranslationSetup setup = setup_for(SourceControl::Grbl);
  EXPECT_EQ(translate("G0 X1\r\nM2\r\n", setup).program, "M06 T101001\r\nG00 X1\r\nM02\r\n");
  EXPECT_EQ(translate("", setup).program, "M02\n");
}

/// Whatever the text, the translation has no error, ends, and says why it left out what it left out.
TEST(TranslationProperty, AnyTextGivesACleanProgram) {
  static constexpr std::string_view kPieces[] = {
      "G0",    "G1",  "G2",  "G3",  "G17", "G18", "G19", "G20",   "G21",   "G28",      "G30", "G40",  "G41",  "G43",
      "G49",   "G53", "G54", "G55", "G68", "G69", "G73", "G80",   "G81",   "G82",      "G83", "G85",  "G86",  "G89",
      "G90",   "G91", "G92", "G93", "G94", "G98", "G99", "G90.1", "G92.1", "G10",      "L2",  "P1",   "P2",   "X1",
      "X-2.5", "Y3",  "Y0",  "Z4",  "Z-1", "I1",  "J-2", "K.5",   "R2",    "R-3",      "Q1",  "F100", "S500", "T1",
      "T2",    "M3",  "M4",  "M5",  "M6",  "M8",  "M30", "M98",   "M99",   "O1",       "H1",  "D1",   "A5",   "#1=2",
      "X#1",   "[",   "%",   "/",   "(a",  ")",   ";",   "o1 if", "$H",    "\xC3\xA8", "G4",  "N5",   "G52",  "G61"};
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return random() % count; };
    std::string text = below(2) == 0 ? "T1 M6\nG90 G54 G0 X0. Y0. Z5. F100\n" : "";
    for (std::size_t lines = 1 + below(25); lines > 0; --lines) {
      for (std::size_t words = below(6); words > 0; --words) {
        text += kPieces[below(std::size(kPieces))];
        if (below(3) == 0) text += '.';
        text += ' ';
      }
      text += '\n';
    }
    TranslationSetup setup = setup_for(static_cast<SourceControl>(seed % 3));
    setup.map.counts_thousandths = seed % 2 == 0;
    if (seed % 5 == 0) setup.map.start.clear();
    const Translation translation = translate(text, setup);
    EXPECT_THAT(errors_in(translation.program), IsEmpty()) << seed << "\n" << text << "->\n" << translation.program;
    const bool has_mark = translation.program.find("NOT TRANSLATED") != std::string::npos;
    EXPECT_TRUE(!has_mark || !translation.findings.empty()) << seed << "\n" << text;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(TranslationFinding, SaysTheSameInBothLanguages) {
  static const std::regex kPlaceholder(R"(\{\d\})");
  const auto placeholders = [](std::string_view text) {
    const std::string owned(text);
    const std::set<std::string> all(std::sregex_token_iterator(owned.begin(), owned.end(), kPlaceholder), {});
    return all;
  };
  std::set<std::string_view> texts;
  for (int i = 0; i <= static_cast<int>(UntranslatableReason::WholeNumber); ++i) {
    const dialect::Text& text = text_of(static_cast<UntranslatableReason>(i));
    EXPECT_EQ(placeholders(text.en), placeholders(text.it)) << text.en;
    EXPECT_TRUE(texts.insert(text.en).second) << "reason " << i << " has no text of its own";
  }
}

TEST(TranslationMap, ReportsEachMistakeAtItsPlace) {
  struct Case {
    std::string_view text, message;
    std::size_t at;
  };
  for (const auto& [text, message, at] : std::vector<Case>{
           {R"({"tools": {"1": "101001", "2": "101001"}})", "tools.2: tool 1 is at 101001 already", 31},
           {R"({"tools": {"1": "101001", "01": "101002"}})", "this key is in the map already", 26},
           {R"({"tools": {"1": "101001", "1": "101002"}})", "this key is in the map already", 26},
           {R"({"tools": {"1": "10101"}})", "six digits", 16},
           {R"({"tools": {"1": 101001}})", "text in quotes", 16},
           {R"({"tools": {"x": "101001"}})", "no tool number", 11},
           {R"({"start": "100001"})", "a tool needs a holder", 10},
           {R"({"zeros": {"G53": [0, 0, 0]}})", "none of G54 to G59", 11},
           {R"({"zeros": {"G59.4": [0, 0, 0]}})", "none of G54 to G59", 11},
           {R"({"zeros": {"G54": [0, 0]}})", "three numbers", 18},
           {R"({"zeros": {"G54": [0, 0, 1e9]}})", "three numbers", 18},
           {R"({"references": {"G29": [0, 0, 0]}})", "neither G28 nor G30", 16},
           {R"({"functions": {"M06": "M8"}})", "no M that may be mapped", 15},
           {R"({"functions": {"M08": "M3"}})", "no M of the shop", 22},
           {R"({"functions": {"M8": "M108", "M08": "M109"}})", "this key is in the map already", 29},
           {R"({"zeros": {"G54": [0, 0, 0], "g54": [1, 0, 0]}})", "this key is in the map already", 29},
           {R"({"references": {"G28": [0, 0, 0], "g28": [1, 0, 0]}})", "this key is in the map already", 34},
           {R"({"units": "cm"})", "not one of mm, inch", 10},
           {R"({"wholeNumbers": true})", "text in quotes", 17},
           {R"({"peckClearance": 0})", "a length above 0", 18},
           {R"({"offsets": {"D": 1.5}})", "a whole number from 0 to 999", 18},
           {R"({"offsets": {"D": -30}})", "a whole number from 0 to 999", 18},
           {R"({"offsets": {"D": "30"}})", "a whole number from 0 to 999", 18},
           {R"({"offsets": {"H": 1e300}})", "a whole number from 0 to 999", 18},
           {R"({"offsets": {"T": 30}})", "T is neither H nor D", 13},
           {R"({"offsets": 30})", "an object in braces", 12},
           {R"({"tool": {}})", "unknown key", 1},
           {R"([])", "an object", 0},
           {R"({"tools": )", "the file ends here", 10},
       }) {
    auto map = read_translation_map(text);
    const auto* mistakes = std::get_if<std::vector<configuration::Mistake>>(&map);
    ASSERT_NE(mistakes, nullptr) << text;
    EXPECT_THAT(mistakes->front().message(Language::English), HasSubstr(std::string(message))) << text;
    EXPECT_THAT(mistakes->front().message(Language::Italian), Not(IsEmpty()));
    EXPECT_EQ(mistakes->front().at, at) << text;
  }
  const TranslationMap map = map_in(R"({"tools": {"0": "T000000", "12": "T130207"}, "functions": {"M08": null}})");
  EXPECT_EQ(map.tools.at(12), "130207");
  EXPECT_EQ(map.functions.at(8), 0);
}

TEST(TranslationMap, ReadsZeroPointsOfTheCommand) {
  const auto zero = read_zero_option("G54=350,220.5,-185.5");
  ASSERT_TRUE(zero);
  EXPECT_EQ(zero->first, 540);
  EXPECT_EQ(zero->second, geometry::Vec3(350, 220.5, -185.5));
  EXPECT_EQ(read_zero_option("g59.3=0,0,0")->first, 593);
  for (const std::string_view wrong :
       {"", "G54", "G54=", "G54=1,2", "G54=1,2,3,4", "G54=1,2,x", "G60=1,2,3", "G54=1,2,nan", "G54=1;2;3"})
    EXPECT_FALSE(read_zero_option(wrong)) << wrong;
}

}  // namespace
}  // namespace isocnc::translation
