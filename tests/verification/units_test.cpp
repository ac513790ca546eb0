// What a run tells of a block under G70 is in inches, as the program is: a Z that an operator types as it stands in the
// message must not be 25.4 times as deep.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include <fmt/format.h>

#include "interpreter/verification/verification_report.h"
#include "tests/verification/scenes.h"

namespace isocnc::verification {
namespace {

using dialect::Language;
using testing::HasSubstr;

/// A block of 100 x 100 x 40 mm, its upper face at Z40, below the tool T101001: a flat cutter of radius 10.
struct Bench : Shop {
  Bench() {
    scene.nose.reset();
    box("", {300, 100, 0}, {400, 200, 40}, BodyRole::Stock);
    scene.resolution = 0.5;
  }

  VerifiedRun cut(const std::string& moves) const { return run("M06 T101001\nS12000 M03\n" + moves + "M05\nM02\n"); }
};

/// What the findings of a run say, a line each.
std::string said(const VerifiedRun& run, Language language = Language::English) {
  std::string all;
  for (const simulation::RunFinding& each : run.outcome.findings) {
    const auto& id = dialect::definition(each.finding.id).code;
    all += fmt::format("{} {}: {}\n", id, each.line + 1, syntax::message(each.finding, {}, language));
  }
  return all;
}

/// Across the block at a height.
std::string rapids_at(const std::string& z) { return "G70\nG00 X9.8425 Y5.9055 Z3\nZ" + z + "\nX19.685\nZ3\n"; }

TEST(Units, OfARapidInMaterialAreThoseOfTheProgram) {
  const VerifiedRun run = Bench().cut(rapids_at("0.1969"));
  EXPECT_THAT(said(run),
              HasSubstr("E150 6: the cutter of T101001 goes through material in rapid: 1.3779 in deep at X"));
  EXPECT_THAT(said(run), HasSubstr("; Z1.5749 (absolute) would have been enough\n"));
  EXPECT_THAT(said(run, Language::Italian), HasSubstr("in rapido: 1.3779 pollici di profondità in X"));
  EXPECT_THAT(said(run, Language::Italian), HasSubstr("; bastava Z1.5749 (quota assoluta)\n"));
  // The view and the debugger say the same, and JSON is in mm.
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_THAT(said(run), HasSubstr(in_words(run.contacts[0], Language::English)));
  EXPECT_DOUBLE_EQ(to_json(run, Language::English)["contacts"][0]["enoughZ"].get<double>(), 40);
  // What it says is enough: typed as it stands.
  EXPECT_EQ(said(Bench().cut(rapids_at("1.5749"))), "");
  EXPECT_THAT(said(Bench().cut(rapids_at("1.56"))), HasSubstr("E150"));
}

TEST(Units, AreMillimetersWithoutG70AndFromG71On) {
  const std::string words = said(Bench().cut("G70\nG00 X9.8425 Y5.9055 Z3\nG71\nZ5\nX500\nZ50\n"));
  EXPECT_THAT(words, HasSubstr("E150 7: the cutter of T101001 goes through material in rapid: 35 mm deep"));
  EXPECT_THAT(words, HasSubstr("; Z40 (absolute) would have been enough\n"));
}

TEST(Units, OfABlockThatPutsThemInForce) {
  const std::string words = said(Bench().cut("G00 X250 Y150 Z50\nZ5\nG70 G00 X19.685\nZ3\n"));
  EXPECT_THAT(words, HasSubstr("1.378 in deep"));
}

TEST(Units, OfAHolderADeepCutAndAPieceThatComesFree) {
  Bench bench;
  const std::string holder = said(bench.cut("G70\nG00 X13.7795 Y5.9055 Z3\nG01 Z-0.9843 F40\nG00 Z3\n"));
  EXPECT_THAT(holder, HasSubstr("E151 5: the holder of T101001 is in the material: 0.19"));
  EXPECT_THAT(holder, HasSubstr("; Z-0.7874 (absolute) would have been enough\n"));
  Bench shallow;
  shallow.scene.tools[Shop::kTool].max_depth = 10;
  const std::string deep = said(shallow.cut("G70\nG00 X9 Y5.9055 Z3\nZ0.7874\nG01 X19 F40\nG00 Z3\n"));
  EXPECT_THAT(deep, HasSubstr("W157 6: the cutter of T101001 cuts 0.7874 in deep at once at X"));
  EXPECT_THAT(deep, HasSubstr("; it may go 0.3937 in deep\n"));
  bench.box("stop", {400, 140, 0}, {420, 160, 40});
  const std::string piece =
      said(bench.cut("G70\nG00 X12.4016 Y4.7244 Z3\nG01 Z-0.0394 F40\nX15.1575\nY7.0866\nX12.4016\n"
                     "Y4.7244\nG00 Z3\n"));
  EXPECT_THAT(piece, HasSubstr("nothing holds it: around X13.7795 Y5.9055 Z0.7874 (inches), "));
}

TEST(Units, OfContactsAndNearMisses) {
  Shop shop;
  shop.scene.nose.reset();
  shop.box("clamp", {200, 0, 0}, {250, 50, 30});
  const std::string hit = said(shop.run("M06 T101001\nG70\nG00 X4 Y1 Z2\nZ0.7874\nX12\nZ2\nM02\n"));
  EXPECT_THAT(hit, HasSubstr("hits clamp: 0.3937 in deep at X"));
  const std::string near = said(shop.run("M06 T101001\nG70\nG00 X4 Y1 Z2\nZ1.2205\nX12\nZ2\nM02\n"));
  EXPECT_THAT(near, HasSubstr("passes 0.0394 in from clamp at X"));
  EXPECT_THAT(near, HasSubstr(" Z1.1811,"));
  // Of a tool that is mounted where it hits.
  shop.scene.tools[{1, 1, 2}] = shop.scene.tools[Shop::kTool];
  shop.machine.tool_lengths[{1, 1, 2}] = 160;
  shop.scene.tools[{1, 1, 2}].length = 160;
  const std::string mounted = said(shop.run("M06 T101001\nG70\nG00 X9 Y1 Z2\nM06 T101002\nG00 Z4\nM02\n"));
  EXPECT_THAT(mounted, HasSubstr(" in deep at X"));
}

TEST(Units, OfMaterialThatIsLeft) {
  Bench bench;
  bench.box("part", {300, 100, 0}, {400, 200, 30}, BodyRole::Target);
  const VerifiedRun run = bench.cut("G70\nG00 X9.8425 Y5.9055 Z3\nZ1.1811\nG01 X19.685 F80\nG00 Z3\n");
  EXPECT_THAT(said(run), HasSubstr("W156"));
  EXPECT_THAT(said(run), HasSubstr(" in beyond its tolerance of 0 in, at X"));
  EXPECT_THAT(said(run), HasSubstr(" Z1.5748; "));
}

TEST(Units, OfTheEndOfATravel) {
  Shop shop;
  shop.machine.motion.axes[0].minimum = 0;
  shop.machine.motion.axes[0].maximum = 1000;
  EXPECT_THAT(said(shop.run("M06 T101001\nG70\nG00 X45\nX50\nX1\nM02\n")),
              HasSubstr("the machine's X leaves its travel: it goes to 50, and the travel ends at 39.3701 (inches)\n"));
  EXPECT_THAT(said(shop.run("M06 T101001\nG00 X1200\nX1\nM02\n"), Language::Italian),
              HasSubstr("arriva a 1200, e la corsa finisce a 1000\n"));
}

TEST(Units, OfARadiusThatIsTooSmall) {
  Shop shop;
  shop.machine.tool_radii[{1, 1, 1}] = 10;
  const std::string words =
      said(shop.run("M06 T101001\nS12000 M03\nG70\nG00 X4 Y4 Z1\nG41 G01 X5 Y4 F40\nX6\n"
                    "G03 X6.2 Y4.2 I6 J4.2\nG01 Y6\nG40 G01 X4 Y6\nM05\nM02\n"));
  EXPECT_THAT(words, HasSubstr("an inside arc of radius 0.2 in is too small for a cutter of radius 0.3937 in"));
}

}  // namespace
}  // namespace isocnc::verification
