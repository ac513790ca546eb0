#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/verification/verification_report.h"
#include "tests/verification/scenes.h"

namespace isocnc::verification {
namespace {

using dialect::Language;
using geometry::Vec3;
using kinematics::MachineKind;

/// Code, line from 1, who and whom.
std::vector<std::string> summaries(const VerifiedRun& run) {
  std::vector<std::string> all;
  for (const Contact& contact : run.contacts)
    all.push_back(fmt::format("{} {} {} | {}", dialect::definition(contact.id).code, contact.line + 1,
                              contact.who.in(Language::English), contact.whom.in(Language::English)));
  return all;
}

void add_machine_body(Shop& shop, std::string name, Link on, const Vec3& minimum, const Vec3& maximum) {
  shop.scene.machine.push_back(
      {.name = std::move(name), .role = BodyRole::Machine, .on = on, .shape = solids::Cuboid{minimum, maximum}});
}

TEST(ContactReports, BodiesThatAlwaysTouchHideNoOtherContact) {
  Shop shop(MachineKind::Head);
  shop.scene.clearance = 0;
  add_machine_body(shop, "bed", Link::Machine, {-1000, -600, -300}, {3000, 2000, -200});
  add_machine_body(shop, "gantry", Link::X, {-100, -500, -200}, {100, -400, 800});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100 B0 C0\nX80 Y80\nG01 Z-220 F1000\nG00 Z100\nM02\n");
  EXPECT_EQ(summaries(run), std::vector<std::string>{"E153 4 the cutter of T101001 | bed"});
}

TEST(ContactReports, BodiesOfTheMachineThatTouchAtTheStartAreNotCompared) {
  constexpr std::string_view kProgram = "M06 T101001\nG00 X0 Y0 Z100\nX500\nM02\n";
  const auto run_at_gap = [&](double gap, MachineKind kind = MachineKind::ThreeAxis) {
    Shop shop(kind);
    add_machine_body(shop, "gantry", Link::X, {-100, -500, -200 + gap}, {100, -400, 800});
    add_machine_body(shop, "rails", Link::Machine, {-1000, -600, -300}, {3000, -300, -200});
    return shop.run(std::string(kProgram));
  };
  for (const double gap : {0.0, -5.0, 0.015}) {
    const VerifiedRun run = run_at_gap(gap);
    EXPECT_TRUE(run.contacts.empty()) << gap;
    EXPECT_TRUE(in_words(*run.certificate, Language::English)
                    .ends_with("; not compared: gantry and rails, which touch at the start"));
    EXPECT_TRUE(in_words(*run.certificate, Language::Italian)
                    .ends_with("; non confrontati: gantry e rails, che all'inizio si toccano"));
    EXPECT_EQ(to_json(run, Language::English)["certificate"]["notCompared"][0], "gantry and rails");
  }
  const VerifiedRun apart = run_at_gap(0.025);
  EXPECT_TRUE(apart.contacts.empty());
  EXPECT_TRUE(apart.certificate->touching.empty());
}

TEST(ContactReports, BodiesOfTheMachineThatTouchLaterAreReported) {
  Shop shop;
  add_machine_body(shop, "gantry", Link::X, {-100, -500, -200}, {100, -400, 800});
  add_machine_body(shop, "rails", Link::Machine, {-1000, -600, -300}, {3000, -300, -200});
  add_machine_body(shop, "post", Link::Machine, {400, -450, 0}, {450, -400, 100});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100\nX500\nM02\n");
  EXPECT_EQ(summaries(run), std::vector<std::string>{"E153 3 gantry | post"});
  EXPECT_EQ(run.certificate->touching.size(), 1u);
}

TEST(ContactReports, WhatTheToolOrTheSetupTouchesAtTheStartIsReported) {
  Shop shop;
  add_machine_body(shop, "gantry", Link::X, {-100, -500, -200}, {100, -400, 800});
  add_machine_body(shop, "post", Link::Machine, {-50, 0, 350}, {50, 100, 500});
  shop.box("clamp", {0, -450, -200}, {50, -420, 0});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X10 Y0 Z400\nM02\n");
  const std::vector<std::string> found = summaries(run);
  EXPECT_NE(std::find(found.begin(), found.end(), "E152 1 gantry | clamp"), found.end());
  EXPECT_NE(std::find(found.begin(), found.end(), "E153 1 the spindle nose | post"), found.end())
      << fmt::format("{}", fmt::join(found, "\n"));
  EXPECT_TRUE(run.certificate->touching.empty());
}

TEST(ContactReports, TheBodyThatGoesDeepestIsNamed) {
  Shop shop;
  shop.scene.nose.reset();
  shop.scene.clearance = 0;
  // The cutter passes 0.01 mm beside the plate, and the holder, 15 mm wider, does not.
  shop.box("angle plate", {20, -50, -50}, {60, 50, 90});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X-100 Y0 Z98\nX9.99\nZ0\nZ98\nX-100\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].who.in(Language::English), "the holder of T101001");
  EXPECT_NEAR(run.contacts[0].distance, -14.99, 0.02);
}

TEST(ContactReports, TheToolMayHitWhatCarriesIt) {
  for (const MachineKind kind : {MachineKind::ThreeAxis, MachineKind::Head, MachineKind::Table}) {
    Shop shop(kind);
    add_machine_body(shop, "gantry", Link::X, {-20, 80, 0}, {20, 90, 150});
    const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100\nX500\nY85\nM02\n");
    const std::vector<std::string> found = summaries(run);
    ASSERT_EQ(found, std::vector<std::string>{"E153 4 the cutter of T101001 | gantry"});
    // Where the gantry is now.
    EXPECT_NEAR(run.contacts[0].point.x(), 500, 20.01);
  }
}

TEST(ContactReports, RepeatedContactsShowTheDeepest) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  const VerifiedRun run =
      shop.run("M06 T101001\nG00 X-50 Y0 Z50\nG01 Z19 F1000\nX50\nG00 Z50\nX-50\nG01 Z-20 F1000\nX50\nG00 Z50\nM02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  EXPECT_NEAR(run.contacts[0].distance, -1, 0.01);
  EXPECT_NEAR(run.contacts[1].distance, -20, 0.01);
  EXPECT_EQ(run.contacts[0].mistake, run.contacts[1].mistake);
  ASSERT_EQ(run.outcome.findings.size(), 2u);
  EXPECT_NEAR(run.outcome.findings[0].finding.values[0], 20, 0.011);
  EXPECT_NEAR(run.outcome.findings[1].finding.values[0], 20, 0.011);
}

/// Line from 1, depth, and the line from 1 where it is deepest.
std::vector<std::string> findings_of(const VerifiedRun& run) {
  std::vector<std::string> all;
  for (const simulation::RunFinding& each : run.outcome.findings)
    all.push_back(
        fmt::format("{}: {} at {}", each.line + 1, each.finding.values[0], each.worst_line.value_or(each.line) + 1));
  return all;
}

/// Whoever accepts the first touch has not accepted what follows.
TEST(ContactReports, AContactThatGetsMuchDeeperIsToldThereAsWell) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("board", {90, -70, 0}, {300, 70, 50});
  const std::string start = "M06 T101001\nG00 X0 Y0 Z49.7\nG01 X120 F3000\nX130 Z49.5\n";
  const VerifiedRun run = shop.run(start + "Z40\nX140\nZ38\nG00 Z100\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(findings_of(run), (std::vector<std::string>{"3: 11.98 at 7", "5: 11.98 at 7"}));
  EXPECT_EQ(run.outcome.findings[0].mistake, run.outcome.findings[1].mistake);
  EXPECT_EQ(run.outcome.findings[1].last_line, 7u);
  // A score that stays one is told once.
  EXPECT_EQ(findings_of(shop.run(start + "X140\nZ49.65\nG00 Z100\nM02\n")), std::vector<std::string>{"3: 0.5 at 5"});
}

/// Time, line and depth are those of one place, also where it is in a later contact.
TEST(ContactReports, TheFirstLineOfAMistakeTellsItsDeepestPlace) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-40, -40, -50}, {40, 40, 20});
  const VerifiedRun run = shop.run(
      "M06 T101001\nG00 X-100 Y0 Z50\nG01 Z19 F1000\nX100\nG00 Z50\nX-100\nG01 Z-20 F1000\nX100\nG00 Z50\nM02\n");
  EXPECT_EQ(findings_of(run), (std::vector<std::string>{"4: 40 at 8", "8: 40 at 8"}));
  EXPECT_NEAR(run.outcome.findings[0].finding.values[4], run.contacts[1].worst_time, 0.051);
}

/// The place is on the face that the tool has gone through, however deep it is below the middle.
TEST(ContactReports, TheDeepestPlaceIsOnTheFaceThatTheToolWentThrough) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("plate", {-100, -100, 0}, {100, 100, 30});
  shop.pin("post", {300, 0, 0}, geometry::Vec3::UnitZ(), 30, 60);
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z50\nG01 Z7 F1000\nG00 Z50\nX300\nG01 Z7\nG00 Z50\nM02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  for (const Contact& each : run.contacts) {
    EXPECT_NEAR(each.distance, -23, 0.03);
    EXPECT_NEAR(each.point.z(), 30, 1e-6);
  }
}

/// Whoever accepts that the cutter touches has not accepted that the holder does, and learns how deep the holder is.
TEST(ContactReports, AnotherPartThatTouchesIsToldThereAsWell) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.nose.reset();
  shop.box("clamp", {8, -50, -50}, {60, 50, 30});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X-100 Y0 Z98\nX0\nG01 Z-20 F1000\nZ-31\nG00 Z98\nM02\n");
  ASSERT_EQ(findings_of(run), (std::vector<std::string>{"4: 2 at 4", "5: 0.98 at 5"}));
  const syntax::Finding& last = run.outcome.findings[1].finding;
  EXPECT_EQ(last.names[0].in(Language::English), "the holder of T101001");
  EXPECT_NEAR(last.values[3], 30, 0.01);
  EXPECT_EQ(run.outcome.findings[0].finding.names[0].in(Language::English), "the cutter of T101001");
}

/// What a head turns passes the gantry, which the ram below it cannot meet.
TEST(ContactReports, WhatAHeadTurnsIsComparedWithTheGantry) {
  Shop shop(MachineKind::Head);
  shop.scene.clearance = 0;
  // A motor that stands out to the side of the head by 300 mm; half a turn of C brings it into the post of the gantry.
  add_machine_body(shop, "motor", Link::C, {150, -50, 200}, {300, 50, 300});
  add_machine_body(shop, "post", Link::X, {-320, -50, 350}, {-250, 50, 550});
  const std::string start = "M06 T101001\nG00 X0 Y0 Z100 B0 C0\n";
  EXPECT_TRUE(shop.run(start + "C90\nM02\n").contacts.empty());
  const VerifiedRun run = shop.run(start + "C180\nM02\n");
  ASSERT_EQ(summaries(run), std::vector<std::string>{"E153 3 motor | post"});
  EXPECT_NEAR(run.contacts[0].distance, 250 - std::hypot(300, 50), 0.02);
}

TEST(ContactReports, TheCertificateNamesWhatIsNotDescribed) {
  Shop shop;
  const auto not_verified = [&] {
    return to_json(shop.run("M06 T101001\nG00 X0\nM06 T101001\nM02\n"), Language::English)["certificate"]
        .at("notVerified")
        .dump();
  };
  EXPECT_EQ(not_verified(), R"(["the setup describes no body"])");
  shop.box("clamp", {300, 300, 0}, {310, 310, 20});
  EXPECT_EQ(not_verified(), "[]");
  shop.scene.nose.reset();
  shop.scene.tools[Shop::kTool].holder.reset();
  EXPECT_EQ(not_verified(), R"(["T101001 has no holder","the spindle nose is not described"])");
}

/// Line from 1, and the line where the contact ends.
std::vector<std::pair<std::size_t, std::size_t>> lines_of(const VerifiedRun& run) {
  std::vector<std::pair<std::size_t, std::size_t>> lines;
  for (const Contact& contact : run.contacts) lines.emplace_back(contact.line + 1, contact.end_line + 1);
  return lines;
}
using Lines = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(ContactReports, WhatTheToolLeavesAndComesBackToIsHitAgain) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {90, -70, 0}, {110, 70, 50});
  // Half circles one after another, a whole one, and there and back in rapid.
  const std::string start = "M06 T101001\nG00 X160 Y0 Z45\n";
  EXPECT_EQ(lines_of(shop.run(start + "G03 X40 Y0 I100 J0 F3000\nX160 Y0 I100 J0\nM02\n")), (Lines{{3, 3}, {4, 4}}));
  EXPECT_EQ(lines_of(shop.run(start + "G03 X160 Y0 I100 J0 F3000\nM02\n")), (Lines{{3, 3}, {3, 3}}));
  EXPECT_EQ(lines_of(shop.run(start + "X40\nX160\nM02\n")), (Lines{{3, 3}, {4, 4}}));
  // One from below the head of the clamp to its other end is one contact, with the time at rest.
  EXPECT_EQ(lines_of(shop.run(start + "X100\nG04 P2\nX100.5\nX40\nM02\n")), (Lines{{3, 6}}));
}

TEST(ContactReports, GrazingIsOneContact) {
  for (const double gap : {0.0, 0.0199, 0.02, 0.0201}) {
    Shop shop;
    shop.scene.clearance = 0;
    shop.box("rail", {-50, 10, -50}, {50, 20, 20});
    std::string program = fmt::format("M06 T101001\nG00 X-100 Y{:.4f} Z10\nG49\nG01 F3000\n", -gap);
    for (int i = 0; i < 400; ++i)
      program += fmt::format("G01 X{:.2f} Y{:.5f}\n", -100 + 0.5 * i, -gap - (i % 2) * 1e-4);
    EXPECT_LE(shop.run(program + "M02\n").contacts.size(), 1u) << gap;
  }
}

/// The cutter is in the ring below while the holder is above it.
TEST(ContactReports, PartsOfAToolHandAContactOver) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.nose.reset();
  shop.box("plate", {20, -50, 10}, {60, 50, 20});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X-100 Y0 Z5\nX9\nX12\nZ-41\nX-100\nM02\n");
  EXPECT_EQ(lines_of(run), (Lines{{4, 6}}));
}

TEST(ContactReports, WhatIsPassedTwiceIsPassedNearTwice) {
  Shop shop;
  shop.scene.clearance = 2;
  shop.box("clamp", {90, -70, 0}, {110, 70, 50});
  const VerifiedRun run =
      shop.run("M06 T101001\nG00 X160 Y0 Z51\nG03 X40 Y0 I100 J0 F3000\nX160 Y0 Z45 I100 J0\nM02\n");
  EXPECT_EQ(summaries(run),
            (std::vector<std::string>{"W154 3 the cutter of T101001 | clamp", "E152 4 the cutter of T101001 | clamp"}));
}

/// Down by 0.1 mm in 500 turns of the table, the tool stays near the plate for too long for a proof.
TEST(ContactReports, WhatFollowsAnUndecidedPieceIsFound) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.scene.nose.reset();
  shop.box("plate", {-300, -300, -10}, {300, 300, 0});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X100 Y0 Z0.05 B0 C0\nG49\nG01 Z-0.05 C180000 F5000\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].line, 3u);
  ASSERT_EQ(run.certificate->gaps.size(), 1u);
  EXPECT_EQ(run.certificate->gaps[0].gap, Gap::Undecided);
}

/// A half circle that is in the block throughout, below and above its ends.
TEST(ContactReports, TheDeepestPlaceIsFoundWithinAMotion) {
  for (const auto& [arc, depth] : {std::pair("G02", 50), std::pair("G03", 40)}) {
    Shop shop;
    shop.scene.clearance = 0;
    shop.scene.nose.reset();
    shop.scene.tools[Shop::kTool].holder.reset();
    shop.box("block", {-200, -200, -200}, {200, 200, 0});
    const VerifiedRun run = shop.run(
        fmt::format("G18\nM06 T101001\nG00 X-10 Y0 Z10\nG01 Z-40 F2000\n{} X10 Z-40 I0 K-40\nG01 Z10\nM02\n", arc));
    ASSERT_EQ(run.contacts.size(), 1u);
    EXPECT_NEAR(run.contacts[0].distance, -depth, 0.05) << arc;
  }
}

TEST(ContactReports, ThePlaceIsOnTheSurfaceOfTheObstacle) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.tools[Shop::kTool].cutter = Shop::body(solids::ball_body(10, 60));
  shop.box("block", {-200, -200, -200}, {200, 200, 0});
  shop.pin("post", {300, 0, -100}, {0, 0, 1}, 100, 30);
  const VerifiedRun run = shop.run("M06 T101001\nG00 X-10 Y0 Z10\nG01 Z-40 F2000\nZ10\nX299\nZ-20\nM02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  for (const Contact& contact : run.contacts) EXPECT_NEAR(contact.point.z(), 0, 1e-9);
}

/// Of a cutter that is thinner than the tolerance no point is farther from its surface, and of a pointed one not its
/// point.
TEST(ContactReports, ThinAndPointedCuttersGougeAsWell) {
  const auto block = mesh_of({{0, 0, -40}, {100, 100, 0}});
  for (const bool is_mesh : {true, false}) {
    for (const solids::BodyOrProblem& made :
         {solids::flat_body(0.2, 20), solids::flat_body(0.2, 3), solids::flat_body(0.05, 20),
          solids::flat_body(0.25, 20), solids::cone_body(3, 0, 20, 20), solids::drill_body(1.5, 118, 20)}) {
      Shop shop;
      shop.scene.target_tolerance = 0.2;
      shop.scene.tools[Shop::kTool].cutter = Shop::body(made);
      shop.scene.tools[Shop::kTool].holder.reset();
      SceneBody& target = shop.box("", {0, 0, -40}, {100, 100, 0}, BodyRole::Target);
      if (is_mesh) target.shape = block;
      const auto run_at = [&](double depth) {
        return shop.run(fmt::format("M06 T101001\nG00 X-50 Y50 Z10\nG01 Z{:.4f} F1000\nX80\nG00 Z10\nM02\n", -depth));
      };
      // In and out again is one contact.
      const VerifiedRun plunge = shop.run("M06 T101001\nG00 X50 Y50 Z10\nG01 Z-2.9 F1000\nX80\nZ10\nM02\n");
      EXPECT_EQ(plunge.contacts.size(), 1u);
      for (const double accepted : {-0.001, 0.0, 0.1, 0.2}) EXPECT_TRUE(run_at(accepted).contacts.empty()) << accepted;
      for (const double depth : {0.25, 0.5, 1.0, 2.9, 15.0}) {
        const VerifiedRun run = run_at(depth);
        ASSERT_EQ(run.contacts.size(), 1u) << depth;
        EXPECT_EQ(dialect::definition(run.contacts[0].id).code, "E155");
        EXPECT_NEAR(run.contacts[0].distance, 0.2 - depth, 0.05) << depth;
      }
    }
  }
}

/// Of what repeats, the first finding shows the deepest place, and counts it as its own line does.
TEST(ContactReports, TheDeepestPlaceIsInTheFrameOfTheFinding) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.is_in_workpiece_frame = false;
  shop.box("clamp", {590, 490, 0}, {610, 510, 50});
  const VerifiedRun run = shop.run(
      "M06 T101001\nG92 X500 Y500 Z0\nG00 X0 Y0 Z60\nX100\nZ45\nZ100\nG92 X400 Y400 Z0\nG00 X200\nY100\nZ30\nZ100\n"
      "M02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  ASSERT_EQ(run.outcome.findings.size(), 2u);
  for (const simulation::RunFinding& each : run.outcome.findings) EXPECT_NEAR(each.finding.values[0], 20, 0.03);
  EXPECT_NEAR(run.outcome.findings[0].finding.values[1], 100, 10.01);
  EXPECT_NEAR(run.outcome.findings[1].finding.values[1], 200, 10.01);
}

/// Without its length it is not known where the spindle is.
TEST(ContactReports, AToolWithoutLengthHitsNothing) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.scene.tools.clear();
  shop.machine.tool_lengths.clear();
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z30\nZ-20\nM02\n");
  EXPECT_TRUE(run.contacts.empty());
  ASSERT_EQ(run.certificate->gaps.size(), 1u);
  EXPECT_EQ(run.certificate->gaps[0].gap, Gap::ToolWithoutLength);
}

/// Nor where the tool after it begins, until Z has a coordinate. The one finding leads to the last line of that.
TEST(ContactReports, AfterAToolWithoutLengthNothingIsHitUntilZHasACoordinate) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  const VerifiedRun run = shop.run(
      "M06 T101002\nG00 X0 Y0 Z10\n"
      "M06 T101001\nG00 X50\nZ80\nX0\n"
      "Z10\nZ80\n"  // Line 7 goes into the clamp.
      "M06 T000000\nG00 X100\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].line, 6u);
  ASSERT_EQ(run.certificate->gaps.size(), 1u);
  ASSERT_EQ(run.outcome.findings.size(), 2u);
  EXPECT_EQ(run.outcome.findings[0].line, 0u);
  EXPECT_EQ(run.outcome.findings[0].last_line, 4u);
  const auto says = [&](Language language, const char* text) {
    return in_words(*run.certificate, language).find(text) != std::string::npos;
  };
  EXPECT_TRUE(
      says(Language::English,
           "not verified: T101002 has no length, lines 3 to 5 (it is not known where T101002 leaves the machine)"));
  EXPECT_TRUE(says(Language::Italian, "linee da 3 a 5 (non si sa dove T101002 lascia la macchina)"));
  const std::string again = "M06 T101002\nG00 X0 Y0 Z10\nM06 T101001\nG00 X50\n";
  EXPECT_NE(in_words(*shop.run(again + again + "M02\n").certificate, Language::English)
                .find("lines 3 to 4 and 7 to 8 (it is not known where"),
            std::string::npos);
}

/// What the certificate says of lines where it is not known where the machine is, and the last line of the first W162.
std::string unknown_lines(const std::string& program) {
  Shop shop;
  shop.machine.tool_lengths[{1, 1, 4}] = 60;
  const VerifiedRun run = shop.run(program);
  std::string lines;
  for (const UnknownPlaces& places : run.certificate->unknown_places) {
    lines += places.after + ":";
    for (const auto& [first, last] : places.lines) lines += fmt::format(" {}-{}", first + 1, last + 1);
  }
  const auto& findings = run.outcome.findings;
  if (!findings.empty() && findings[0].last_line) lines += fmt::format(", W162 to {}", *findings[0].last_line + 1);
  return lines;
}

TEST(ContactReports, OneLineWhereThePlaceIsNotKnownIsALine) {
  const VerifiedRun run = Shop().run("M06 T101002\nG00 X9 Y0 Z9\nM06 T101001\nM02\n");
  EXPECT_NE(in_words(*run.certificate, Language::English).find(", line 3 (it is not known"), std::string::npos);
  EXPECT_NE(in_words(*run.certificate, Language::Italian).find(", linea 3 (non si sa"), std::string::npos);
}

TEST(ContactReports, LinesWhereThePlaceIsNotKnownAreThoseUpToTheCoordinateOfZ) {
  // Whatever is mounted meanwhile.
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X0 Y0 Z20\nM06 T000000\nG00 X50\nM06 T101001\nG00 X9\nZ80\nX0\nM02\n"),
            "T101002: 3-7, W162 to 7");
  // The tool that has moved along its axis is named, not the one that has not.
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X0 Y0 Z20\nM06 T101003\nG00 X50\nM06 T101001\nG00 X9\nZ80\nM02\n"),
            "T101002: 5-7, W162 to 7");
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 Z20\nM06 T101003\nG00 X5 Y0 Z50\nM06 T101001\nG00 X9\nZ80\nM02\n"),
            "T101003: 5-7");
  // Z0 is a motion if the length is not 0, and M06 may stand on the line of one.
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X9 Y0 Z100\nM06 T101001\nG00 Z0\nM02\n"), "T101002: 3-4, W162 to 4");
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X9 Y0 Z9\nM06 T101001 G00 X5\nM02\n"), "T101002: 3-3, W162 to 3");
  // Where a tool is mounted, but not where one is put away.
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X9 Y0 Z9\nM06 T101001\nM02\n"), "T101002: 3-3, W162 to 3");
  EXPECT_EQ(unknown_lines("M06 T101002\nG00 X9 Y0 Z9\nM06 T000000\nM02\n"), "");
}

/// What does not hang on the spindle is compared all the time: a contact of it goes on.
TEST(ContactReports, WhatIsNotOnTheSpindleIsComparedWhereverThatIs) {
  Shop shop(kinematics::MachineKind::Table);
  shop.scene.clearance = 0;
  shop.box("clamp", {60, -20, 0}, {80, 20, 40});
  shop.scene.machine.push_back({.name = "rail",
                                .role = BodyRole::Machine,
                                .shape = solids::Cuboid{.minimum = {60, -90, -80}, .maximum = {100, 90, -20}}});
  const VerifiedRun run = shop.run("M06 T101002\nG00 Z250\nM06 T101001\nG00 X5\nG00 B-40\nX8\nZ260\nX10\nB0\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].line, 4u);
  EXPECT_EQ(run.contacts[0].end_line, 8u);
}

/// A tool without a length that has not moved up or down leaves the spindle where it was.
TEST(ContactReports, AfterAToolWithoutLengthThatHasNotMovedAllIsCompared) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X100 Y0 Z10\nM06 T101002\nM06 T101001\nG00 X0\nG00 Z80\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u);
  EXPECT_EQ(run.contacts[0].line, 4u);
  EXPECT_TRUE(run.certificate->unknown_places.empty());
}

TEST(ContactReports, TheCertificateSaysWhatWasNotRun) {
  const Shop shop;
  running::RunOptions options;
  options.setup.home = shop.machine.home;
  options.until = 2;
  const VerifiedRun run = verified_run("M06 T101001\nG00 X0\nX100\nM02\n", options, shop.machine, &shop.scene);
  EXPECT_NE(in_words(*run.certificate, Language::English).find("not verified: what follows from line 3 on"),
            std::string::npos);
  EXPECT_NE(to_json(run, Language::English)["certificate"]["notVerified"].dump().find("line 3"), std::string::npos);
}

TEST(ContactReports, FixturesOfOneNameAreTwo) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {40, -10, 0}, {60, 10, 20}).described = {.file = "isocnc.json", .line = 3, .column = 1};
  shop.box("clamp", {140, -10, 0}, {160, 10, 20}).described = {.file = "isocnc.json", .line = 4, .column = 1};
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z10\nX100\nX200\nM02\n");
  ASSERT_EQ(run.contacts.size(), 2u);
  EXPECT_NE(run.contacts[0].mistake, run.contacts[1].mistake);
}

/// Cuts as deep as the tolerance are accepted, and those that are deeper by 0.02 are not.
TEST(ContactReports, DepthsUpToTheToleranceAreAccepted) {
  for (const double tolerance : {0.0, 0.02, 0.05, 0.2, 1.0}) {
    Shop shop;
    shop.scene.target_tolerance = tolerance;
    shop.box("", {-50, -50, -50}, {50, 50, 0}, BodyRole::Target);
    const auto run_at = [&](double depth) {
      return shop.run(fmt::format("M06 T101001\nG00 X-100 Y0 Z50\nG01 Z{:.4f} F2000\nX100\nM02\n", -depth));
    };
    EXPECT_TRUE(run_at(tolerance).contacts.empty()) << tolerance;
    const VerifiedRun deeper = run_at(tolerance + 0.05);
    ASSERT_EQ(deeper.contacts.size(), 1u) << tolerance;
    EXPECT_NEAR(deeper.contacts[0].distance, -0.05, 0.005) << tolerance;
    EXPECT_EQ(run_at(tolerance + 0.021).contacts.size(), 1u) << tolerance;
  }
}

/// Where the program counts: on a table that turns, its coordinates turn with the workpiece.
TEST(ContactReports, ThePlaceIsThatOfTheProgram) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.scene.nose.reset();
  add_machine_body(shop, "post", Link::Machine, {195, -5, 0}, {205, 5, 50});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100 B0 C90\nG01 X0 Y200 Z20 F5000\nM02\n");
  ASSERT_EQ(run.contacts.size(), 1u) << run.contacts.size();
  // The tip goes to Y200 on the table, and in the machine it comes there near the post or opposite to it.
  EXPECT_NEAR(run.contacts[0].point.x(), 0, 15.1);
  EXPECT_NEAR(run.contacts[0].point.y(), 200, 15.1);
}

TEST(ContactReports, AGapIsNoDepth) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X-50 Y20.015 Z50\nG01 Z10 F1000\nX50\nM02\n");
  for (const simulation::RunFinding& each : run.outcome.findings) EXPECT_NEAR(each.finding.values[0], 0.01, 1e-9);
}

TEST(ContactReports, ValuesHaveAsFewDigitsAsMessagesShow) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  for (int i = 0; i < 20; ++i) {
    const VerifiedRun run =
        shop.run(fmt::format("M06 T101001\nG00 X-{} Y0.{} Z50\nG01 Z10.{} F1000\nX50\nM02\n", 50 + i, i, i));
    ASSERT_EQ(run.outcome.findings.size(), 1u);
    for (const double value : run.outcome.findings[0].finding.values)
      EXPECT_LE(fmt::format("{}", value).size(), 6u) << value;
  }
}

TEST(ContactReports, AToolChangeShowsWhatTheToolTouchesWhereItIsMounted) {
  Shop shop;
  shop.scene.clearance = 0;
  shop.box("clamp", {-10, -10, -50}, {10, 10, 20});
  static constexpr execution::ToolCode kLonger{1, 1, 2};
  ToolBodies longer = shop.scene.tools.at(Shop::kTool);
  longer.length = 160;
  shop.scene.tools[kLonger] = longer;
  shop.machine.tool_lengths[kLonger] = 160;
  const std::string start = "M06 T101001\nG00 X0 Y0 Z30\nM06 T101002\n";
  EXPECT_EQ(summaries(shop.run(start + "M02\n")), std::vector<std::string>{"E152 3 the cutter of T101002 | clamp"});
  EXPECT_EQ(summaries(shop.run(start + "G00 Z100\nM02\n")),
            std::vector<std::string>{"E152 3 the cutter of T101002 | clamp"});
  EXPECT_TRUE(summaries(shop.run("M06 T101001\nG00 X0 Y0 Z100\nM06 T101002\nM02\n")).empty());
  // The first one is mounted at home, with the nose at Z400.
  shop.box("post", {-10, -10, 280}, {10, 10, 320});
  EXPECT_EQ(summaries(shop.run("M06 T101001\nG00 X500\nM02\n")),
            std::vector<std::string>{"E152 1 the cutter of T101001 | post"});
}

/// Blanks and comments within a word mean nothing.
TEST(ContactReports, TheFirstOriginIsFoundHoweverItIsWritten) {
  for (const char* const written :
       {"G92", "g092", "G9 2", "G 9\t2", "G(a)92", "G9(zero)2", "G (a) 0 9(b)(c) 2", "G9(G)2"})
    EXPECT_EQ(first_workpiece_origin(fmt::format("{} X500 Y300 Z-10\nM02\n", written), {}), Vec3(500, 300, -10))
        << written;
  for (const char* const other : {"G04 P92", "G91\n2 X1", "(G92)", "; G92"})
    EXPECT_EQ(first_workpiece_origin(fmt::format("{}\nM02\n", other), {}), Vec3::Zero()) << other;
}

TEST(ContactReports, TheCertificateSaysWhereNoSetupIsForTheProgram) {
  Shop shop;
  shop.scene.name = "isocnc.json";
  const VerifiedRun with = shop.run("M06 T101001\nG00 X0\nM02\n");
  EXPECT_NE(in_words(*with.certificate, Language::English).find("in the setup of isocnc.json"), std::string::npos);
  shop.scene.has_setup = false;
  const std::string words = in_words(*shop.run("M06 T101001\nG00 X0\nM02\n").certificate, Language::English);
  EXPECT_NE(words.find("between the bodies of the machine in isocnc.json; not verified: no setup is for this program"),
            std::string::npos)
      << words;
}

/// A board without an area has no ends that could hit the machine.
TEST(ContactReports, AnEndlessBoardOnATableIsNotComparedWithTheMachine) {
  Shop shop(MachineKind::Table);
  shop.scene.clearance = 0;
  shop.box("", {-1e5, -1e5, -60}, {1e5, 1e5, -50}, BodyRole::Spoilboard).is_endless = true;
  add_machine_body(shop, "column", Link::Machine, {-50, 800, -500}, {50, 900, 2000});
  const VerifiedRun run = shop.run("M06 T101001\nG00 X0 Y0 Z100\nG01 X50 B20 C90 F2000\nM02\n");
  EXPECT_TRUE(run.contacts.empty());
  EXPECT_TRUE(run.certificate->gaps.empty());
}

}  // namespace
}  // namespace isocnc::verification
